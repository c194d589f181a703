#include <algorithm>
#include <limits>
#include <vector>

#include "calls.hpp"
#include "handles.hpp"
#include "layout.hpp"
#include "reports.hpp"
#include "settings.hpp"

using graze::c::BadArgument;
using graze::c::given;
using graze::c::guarded;
using graze::c::same;

namespace {

const graze::Replay& replay_of(const graze_replay* replay) {
  return given(replay, "replay").replay;
}

/// Returns an object of a replay. The index is checked, since the C++ interface does not.
const graze::ReplayObject& object_of(const graze::Replay& replay, size_t index) {
  const auto objects = replay.objects();
  if (index >= objects.size())
    throw BadArgument("index is " + std::to_string(index) + " of " + std::to_string(objects.size()));
  return objects[index];
}

static_assert(graze::c::has_members<graze::ReplaySettings, &graze::ReplaySettings::threads,
                                    &graze::ReplaySettings::first_frame>());
static_assert(graze::c::has_members<graze::ReplayDifference, &graze::ReplayDifference::frame,
                                    &graze::ReplayDifference::pair, &graze::ReplayDifference::recorded,
                                    &graze::ReplayDifference::replayed>());
static_assert(
    graze::c::has_members<graze::ReplayObject, &graze::ReplayObject::id, &graze::ReplayObject::serial,
                          &graze::ReplayObject::mesh, &graze::ReplayObject::settings>());

}  // namespace

extern "C" {

graze_status graze_replay_new(const graze_recording* recording, size_t first_frame, uint32_t threads,
                              graze_replay** replay) {
  return guarded([&] {
    auto& room = given(replay, "replay");
    const auto& shared = given(recording, "recording").recording;
    graze::ReplaySettings settings;
    settings.first_frame = first_frame;
    if (threads != std::numeric_limits<uint32_t>::max()) settings.threads = threads;
    room = new graze_replay{shared, graze::Replay(*shared, settings)};
  });
}

void graze_replay_release(graze_replay* replay) {
  delete replay;
}

graze_status graze_replay_step(graze_replay* replay, bool* has_stepped) {
  return guarded([&] {
    auto& room = given(has_stepped, "has_stepped");
    room = given(replay, "replay").replay.step();
  });
}

size_t graze_replay_frame_index(const graze_replay* replay) {
  return replay ? replay->replay.frame_index() : 0;
}

graze_status graze_replay_report(const graze_replay* replay, graze_report** report) {
  return guarded([&] {
    graze::c::ReportRoom room(&given(report, "report"));
    room.take(replay_of(replay).report());
  });
}

bool graze_replay_get_difference(const graze_replay* replay, graze_replay_difference* difference) {
  if (replay == nullptr || !replay->replay.difference()) return false;
  const graze::ReplayDifference& found = *replay->replay.difference();
  if (difference != nullptr)
    *difference = {found.frame, found.pair.c_str(), found.recorded.c_str(), found.replayed.c_str()};
  return true;
}

size_t graze_replay_rows_not_compared(const graze_replay* replay) {
  return replay ? replay->replay.rows_not_compared() : 0;
}

size_t graze_replay_rows_compared_in_part(const graze_replay* replay) {
  return replay ? replay->replay.rows_compared_in_part() : 0;
}

size_t graze_replay_object_count(const graze_replay* replay) {
  return replay ? replay->replay.objects().size() : 0;
}

graze_status graze_replay_object(const graze_replay* replay, size_t index, graze_id* object, uint64_t* serial,
                                 graze_mesh** mesh, graze_object_settings* settings) {
  return guarded([&] {
    const graze::ReplayObject& found = object_of(replay_of(replay), index);
    if (settings != nullptr)
      graze::c::fill(settings, settings->struct_size, graze::c::to_c(found.settings), "settings");
    if (mesh != nullptr) *mesh = new graze_mesh{found.mesh};
    if (object != nullptr) *object = same<graze_id>(found.id);
    if (serial != nullptr) *serial = found.serial;
  });
}

graze_status graze_replay_positions(const graze_replay* replay, size_t index, double* positions,
                                    size_t vertex_count) {
  return guarded([&] {
    const graze::Replay& read = replay_of(replay);
    const uint32_t needed = object_of(read, index).mesh->vertex_count();
    if (vertex_count != needed)
      throw BadArgument("vertex_count is " + std::to_string(vertex_count) + ", and the mesh has " +
                        std::to_string(needed));
    std::vector<Eigen::Vector3d> found;
    read.read_positions(index, found);
    double* next = &given(positions, "positions");
    for (const Eigen::Vector3d& point : found) next = std::copy_n(point.data(), 3, next);
  });
}

graze_status graze_replay_pose(const graze_replay* replay, size_t index, double rows[12]) {
  return guarded([&] {
    const graze::Replay& read = replay_of(replay);
    static_cast<void>(object_of(read, index));
    std::ranges::copy(read.pose(index), &given(rows, "rows"));
  });
}

}  // extern "C"
