#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace graze::io {

/// The vertices that some corners use, renumbered from 0 in ascending order. Many objects of a file may share
/// its vertices. So the cost depends on the corners alone, and not on how many vertices there are.
class UsedVertices {
 public:
  /// Every corner is below `vertex_count`.
  UsedVertices(std::span<const std::uint32_t> corners, std::size_t vertex_count);

  /// The old numbers, ascending.
  [[nodiscard]] const std::vector<std::uint32_t>& old_numbers() const { return old_numbers_; }
  /// The new number of a vertex that is used.
  [[nodiscard]] std::uint32_t new_number(std::uint32_t vertex) const;

 private:
  std::vector<std::uint32_t> old_numbers_;
  std::vector<std::uint32_t>
      new_numbers_;  ///< by old number. It is empty where few of many vertices are used
};

}  // namespace graze::io
