#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "core/base/box.hpp"

namespace graze {

/// Sorts boxes into leaves so that every aligned range of 8, 64, 512, … leaves is a compact group. Boxes are
/// first sorted into size classes. Each class is then halved repeatedly along the axis on which its boxes are
/// spread most. So a box of unusual size or position widens only a few groups.
class BoxOrder {
 public:
  static constexpr std::uint32_t block = 8;

  /// Fills `leaves` with the indices of `boxes`, each once. Each size class begins a new block of 8 leaves,
  /// and the unused leaves of its last block are no_slot. The number of leaves is a multiple of `block`.
  void make(std::span<const Box> boxes, std::vector<std::uint32_t>& leaves, TaskPool& tasks);

  /// Reserves memory for that many boxes and leaves.
  void reserve(std::size_t boxes, std::size_t leaves);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Item {
    std::array<double, 3> centre;
    std::uint32_t index;
    std::uint32_t size_class;
  };
  struct Range {
    std::size_t begin;
    std::size_t end;
  };

  void sort_by_size(std::span<const Box> boxes);
  std::size_t halve(const Range& range);
  void halve_down(const Range& range);
  void halve_large();

  std::vector<Item> unsorted_;
  std::vector<Item> items_;  ///< by leaf
  std::vector<Range> ranges_;
};

}  // namespace graze
