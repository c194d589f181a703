#pragma once

#include <cstdint>
#include <graze/report.hpp>
#include <string>
#include <utility>
#include <vector>

#include "page/motion_table.hpp"
#include "page/page_objects.hpp"

namespace graze::io {

/// A frame that waits to be written with its block.
struct WaitingFrame {
  struct Move {
    std::size_t object = 0;
    PageShape shape;
  };

  std::uint64_t call = 0;    ///< which call of PageWriter::frame() it was
  std::uint64_t number = 0;  ///< the source's
  FrameReport report;
  std::vector<Move> moves;

  /// About how many bytes it takes in the tables of its block.
  [[nodiscard]] std::uint64_t raw_bytes() const;
};

/// The frames of the next block.
class PageBlock {
 public:
  void add(WaitingFrame frame);
  void clear();
  /// Leaves out the frames whose call `every` does not divide. Gives the objects that moved after the last
  /// frame that stays.
  std::vector<std::size_t> thin(std::uint32_t every);

  [[nodiscard]] const std::vector<WaitingFrame>& frames() const { return frames_; }
  [[nodiscard]] std::uint64_t raw_bytes() const { return raw_bytes_; }

 private:
  std::vector<WaitingFrame> frames_;
  std::uint64_t raw_bytes_ = 0;
};

/// The tables of a block as gzip writes them, and the errors of positions in it.
struct PackedBlock {
  std::string motion;
  std::string report;
  std::vector<std::pair<std::size_t, double>> errors;  ///< object, the largest error of a coordinate
};

/// Says which frames of the source a block has.
struct BlockPlace {
  std::uint64_t first_frame = 0;  ///< the page's number of the first one
  std::uint32_t every = 1;        ///< the page has each call of PageWriter::frame() that it divides
  bool include_times = true;
};

/// How many frames a page with each call that `every` divides has before a call.
std::uint64_t page_frames_before(std::uint64_t call, std::uint32_t every);

PackedBlock packed(const PageBlock& block, const PageObjects& objects, const BlockPlace& place);

}  // namespace graze::io
