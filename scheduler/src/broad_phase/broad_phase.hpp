#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/settings_check.hpp"
#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "broad_phase/box_tree.hpp"
#include "core/base/box.hpp"
#include "objects/object_summary.hpp"

namespace graze {

/// Keeps the pairs of objects that may be near, from step to step.
///
/// Every object has a loose box around its own: grown by half of its reach, its margin, and some room to
/// move. The pairs are those whose loose boxes meet, neither more nor fewer. Nothing is to be done for an
/// object that has moved but not left its loose box; one that has gets a new one, and its pairs are looked
/// for in a tree of all loose boxes. Stepping thread only.
class BroadPhase {
 public:
  /// Half of the largest reach of any pair of an object of each kind, without margins.
  using HalfReaches = std::array<double, kind_count>;

  /// Every pair whose boxes are within both half reaches and both margins of each other, and some others;
  /// ascending. `summaries` have been refreshed once since the last call. Stands until the next call.
  std::span<const SlotPair> find(const ObjectSummaries& summaries, const HalfReaches& half_reaches,
                                 TaskPool& tasks);

  /// What the last call did.
  struct Counters {
    std::uint64_t boxes_tested = 0;      ///< boxes of objects or nodes against a box
    std::uint64_t objects_in_slack = 0;  ///< have moved inside their loose box
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// By slot.
  [[nodiscard]] std::span<const Box> loose_boxes() const { return loose_; }
  /// Makes room for so many objects and pairs, of which any task finds up to 4,096.
  void reserve(std::size_t objects, std::size_t pairs);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// What one task finds: each has its own.
  struct Slice {
    std::vector<SlotPair> pairs;
    std::vector<std::uint32_t> found;
    std::uint64_t boxes_tested = 0;
  };
  struct SliceObjects {
    std::size_t left = 0;
    std::size_t in_slack = 0;
  };

  void update_slots(const ObjectSummaries& summaries);
  void loosen(const ObjectSummaries& summaries, TaskPool& tasks);
  bool renew_if_left(const ObjectSummary& summary, Box& loose) const;
  [[nodiscard]] bool wants_new_order() const;
  std::span<Slice> begin_slices(std::size_t count);
  void reserve(Slice& slice) const;
  std::uint64_t sum_tests();
  void find_all(TaskPool& tasks);
  void sort_rows(TaskPool& tasks);
  void find_left(TaskPool& tasks);
  void find_one(std::uint32_t slot, Slice& slice) const;
  void merge();

  HalfReaches half_reaches_{};
  bool reaches_changed_ = false;
  std::vector<Box> loose_;  ///< by slot; empty for an object that is new
  BoxTree tree_;
  std::vector<SlotPair> pairs_;         ///< ascending
  std::vector<std::uint32_t> left_;     ///< slots that have left their loose boxes, ascending
  std::vector<std::uint8_t> has_left_;  ///< by slot
  std::vector<SliceObjects> slice_objects_;
  std::vector<Slice> slices_;
  std::size_t pairs_of_each_slice_ = 0;  ///< that room was reserved for
  std::size_t slice_count_ = 0;          ///< of them in use
  std::vector<std::size_t> rows_;        ///< where in pairs_ those of each first object begin or end
  std::vector<SlotPair> new_pairs_;
  std::vector<SlotPair> merged_;
  Counters counters_;
  double tests_when_ordered_ = 0;  ///< boxes tested for one object when the order was new
  double excess_tests_ = 0;        ///< beyond what they would have been with a new order, since it was
};

/// Throws std::logic_error where a loose box does not contain what it must, or `pairs` are not all pairs of
/// loose boxes that meet (looked at for few objects only). Without GRAZE_VALIDATE it is empty.
void validate(const ObjectSummaries& summaries, const BroadPhase::HalfReaches& half_reaches,
              std::span<const Box> loose, std::span<const SlotPair> pairs);

}  // namespace graze
