#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "core/base/box.hpp"

namespace graze {

/// Puts boxes into an order in which every aligned range of 8, 64, 512, … leaves is a compact group: by size,
/// and among boxes of about one size by halving them again and again along the axis on which they are spread
/// most. A box out of all proportion, by its size or its position, so spoils a few groups and no more.
class BoxOrder {
 public:
  static constexpr std::uint32_t block = 8;

  /// Fills `leaves` with the numbers of `boxes`, each once. Boxes of each size begin a block of their own;
  /// what stays empty of the last is no_slot, and the count is a multiple of `block`.
  void make(std::span<const Box> boxes, std::vector<std::uint32_t>& leaves, TaskPool& tasks);

  /// Makes room for orders of so many boxes and leaves.
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
