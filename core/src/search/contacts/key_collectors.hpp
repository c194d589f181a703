#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "leaves/layout/leaf_features.hpp"
#include "search/contacts/key_ordering.hpp"
#include "search/contacts/near_list_recorder.hpp"

namespace graze {

/// Collects all keys that a finder has of a slice's candidates.
template <typename AnyFinder>
class AllKeys {
 public:
  using Finder = AnyFinder;

  explicit AllKeys(Finder& finder) : finder_(finder) {}

  /// Whether leaves this far apart are to be tested.
  [[nodiscard]] static bool wants(double /*lower*/) { return true; }
  void add(const LeafOf& a, const LeafOf& b) { finder_.add(a, b); }
  void add_listed(std::span<const FeaturePair> listed) { finder_.add_listed(listed); }
  bool add_blocks(std::size_t begin, std::size_t end) { return finder_.add_blocks(begin, end); }
  void finish() { finder_.finish(); }

 private:
  Finder& finder_;
};

/// Collects those keys that are among the closest of all slices, so many at most. It hands them over on the
/// way, and learns from what all slices have handed over which ones are too far.
template <typename AnyFinder>
class ClosestKeys {
 public:
  using Finder = AnyFinder;

  ClosestKeys(Finder& finder, ClosestOrdering& ordering, const NearListRecorder& recorder, SearchSlice& slice,
              SearchWorker& worker)
      : finder_(finder), ordering_(ordering), recorder_(recorder), slice_(slice), worker_(worker) {}

  [[nodiscard]] bool wants(double lower) {
    hand_over_if_many();
    if (recorder_.is_recording()) return true;  // a list takes what is further, too
    const double threshold = ordering_.threshold_now(worker_);
    if (lower > threshold) return false;
    finder_.set_threshold(threshold);
    return true;
  }
  void add(const LeafOf& a, const LeafOf& b) { finder_.add(a, b); }
  void add_listed(std::span<const FeaturePair> listed) {
    constexpr std::size_t each = Finder::listed_at_once;
    for (; !listed.empty(); listed = listed.subspan(std::min(each, listed.size()))) {
      finder_.add_listed(listed.first(std::min(each, listed.size())));
      hand_over_if_many();
      finder_.set_threshold(ordering_.threshold_now(worker_));
    }
  }
  bool add_blocks(std::size_t begin, std::size_t end) {
    bool complete = true;
    for (; begin < end && complete; ++begin) {
      finder_.set_threshold(ordering_.threshold_now(worker_));
      complete = finder_.add_blocks(begin, begin + 1);
      hand_over_if_many();
    }
    return complete;
  }
  void finish() { finder_.finish(); }

 private:
  void hand_over_if_many() {
    ordering_.hand_over_if_many(slice_, worker_);
    recorder_.drop_if_too_long(slice_);
  }

  Finder& finder_;
  ClosestOrdering& ordering_;
  const NearListRecorder& recorder_;
  SearchSlice& slice_;
  SearchWorker& worker_;
};

}  // namespace graze
