#include "broad_phase/broad_phase.hpp"

#include <algorithm>
#include <functional>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

// Sizes of slices of work. They never depend on the number of threads.
constexpr std::size_t objects_of_slice = 512;
constexpr std::uint32_t blocks_of_slice = 64;
constexpr std::size_t queries_of_slice = 128;

// About how long each takes on one thread.
constexpr double nanoseconds_each_loosened = 30;
constexpr double nanoseconds_each_test = 2;
constexpr double nanoseconds_each_sorted = 15;
constexpr double nanoseconds_each_query = 500;

constexpr std::size_t slices_of(std::size_t count, std::size_t slice) {
  return (count + slice - 1) / slice;
}

/// The slack of a loose box in steps of steady motion, within the bounds below.
constexpr double steps_of_slack = 4;
/// The bounds of the slack, in parts of the longest side of the box.
constexpr double least_slack = 1.0 / 32;
constexpr double most_slack = 1.0 / 12;

/// If more than 1 in this many objects have left their loose boxes, all pairs are found anew.
constexpr std::size_t few = 8;

/// A new order takes about as long as this many tests for each object.
constexpr double tests_of_ordering = 64;

/// A tree with more leaves than this gets a new order.
constexpr std::size_t most_leaves(std::size_t objects) {
  return 2 * objects + 64;
}

bool contains(const Box& box, const Box& other) {
  return (box.min.array() <= other.min.array()).all() && (other.max.array() <= box.max.array()).all();
}

double longest_side(const Box& box) {
  return (box.max - box.min).maxCoeff();
}

/// Grows `needed` by the slack. A large motion counts as a jump, which predicts nothing, and gives the least
/// slack.
Box loosened(const Box& needed, double motion) {
  const double side = longest_side(needed);
  const bool is_steady = motion <= most_slack * side;
  const double room = is_steady ? std::clamp(steps_of_slack * motion, least_slack * side, most_slack * side)
                                : least_slack * side;
  return grown(needed, room);
}

/// Whether a loose box is too loose because the object or its reach has shrunk.
bool is_too_loose(const Box& loose, const Box& needed) {
  const double side = longest_side(needed);
  const Box most = grown(needed, side);
  return !contains(most, loose);
}

}  // namespace

bool BroadPhase::PairCheck::passes(SlotPair pair) const {
  const ObjectSummary& a = summaries[first_of(pair)];
  const ObjectSummary& b = summaries[second_of(pair)];
  if (needs_traits && lasting_verdict(a, b) != PairVerdict::tested) return false;
  return ignored.is_empty() || !ignored.contains({a.serial, b.serial});
}

std::span<const SlotPair> BroadPhase::find(const ObjectSummaries& summaries, const HalfReaches& half_reaches,
                                           const IgnoredPairs& ignored, TaskPool& tasks) {
  counters_ = {};
  reaches_changed_ = half_reaches != half_reaches_;
  half_reaches_ = half_reaches;
  update_slots(summaries);
  loosen(summaries, tasks);
  const bool needs_traits = classes_.needs_check();
  const PairCheck check{summaries, ignored, needs_traits || !ignored.is_empty(), needs_traits};
  const auto changed = ignored.changed();
  if (!changed || (!left_.empty() && (left_.size() > loose_.size() / few || wants_new_order()))) {
    find_all(check, tasks);
  } else {
    if (!changed->empty()) change_ignored(check, *changed);
    if (!left_.empty()) find_left(check, tasks);
  }
  validate(summaries, half_reaches_, ignored, loose_, pairs_);
  tree_.validate(loose_);
  return pairs_;
}

