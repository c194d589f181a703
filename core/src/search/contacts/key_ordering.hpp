#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "measure/nearest_keys.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"

namespace graze {

/// A range of all keys, and from where they come; sorted those that are contacts.
struct Stretch {
  std::size_t begin;
  std::size_t end;
  struct {
    std::size_t begin = 0;
    std::size_t end = 0;
  } runs;
  bool complete = true;
};

/// The keys of all contacts that a search has found.
struct OrderedKeys {
  std::vector<FeaturePairKey> keys;
  std::vector<Stretch> stretches;  ///< of `keys`, sorted and each key once
  /// The nearest of all, also of those that a limit leaves out. It is not there where none is left out.
  std::optional<FeaturePairKey> lowest;

  [[nodiscard]] std::size_t count() const;
};

/// The part of a search for contacts that orders the keys of all slices. There is one for all keys, and one
/// for the closest.
class KeyOrdering {
 public:
  KeyOrdering(const SearchedPair& pair, SearchSlices& slices, OrderedKeys& ordered)
      : pair_(pair), slices_(slices), ordered_(ordered) {}
  KeyOrdering(const KeyOrdering&) = delete;
  KeyOrdering& operator=(const KeyOrdering&) = delete;
  virtual ~KeyOrdering() = default;

  /// Begins a search. `may_repeat_features`: two features may meet in several pieces, of which the nearest
  /// stands for them.
  virtual void begin(bool may_repeat_features);
  /// Takes the keys of a slice that has found all of its own. Any number of threads, one for each slice.
  virtual void take(SearchSlice& slice, SearchWorker& worker) = 0;
  /// Begins to order what all slices gave. There is a stage of stretches unless it is done at once: the
  /// result says whether.
  [[nodiscard]] virtual bool begin_ordering(SearchWorker& worker) = 0;
  /// Orders a stretch. Any number of threads, one for each stretch.
  virtual void order(Stretch& stretch, SearchWorker& worker) = 0;

 protected:
  /// Sorts keys, and returns how many of the first are contacts.
  [[nodiscard]] std::size_t sort(std::span<FeaturePairKey> keys, SearchWorker& worker) const;

  const SearchedPair& pair_;
  SearchSlices& slices_;
  OrderedKeys& ordered_;

 private:
  bool may_repeat_features_ = false;
};

/// Orders all keys. Those of many slices go into bins, and each stretch sorts some bins.
class AllOrdering final : public KeyOrdering {
 public:
  using KeyOrdering::KeyOrdering;
  void take(SearchSlice& slice, SearchWorker& worker) override;
  [[nodiscard]] bool begin_ordering(SearchWorker& worker) override;
  void order(Stretch& stretch, SearchWorker& worker) override;
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(runs_); }

 private:
  void order_only_slice(SearchWorker& worker);
  void cut_into_stretches();

  std::vector<std::span<const FeaturePairKey>> runs_;  ///< of the slices' keys, by bins
};

/// Keeps the closest keys, so many at most. Slices hand their keys over to one list.
class ClosestOrdering final : public KeyOrdering {
 public:
  ClosestOrdering(const SearchedPair& pair, SearchSlices& slices, OrderedKeys& ordered, NearestKeys& nearest)
      : KeyOrdering(pair, slices, ordered), nearest_(nearest) {}
  void begin(bool may_repeat_features) override;
  void take(SearchSlice& slice, SearchWorker& worker) override { hand_over(slice, worker); }
  [[nodiscard]] bool begin_ordering(SearchWorker& worker) override;
  void order(Stretch& /*stretch*/, SearchWorker& /*worker*/) override {}

  /// How near contacts are that may be among those that are kept. Any thread may ask; it shrinks meanwhile.
  [[nodiscard]] double threshold_now(const SearchWorker& worker) const;
  /// Takes a slice's keys, so that it need not keep them, if they are many.
  void hand_over_if_many(SearchSlice& slice, SearchWorker& worker);

 private:
  void hand_over(SearchSlice& slice, SearchWorker& worker);

  NearestKeys& nearest_;
};

}  // namespace graze
