#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "broad_phase/box_order.hpp"
#include "core/base/box.hpp"

namespace graze {

/// A tree over boxes, each named by a slot, that says which boxes meet: overlap, or touch.
///
/// Boxes stand in leaves, in an order in which neighbours are near each other (BoxOrder). Eight leaves are a
/// block, eight blocks a node above them, and so on up to one: the tree is its levels, without a pointer.
/// What it answers depends on the boxes only; the order decides how much work that is.
///
/// One thread changes it; while none does, any number may ask.
class BoxTree {
 public:
  /// Makes a new order for all boxes; box i is slot i.
  void build(std::span<const Box> boxes, TaskPool& tasks);
  /// Gives every slot a new box; the order stays.
  void move_all(std::span<const Box> boxes, TaskPool& tasks);
  void move(std::uint32_t slot, const Box& box);
  /// A new slot, the next after the highest, in a leaf behind all others.
  void add(const Box& box);
  /// Renames all slots: slot i is to be `new_slots[i]`, or is gone where that is no_slot. Those that stay
  /// are numbered from 0 in the order they had.
  void rename(std::span<const std::uint32_t> new_slots);

  /// Appends every slot whose box meets `box`. Returns the number of boxes tested.
  std::uint64_t find(const Box& box, std::vector<std::uint32_t>& found) const;
  /// Appends every pair of slots whose boxes meet, of which the one in the lower leaf is in a block of
  /// [first, last). Returns the number of boxes tested.
  std::uint64_t find_pairs(std::uint32_t first_block, std::uint32_t last_block,
                           std::vector<SlotPair>& found) const;

  [[nodiscard]] std::uint32_t block_count() const {
    return static_cast<std::uint32_t>(slot_of_.size()) / width;
  }
  /// Slots, of which some are empty.
  [[nodiscard]] std::size_t leaf_count() const { return slot_of_.size(); }
  /// Slots that `add` gave since the last `build`.
  [[nodiscard]] std::size_t unordered_count() const { return slot_of_.size() - ordered_; }
  /// Blocks that are more than twice as large as when they were ordered.
  [[nodiscard]] std::size_t widened_blocks() const;
  /// Makes room for so many boxes and leaves.
  void reserve(std::size_t boxes, std::size_t leaves);
  [[nodiscard]] std::size_t byte_count() const;

  /// Throws std::logic_error where a slot is not in one leaf with its box, or a node does not contain its
  /// children. Without GRAZE_VALIDATE it is empty.
  void validate(std::span<const Box> boxes) const;

 private:
  static constexpr std::uint32_t width = BoxOrder::block;
  /// Levels above the leaves are at most this many: 8^11 is more than there are leaves.
  static constexpr std::size_t most_levels = 12;

  /// A box as (min, -max), finite, so that each number of one at most its partner of another's Reach means
  /// that they meet, and the smaller numbers of two are the box of both. Infinite numbers are no box.
  using Limits = std::array<double, 6>;
  using Reach = std::array<double, 6>;  ///< (max, -min)
  static const Limits no_box;
  static Limits limits_of(const Box& box);
  static Reach reach_of(const Limits& limits);
  static unsigned meeting(const Limits* eight, const Reach& reach);

  struct Node {
    std::uint32_t level;
    std::uint32_t index;
  };
  using Stack = std::array<Node, most_levels * width>;

  void make_levels();
  void find_end();
  void refit_node(std::uint32_t level, std::uint32_t index);
  void refit_all(TaskPool& tasks);
  [[nodiscard]] double side_of_block(std::size_t block) const;
  void put(std::uint32_t leaf, const Box& box);
  std::uint64_t find_pairs_of(std::uint32_t block, std::uint32_t other, std::vector<SlotPair>& found) const;
  std::uint64_t find_pairs_of(std::uint32_t block, std::vector<SlotPair>& found) const;

  BoxOrder order_;
  std::vector<std::vector<Limits>> levels_;  ///< of the leaves, of the blocks, …, of one root
  std::size_t level_count_ = 0;
  std::vector<std::uint32_t> slot_of_;  ///< by leaf
  std::vector<std::uint32_t> leaf_of_;  ///< by slot
  std::uint32_t end_ = 0;               ///< leaves from here on are empty
  std::size_t ordered_ = 0;             ///< leaves that the last build gave
  std::vector<double> ordered_sides_;   ///< the blocks' longest sides then
};

}  // namespace graze