/// Removes objects that are gone and adds new ones, which have no loose box yet.
void BroadPhase::update_slots(const ObjectSummaries& summaries) {
  const auto new_slots = summaries.new_slots();
  const std::size_t before = loose_.size();
  const std::size_t count = summaries.all().size();
  renumber(loose_, new_slots, count);
  if (!new_slots.empty()) {
    tree_.rename(new_slots, count);
    classes_.rename(new_slots, count);
    std::size_t kept = 0;
    for (const SlotPair pair : pairs_)
      if (const SlotPair moved = remapped_pair(pair, new_slots); moved != no_pair) pairs_[kept++] = moved;
    pairs_.resize(kept);
  }
  visit_new_slots(new_slots, before, count, [&](std::uint32_t slot) {
    loose_[slot] = {};
    tree_.add(slot, {});
    classes_.add(slot, summaries.all()[slot]);
  });
}

/// Gives every object that has left its loose box a new one, and lists these objects in `left_`.
void BroadPhase::loosen(const ObjectSummaries& summaries, TaskPool& tasks) {
  const std::size_t count = loose_.size();
  const std::size_t slices = slices_of(count, objects_of_slice);
  left_.resize(count);
  has_left_.resize(count);
  slice_objects_.assign(slices, {});
  const auto loosen_slice = [&](unsigned, std::size_t slice) {
    const std::size_t begin = slice * objects_of_slice;
    SliceObjects objects;
    for (std::size_t slot = begin; slot < std::min(begin + objects_of_slice, count); ++slot) {
      const ObjectSummary& summary = summaries.all()[slot];
      const bool has_left = renew_if_left(summaries, static_cast<std::uint32_t>(slot), loose_[slot]);
      has_left_[slot] = has_left ? 1 : 0;
      if (has_left)
        left_[begin + objects.left++] = static_cast<std::uint32_t>(slot);
      else if (summary.moved)
        ++objects.in_slack;
    }
    slice_objects_[slice] = objects;
  };
  tasks.run(slices, std::ref(loosen_slice),
            {.nanoseconds = nanoseconds_each_loosened * static_cast<double>(count)});
  std::size_t end = 0;
  for (std::size_t slice = 0; slice < slices; ++slice) {
    const auto from = left_.begin() + static_cast<std::ptrdiff_t>(slice * objects_of_slice);
    std::copy_n(from, slice_objects_[slice].left, left_.begin() + static_cast<std::ptrdiff_t>(end));
    end += slice_objects_[slice].left;
    counters_.objects_in_slack += slice_objects_[slice].in_slack;
  }
  left_.resize(end);
}

/// Returns whether an object has left its loose box, and then replaces that box.
bool BroadPhase::renew_if_left(const ObjectSummaries& summaries, std::uint32_t slot, Box& loose) const {
  const ObjectSummary& summary = summaries[slot];
  const bool is_new = loose.empty();
  if (!summary.moved && !is_new && !reaches_changed_) return false;
  const Box needed = grown(summaries.whole_box(slot), half_reaches_[summary.kind] + summary.margin);
  if (!is_new && contains(loose, needed) && !is_too_loose(loose, needed)) return false;
  loose = loosened(needed, summary.motion);
  return true;
}

bool BroadPhase::wants_new_order() const {
  const std::size_t count = loose_.size();
  return tree_.leaf_count() > most_leaves(count) || tree_.unordered_count() > count / few + 64 ||
         excess_tests_ > tests_of_ordering * static_cast<double>(count);
}

std::span<BroadPhase::Slice> BroadPhase::begin_slices(std::size_t count) {
  while (slices_.size() < count) reserve(slices_.emplace_back());
  slice_count_ = count;
  for (Slice& slice : std::span(slices_).first(count)) {
    slice.pairs.clear();
    slice.boxes_tested = 0;
  }
  return std::span(slices_).first(count);
}

/// Takes out and puts back pairs whose objects both stay in their loose boxes.
void BroadPhase::change_ignored(const PairCheck& check, std::span<const IgnoredPairs::Serials> changed) {
  changed_.clear();
  new_pairs_.clear();
  for (const auto& [serial_a, serial_b] : changed) {
    const std::uint32_t a = check.summaries.find_slot(serial_a);
    const std::uint32_t b = check.summaries.find_slot(serial_b);
    if (a == b || a == no_slot || b == no_slot || has_left_[a] != 0 || has_left_[b] != 0) continue;
    if (lasting_verdict(check.summaries[a], check.summaries[b]) == PairVerdict::tested)
      changed_.push_back(pair_of(a, b));
  }
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  for (const SlotPair pair : changed_)
    if (check.passes(pair) && do_meet(loose_[first_of(pair)], loose_[second_of(pair)]))
      new_pairs_.push_back(pair);
  if (!changed_.empty())
    merge([&](SlotPair pair) { return std::binary_search(changed_.begin(), changed_.end(), pair); });
}

