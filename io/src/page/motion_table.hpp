#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <string>
#include <vector>

#include "page/quantized_positions.hpp"

namespace graze::io {

/// The place of an object: the positions of a deformable one, else the pose.
struct PageShape {
  SharedPositions positions;
  std::array<double, 12> pose{};

  /// Whether both have the same bits.
  [[nodiscard]] bool is_same(const PageShape& other) const;
};

/// The places of one object in the frames of a block.
struct PageTrack {
  std::size_t object = 0;
  const Mesh* mesh = nullptr;
  std::vector<std::uint64_t> frames;  ///< the page's numbers
  std::vector<PageShape> shapes;      ///< one for each of `frames`

  /// Appends a shape, unless it is the last one again.
  void add(std::uint64_t frame, const PageShape& shape);
};

/// The table of the motion in a block.
struct MotionTable {
  std::string bytes;
  std::vector<double> errors;  ///< by track, the largest of a drawn coordinate
};
MotionTable motion_table(const std::vector<PageTrack>& tracks);

}  // namespace graze::io
