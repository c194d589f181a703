#include "page/page_block.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "page/gzip.hpp"
#include "page/report_table.hpp"

namespace graze::io {
namespace {

constexpr std::uint64_t pair_row_bytes = 110;
constexpr std::uint64_t contact_row_bytes = 102;
constexpr std::uint64_t region_row_bytes = 76;
constexpr std::uint64_t impact_row_bytes = 34;
constexpr std::uint64_t drawn_position_bytes = 12;

/// A move of one object, in a frame of the page.
struct TimedMove {
  std::uint64_t frame = 0;
  const PageShape* shape = nullptr;
};

/// The moves in a block by object, each list ascending by frame.
std::map<std::size_t, std::vector<TimedMove>> moves_of(const PageBlock& block, std::uint64_t first_frame) {
  std::map<std::size_t, std::vector<TimedMove>> moves;
  std::uint64_t frame = first_frame;
  for (const WaitingFrame& waiting : block.frames()) {
    for (const WaitingFrame::Move& move : waiting.moves) moves[move.object].push_back({frame, &move.shape});
    ++frame;
  }
  return moves;
}

/// The places of an object in the frames from `begin` up to `end`, in which it exists.
PageTrack track_of(const WrittenObject& object, std::span<const TimedMove> moves, std::uint64_t begin,
                   std::uint64_t end) {
  PageTrack track;
  track.mesh = object.mesh.get();
  PageShape at_begin = object.shown;
  for (const TimedMove& move : moves)
    if (move.frame <= begin) at_begin = *move.shape;
  track.add(begin, at_begin);
  for (const TimedMove& move : moves)
    if (move.frame > begin && move.frame < end) track.add(move.frame, *move.shape);
  return track;
}

std::vector<PageTrack> tracks_of(const PageBlock& block, const PageObjects& objects,
                                 const BlockPlace& place) {
  const std::uint64_t block_end = place.first_frame + block.frames().size();
  const auto moves = moves_of(block, place.first_frame);
  std::vector<PageTrack> tracks;
  for (const std::size_t index : objects.alive()) {
    const WrittenObject& object = objects.all()[index];
    const std::uint64_t begin = std::max(place.first_frame, page_frames_before(object.added, place.every));
    const std::uint64_t end =
        object.removed ? std::min(block_end, page_frames_before(*object.removed, place.every)) : block_end;
    if (begin >= end) continue;
    const auto found = moves.find(index);
    tracks.push_back(track_of(
        object, found == moves.end() ? std::span<const TimedMove>() : std::span(found->second), begin, end));
    tracks.back().object = index;
  }
  return tracks;
}

std::string report_table(const PageBlock& block, const PageObjects& objects, const BlockPlace& place) {
  ReportBlock reports;
  std::uint64_t frame = place.first_frame;
  for (const WaitingFrame& waiting : block.frames()) {
    const auto index_of = [&](ObjectId id) { return objects.index_of(id, waiting.call); };
    reports.add(frame++, waiting.number, waiting.report, index_of, place.include_times);
  }
  return reports.table();
}

}  // namespace

std::uint64_t WaitingFrame::raw_bytes() const {
  std::uint64_t bytes =
      pair_row_bytes * report.pairs().size() + contact_row_bytes * report.contacts().size() +
      region_row_bytes * report.region_distances().size() + impact_row_bytes * report.impacts().size();
  for (const Move& move : moves)
    bytes +=
        move.shape.positions ? drawn_position_bytes * move.shape.positions->size() : sizeof move.shape.pose;
  return bytes;
}

void PageBlock::add(WaitingFrame frame) {
  raw_bytes_ += frame.raw_bytes();
  frames_.push_back(std::move(frame));
}

void PageBlock::clear() {
  frames_.clear();
  raw_bytes_ = 0;
}

std::vector<std::size_t> PageBlock::thin(std::uint32_t every) {
  std::map<std::size_t, PageShape> pending;  // moves of frames that are left out
  const std::vector<WaitingFrame> all = std::exchange(frames_, {});
  raw_bytes_ = 0;
  for (const WaitingFrame& waiting : all) {
    for (const WaitingFrame::Move& move : waiting.moves) pending[move.object] = move.shape;
    if (waiting.call % every != 0) continue;
    WaitingFrame kept = waiting;
    kept.moves.clear();
    for (const auto& [object, shape] : std::exchange(pending, {})) kept.moves.push_back({object, shape});
    add(std::move(kept));
  }
  std::vector<std::size_t> moved;
  for (const auto& [object, shape] : pending) moved.push_back(object);
  return moved;
}

std::uint64_t page_frames_before(std::uint64_t call, std::uint32_t every) {
  return call / every + (call % every != 0 ? 1 : 0);
}

PackedBlock packed(const PageBlock& block, const PageObjects& objects, const BlockPlace& place) {
  const std::vector<PageTrack> tracks = tracks_of(block, objects, place);
  const MotionTable motion = motion_table(tracks);
  PackedBlock result{gzipped(motion.bytes), gzipped(report_table(block, objects, place)), {}};
  for (std::size_t i = 0; i < tracks.size(); ++i)
    result.errors.emplace_back(tracks[i].object, motion.errors[i]);
  return result;
}

}  // namespace graze::io
