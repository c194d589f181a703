#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/settings_check.hpp"
#include "base/slot_pair.hpp"
#include "base/task_pool.hpp"
#include "broad_phase/box_tree.hpp"
#include "broad_phase/filter_classes.hpp"
#include "core/base/box.hpp"
#include "objects/object_summary.hpp"

namespace graze {

/// The pairs that are left out one by one at present, and may come back. Objects are named by their serials,
/// the lower first. Tasks may ask at the same time.
class IgnoredPairs {
 public:
  using Serials = std::pair<std::uint64_t, std::uint64_t>;

  virtual ~IgnoredPairs() = default;
  /// Whether no pair is ignored.
  [[nodiscard]] virtual bool is_empty() const = 0;
  [[nodiscard]] virtual bool contains(const Serials& pair) const = 0;
  /// The pairs that became ignored, or are not ignored any more, since they were last forgotten. No value
  /// means that there are too many to name.
  [[nodiscard]] virtual std::optional<std::span<const Serials>> changed() const = 0;
};

/// Keeps the pairs of objects that may be near, from step to step. Pairs that filters take out have no place
/// among them, and cost nothing while their objects stay in their loose boxes.
///
/// Every object has a loose box: its own box grown by half of its reach, its margin, and some slack for
/// motion. In a step that sweeps it holds the object throughout the step. The pairs are exactly those that
/// pass the filters and whose loose boxes overlap or touch. An object that has moved inside its loose box
/// costs nothing. An object that has left its loose box gets a new one, and a tree of all loose boxes finds
/// its pairs. Stepping thread only.
class BroadPhase {
 public:
  /// For each kind, half of the largest reach of any pair with an object of that kind, without margins.
  using HalfReaches = std::array<double, kind_count>;

  /// Returns pairs that pass the filters, in ascending order. These are all whose boxes are within both half
  /// reaches and both margins of each other, and some others. `summaries` have been refreshed once since the
  /// last call. `ignored` says what has changed since then. The result is valid until the next call.
  std::span<const SlotPair> find(const ObjectSummaries& summaries, const HalfReaches& half_reaches,
                                 const IgnoredPairs& ignored, TaskPool& tasks);

  /// Counters of the last `find`.
  struct Counters {
    std::uint64_t boxes_tested = 0;      ///< boxes of objects or nodes tested against a box
    std::uint64_t objects_in_slack = 0;  ///< objects that have moved inside their loose boxes
  };
  [[nodiscard]] const Counters& counters() const { return counters_; }
  /// How many pairs of all objects the lasting filters take out.
  [[nodiscard]] const FilteredPairs& filtered() const { return classes_.filtered(); }
  /// The loose box of each object, by slot.
  [[nodiscard]] std::span<const Box> loose_boxes() const { return loose_; }
  /// Reserves memory for that many objects and pairs. Each task gets room for up to 4,096 pairs.
  void reserve(std::size_t objects, std::size_t pairs);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The results of one task.
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
  bool renew_if_left(const ObjectSummaries& summaries, std::uint32_t slot, Box& loose) const;
  [[nodiscard]] bool wants_new_order() const;
  std::span<Slice> begin_slices(std::size_t count);
  void reserve(Slice& slice) const;
  std::uint64_t sum_tests();
  /// Decides about each pair of objects whose loose boxes meet.
  struct PairCheck {
    const ObjectSummaries& summaries;
    const IgnoredPairs& ignored;
    bool is_needed = false;
    bool needs_traits = false;  ///< the tree lets some pairs pass that never touch

    [[nodiscard]] bool passes(SlotPair pair) const;
  };
  void change_ignored(const PairCheck& check, std::span<const IgnoredPairs::Serials> changed);
  void find_all(const PairCheck& check, TaskPool& tasks);
  void sort_rows(TaskPool& tasks);
  void find_left(const PairCheck& check, TaskPool& tasks);
  void find_one(std::uint32_t slot, const PairCheck& check, Slice& slice) const;
  template <typename IsReplaced>
  void merge(const IsReplaced& is_replaced);

  HalfReaches half_reaches_{};
  bool reaches_changed_ = false;
  std::vector<Box> loose_;  ///< by slot. It is empty for a new object
  BoxTree tree_;
  FilterClasses classes_;
  std::vector<SlotPair> pairs_;         ///< ascending
  std::vector<std::uint32_t> left_;     ///< slots of objects that have left their loose boxes, ascending
  std::vector<std::uint8_t> has_left_;  ///< by slot
  std::vector<SliceObjects> slice_objects_;
  std::vector<Slice> slices_;
  std::size_t pairs_of_each_slice_ = 0;  ///< reserved capacity
  std::size_t slice_count_ = 0;          ///< slices in use
  std::vector<std::size_t> rows_;        ///< where the pairs of each first object begin or end in pairs_
  std::vector<SlotPair> changed_;        ///< pairs that became ignored or not
  std::vector<SlotPair> new_pairs_;
  std::vector<SlotPair> merged_;
  Counters counters_;
  double tests_when_ordered_ = 0;  ///< boxes tested for each object when the order was new
  double excess_tests_ = 0;        ///< tests since the last new order beyond those that a new order needs
};

/// Throws std::logic_error if a loose box does not contain what it must, or if `pairs` are not exactly the
/// pairs that pass the filters and whose loose boxes meet. Pairs are checked only for up to 200 objects. Does
/// nothing without GRAZE_VALIDATE.
void validate(const ObjectSummaries& summaries, const BroadPhase::HalfReaches& half_reaches,
              const IgnoredPairs& ignored, std::span<const Box> loose, std::span<const SlotPair> pairs);

}  // namespace graze