void BroadPhase::find_all(const PairCheck& check, TaskPool& tasks) {
  const auto count = static_cast<double>(loose_.size());
  bool is_ordered = wants_new_order();
  if (!is_ordered) {
    tree_.move_all(loose_, tasks);
    is_ordered = tree_.widened_blocks() > tree_.block_count() / 4;
  }
  if (is_ordered) tree_.build(loose_, tasks);
  tree_.prepare_filters(classes_);
  const auto slices = begin_slices(slices_of(tree_.block_count(), blocks_of_slice));
  const auto find_slice = [&](unsigned, std::size_t index) {
    const auto first = static_cast<std::uint32_t>(index) * blocks_of_slice;
    const std::uint32_t last = std::min(first + blocks_of_slice, tree_.block_count());
    slices[index].boxes_tested = tree_.find_pairs(first, last, slices[index].pairs);
    if (check.is_needed)
      std::erase_if(slices[index].pairs, [&](SlotPair pair) { return !check.passes(pair); });
  };
  tasks.run(slices.size(), std::ref(find_slice),
            {.nanoseconds = nanoseconds_each_test * std::max(tests_when_ordered_, 16.0) * count});
  sort_rows(tasks);
  const auto tested = static_cast<double>(sum_tests());
  if (is_ordered) {
    tests_when_ordered_ = tested / count;
    excess_tests_ = 0;
  }
  excess_tests_ += std::max(0.0, tested - 1.5 * tests_when_ordered_ * count);
}

std::uint64_t BroadPhase::sum_tests() {
  std::uint64_t tested = 0;
  for (const Slice& slice : std::span(slices_).first(slice_count_)) tested += slice.boxes_tested;
  counters_.boxes_tested += tested;
  return tested;
}

/// Collects the pairs of all slices in `pairs_`, sorted by first object and then by second.
void BroadPhase::sort_rows(TaskPool& tasks) {
  const auto slices = std::span<const Slice>(slices_).first(slice_count_);
  const std::size_t objects = loose_.size();
  rows_.assign(objects + 1, 0);
  for (const Slice& slice : slices)
    for (const SlotPair pair : slice.pairs) ++rows_[first_of(pair) + std::size_t{1}];
  for (std::size_t slot = 0; slot < objects; ++slot) rows_[slot + 1] += rows_[slot];
  pairs_.resize(rows_[objects]);
  for (const Slice& slice : slices)
    for (const SlotPair pair : slice.pairs) pairs_[rows_[first_of(pair)]++] = pair;
  // From here on rows_[i] is the end of row i.
  const auto sort_slice = [&](unsigned, std::size_t index) {
    const std::size_t begin = index * objects_of_slice;
    const std::size_t end = std::min(begin + objects_of_slice, objects);
    for (std::size_t slot = begin; slot < end; ++slot) {
      const auto from = static_cast<std::ptrdiff_t>(slot == 0 ? 0 : rows_[slot - 1]);
      std::sort(pairs_.begin() + from, pairs_.begin() + static_cast<std::ptrdiff_t>(rows_[slot]));
    }
  };
  tasks.run(slices_of(objects, objects_of_slice), std::ref(sort_slice),
            {.nanoseconds = nanoseconds_each_sorted * static_cast<double>(pairs_.size())});
}

