#include "page/motion_table.hpp"

#include <cstring>

#include "page/page_table.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

bool are_same_positions(const SharedPositions& a, const SharedPositions& b) {
  if (a == b) return true;
  if (!a || !b || a->size() != b->size()) return false;
  const std::size_t bytes = a->size() * sizeof(Eigen::Vector3d);
  return bytes == 0 || std::memcmp(a->data(), b->data(), bytes) == 0;
}

/// Writes what all kinds of tracks have.
void begin_track(JsonText& json, const PageTrack& track, std::string_view array) {
  json.open('{').key("object").whole(track.object).key("frames").open('[');
  for (const std::uint64_t frame : track.frames) json.whole(frame);
  json.close(']').key("array").text(array);
}

/// Writes a track of positions and gives its largest error.
double add_positions(PageTable& table, JsonText& json, const PageTrack& track, std::string_view array) {
  std::vector<SharedPositions> frames;
  for (const PageShape& shape : track.shapes) frames.push_back(shape.positions);
  const QuantizedPositions positions = quantized(*track.mesh, frames);
  begin_track(json, track, array);
  json.key("kind").text("positions").key("origin").point(positions.origin);
  json.key("step").real(positions.step).close('}');
  table.add_bytes(array, "u8", positions.bytes, positions.bytes.size());
  return positions.error;
}

void add_poses(PageTable& table, JsonText& json, const PageTrack& track, std::string_view array) {
  std::vector<double> rows;
  for (const PageShape& shape : track.shapes) rows.insert(rows.end(), shape.pose.begin(), shape.pose.end());
  begin_track(json, track, array);
  json.key("kind").text("pose").close('}');
  table.add(array, std::span<const double>(rows));
}

}  // namespace

bool PageShape::is_same(const PageShape& other) const {
  return are_same_positions(positions, other.positions) &&
         std::memcmp(pose.data(), other.pose.data(), sizeof pose) == 0;
}

void PageTrack::add(std::uint64_t frame, const PageShape& shape) {
  if (!shapes.empty() && shapes.back().is_same(shape)) return;
  frames.push_back(frame);
  shapes.push_back(shape);
}

MotionTable motion_table(const std::vector<PageTrack>& tracks) {
  MotionTable result;
  PageTable table;
  JsonText json;
  json.open('[');
  for (const PageTrack& track : tracks) {
    const std::string array = joined("p", result.errors.size());
    double error = 0;
    if (track.shapes.front().positions)
      error = add_positions(table, json, track, array);
    else
      add_poses(table, json, track, array);
    result.errors.push_back(error);
  }
  json.close(']');
  table.add_key("tracks", json.line());
  result.bytes = table.bytes();
  return result;
}

}  // namespace graze::io
