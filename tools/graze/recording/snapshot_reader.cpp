#include "recording/snapshot_reader.hpp"

#include <set>
#include <utility>

namespace graze::tools {

SnapshotReader::SnapshotReader(const Recording& recording, std::size_t first_frame)
    : recording_(recording), replay_(recording, {.first_frame = first_frame}) {}

bool SnapshotReader::step() {
  if (!replay_.step()) return false;
  if (replay_.difference()) is_as_recorded_ = false;
  snapshot_.frame = replay_.frame_index();
  snapshot_.scene_frame = recording_.frame(replay_.frame_index()).frame;
  snapshot_.report = replay_.report();
  // The reports of a replay count from its own first step on.
  snapshot_.frames_by_since.resize(snapshot_.report->frame(), snapshot_.frame);
  snapshot_.frames_by_since.push_back(snapshot_.frame);
  list_objects();
  return true;
}

void SnapshotReader::list_objects() {
  std::set<ObjectId> ids;
  std::vector<io::SnapshotObject> objects;
  for (const ReplayObject& object : replay_.objects()) {
    ids.insert(object.id);
    objects.push_back({object.id, object.serial, object.settings.name, object.mesh, {}});
  }
  snapshot_.removed.clear();
  for (io::SnapshotObject& object : snapshot_.objects)
    if (!ids.contains(object.id)) snapshot_.removed.push_back(std::move(object));
  snapshot_.objects = std::move(objects);
}

void SnapshotReader::read_positions() {
  for (std::size_t i = 0; i < snapshot_.objects.size(); ++i)
    replay_.read_positions(i, snapshot_.objects[i].positions);
}

}  // namespace graze::tools