/// Finds the pairs of the few objects that have left their loose boxes. No other pair can have come or gone.
void BroadPhase::find_left(const PairCheck& check, TaskPool& tasks) {
  for (const std::uint32_t slot : left_) tree_.move(slot, loose_[slot]);
  tree_.prepare_filters(classes_);
  const auto slices = begin_slices(slices_of(left_.size(), queries_of_slice));
  const auto find_slice = [&](unsigned, std::size_t index) {
    Slice& slice = slices[index];
    const std::size_t end = std::min((index + 1) * queries_of_slice, left_.size());
    for (std::size_t i = index * queries_of_slice; i < end; ++i) find_one(left_[i], check, slice);
  };
  tasks.run(slices.size(), std::ref(find_slice),
            {.nanoseconds = nanoseconds_each_query * static_cast<double>(left_.size())});
  new_pairs_.clear();
  for (const Slice& slice : std::span(slices_).first(slice_count_))
    new_pairs_.insert(new_pairs_.end(), slice.pairs.begin(), slice.pairs.end());
  std::sort(new_pairs_.begin(), new_pairs_.end());
  merge([&](SlotPair pair) { return has_left_[first_of(pair)] != 0 || has_left_[second_of(pair)] != 0; });
  const double expected = 4 * tests_when_ordered_ + 64;
  excess_tests_ +=
      std::max(0.0, static_cast<double>(sum_tests()) - expected * static_cast<double>(left_.size()));
}

void BroadPhase::find_one(std::uint32_t slot, const PairCheck& check, Slice& slice) const {
  slice.found.clear();
  slice.boxes_tested += tree_.find(slot, loose_[slot], slice.found);
  for (const std::uint32_t other : slice.found) {
    // If both objects have left their loose boxes, the one in the lower slot finds the pair.
    if (other == slot || (has_left_[other] != 0 && other < slot)) continue;
    const SlotPair pair = pair_of(slot, other);
    if (!check.is_needed || check.passes(pair)) slice.pairs.push_back(pair);
  }
}

/// Puts `new_pairs_`, which ascend, in the place of some pairs.
template <typename IsReplaced>
void BroadPhase::merge(const IsReplaced& is_replaced) {
  merged_.clear();
  auto next = new_pairs_.begin();
  for (const SlotPair pair : pairs_) {
    if (is_replaced(pair)) continue;
    for (; next != new_pairs_.end() && *next < pair; ++next) merged_.push_back(*next);
    merged_.push_back(pair);
  }
  merged_.insert(merged_.end(), next, new_pairs_.end());
  pairs_.swap(merged_);
}

void BroadPhase::reserve(std::size_t objects, std::size_t pairs) {
  constexpr std::size_t most_of_each_slice = 4096;
  const std::size_t leaves = most_leaves(objects);
  loose_.reserve(objects);
  tree_.reserve(objects, leaves);
  classes_.reserve(objects);
  left_.reserve(objects);
  has_left_.reserve(objects);
  slice_objects_.reserve(slices_of(objects, objects_of_slice));
  rows_.reserve(objects + 1);
  pairs_.reserve(pairs);
  new_pairs_.reserve(pairs);
  merged_.reserve(pairs);
  pairs_of_each_slice_ = std::max(pairs_of_each_slice_, std::min(pairs, most_of_each_slice));
  const std::size_t slices = slices_of(leaves, std::size_t{BoxOrder::block} * blocks_of_slice);
  if (slices_.size() < slices) slices_.resize(slices);
  for (Slice& slice : slices_) reserve(slice);
}

void BroadPhase::reserve(Slice& slice) const {
  slice.pairs.reserve(pairs_of_each_slice_);
  slice.found.reserve(pairs_of_each_slice_);
}

std::size_t BroadPhase::byte_count() const {
  std::size_t bytes = bytes_of(loose_) + tree_.byte_count() + classes_.byte_count() + bytes_of(pairs_) +
                      bytes_of(merged_) + bytes_of(changed_) + bytes_of(new_pairs_) + bytes_of(left_) +
                      bytes_of(has_left_) + bytes_of(rows_) + bytes_of(slices_) + bytes_of(slice_objects_);
  for (const Slice& slice : slices_) bytes += bytes_of(slice.pairs) + bytes_of(slice.found);
  return bytes;
}

}  // namespace graze
