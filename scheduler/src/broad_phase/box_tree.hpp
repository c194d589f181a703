#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "broad_phase/box_order.hpp"
#include "broad_phase/filter_classes.hpp"
#include "core/base/box.hpp"

namespace graze {

/// A bounding volume tree over boxes that finds which boxes overlap or touch. Each box belongs to a slot.
///
/// Each box is in a leaf, in an order in which neighbours are near each other (BoxOrder). Eight leaves form a
/// block, eight blocks a node above them, and so on up to one root. The tree is stored as its levels, without
/// pointers. Results depend on the boxes only. The order decides how many boxes are tested.
///
/// One thread changes the tree. While none does, any number of threads may query it.
class BoxTree {
 public:
  /// Builds the tree for new boxes with a new order. Box i belongs to slot i.
  void build(std::span<const Box> boxes, TaskPool& tasks);
  /// Replaces the box of every slot and keeps the order.
  void move_all(std::span<const Box> boxes, TaskPool& tasks);
  void move(std::uint32_t slot, const Box& box);
  /// Adds a box for a new slot, in a leaf behind all others. The slot is the next after the highest, or one
  /// that `rename` has left free.
  void add(std::uint32_t slot, const Box& box);
  /// Renumbers all slots: slot i becomes `new_slots[i]`, or is removed where that is no_slot. The remaining
  /// slots keep their order. There are `count` slots then, and those between that are free are added next.
  void rename(std::span<const std::uint32_t> new_slots, std::size_t count);

  /// Prepares for queries that leave out the pairs that filters take out for good. `classes` has the tree's
  /// slots. Without such pairs it costs nothing, here and in queries.
  void prepare_filters(const FilterClasses& classes);

  /// Appends every slot whose box overlaps or touches that of a slot, itself included, except those that it
  /// can never touch. Returns the number of boxes tested.
  std::uint64_t find(std::uint32_t slot, const Box& box, std::vector<std::uint32_t>& found) const;
  /// Appends every pair of slots whose boxes overlap or touch and whose lower leaf is in a block of [first,
  /// last), except those that can never touch. Returns the number of boxes tested.
  std::uint64_t find_pairs(std::uint32_t first_block, std::uint32_t last_block,
                           std::vector<SlotPair>& found) const;

  [[nodiscard]] std::uint32_t block_count() const {
    return static_cast<std::uint32_t>(slot_of_.size()) / width;
  }
  /// The number of leaves, empty ones included.
  [[nodiscard]] std::size_t leaf_count() const { return slot_of_.size(); }
  /// How many leaves `add` has created since the last `build`.
  [[nodiscard]] std::size_t unordered_count() const { return slot_of_.size() - ordered_; }
  /// How many blocks have a longest side of more than twice that at the last `build`.
  [[nodiscard]] std::size_t widened_blocks() const;
  /// Reserves memory for that many boxes and leaves.
  void reserve(std::size_t boxes, std::size_t leaves);
  [[nodiscard]] std::size_t byte_count() const;

  /// Throws std::logic_error if a slot is not in exactly one leaf with its box, or if a node does not contain
  /// its children. Does nothing without GRAZE_VALIDATE.
  void validate(std::span<const Box> boxes) const;

 private:
  static constexpr std::uint32_t width = BoxOrder::block;
  /// The largest number of levels above the leaves: 8^11 is more than there can be leaves.
  static constexpr std::size_t most_levels = 12;

  /// A box as (min, -max) with finite numbers. Two boxes meet when each number of one is at most the matching
  /// number of the other's Reach. The box of both has the smaller of each two numbers. Infinite numbers mean
  /// an empty box.
  using Limits = std::array<double, 6>;
  using Reach = std::array<double, 6>;  ///< (max, -min)
  static const Limits no_box;
  static Limits limits_of(const Box& box);
  static Reach reach_of(const Limits& limits);
  static unsigned meeting(const Limits* eight, const Reach& reach);
  /// Returns which of eight nodes filters let pass. `met` has the bits of those whose boxes meet.
  [[nodiscard]] unsigned passing(unsigned met, std::uint32_t level, std::uint32_t first,
                                 const WantedFilter& wanted) const;
  [[nodiscard]] WantedFilter wanted_by(std::uint32_t level, std::uint32_t index) const {
    return classes_ == nullptr ? WantedFilter() : classes_->wanted_by(filters_[level][index]);
  }

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
  std::vector<std::uint32_t> slot_of_;            ///< by leaf
  std::vector<std::uint32_t> leaf_of_;            ///< by slot
  std::uint32_t end_ = 0;                         ///< all leaves from this one on are empty
  std::size_t ordered_ = 0;                       ///< the number of leaves at the last build
  const FilterClasses* classes_ = nullptr;        ///< null where filters take out no pair for good
  std::vector<std::vector<NodeFilter>> filters_;  ///< as `levels_`, if they are of the present leaves
  bool filters_are_current_ = false;
  std::vector<double> ordered_sides_;  ///< the longest side of each block at the last build
};

}  // namespace graze
