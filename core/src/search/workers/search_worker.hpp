#pragma once

#include "search/workers/search_scratch.hpp"
#include "search/workers/searched_pair.hpp"
#include "walk/dmv.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

/// One thread's view of a search.
class SearchWorker {
 public:
  SearchWorker(const SearchedPair& searched, SearchScratch& given, PairCounters& counters)
      : scratch(given),
        time(searched.query.deadline, decisions_),
        pair{*searched.a, *searched.b, decisions_, time.is_set() ? &time : nullptr, searched.query.groups},
        meter(searched.query, counters, pair.time),
        leaf_pairs(pair, searched.query, given.leaf_pairs, meter) {
    scratch.features.begin();
  }
  /// Call it before testing some of the leaf pairs found: all slices see them in one frame.
  void begin_leaves(const LeafPairList& found) {
    if (!found.leaves.empty()) begin_leaves(found.leaves.front().pair);
  }
  void begin_leaves(const RegionPair& first) {
    scratch.features.begin({leaf_pairs.leaf_a(first).box, leaf_pairs.leaf_b(first).box});
  }
  /// Before features that are wherever the two surfaces are near.
  void begin_listed() {
    const auto overlap = [](const Box& of, const Box& by) {
      const double reach = (by.max - by.min).maxCoeff() / 16;
      const Box near{of.min.cwiseMax((by.min.array() - reach).matrix()),
                     of.max.cwiseMin((by.max.array() + reach).matrix())};
      return (near.min.array() <= near.max.array()).all() ? near : of;
    };
    scratch.features.begin({overlap(pair.a.box(), pair.b.box()), overlap(pair.b.box(), pair.a.box())});
  }
  ~SearchWorker() {
    meter.counters().discarded_in_float += decisions_.discarded_in_float;
    meter.counters().named_in_float += decisions_.named_in_float;
    meter.counters().decided_in_double += decisions_.in_double;
    meter.counters().exact_decisions += decisions_.exact;
  }
  SearchWorker(const SearchWorker&) = delete;
  SearchWorker& operator=(const SearchWorker&) = delete;

 private:
  DecisionCount decisions_;

 public:
  SearchScratch& scratch;
  TimeLimit time;
  const SurfacePair pair;
  WorkMeter meter;
  LeafPairs leaf_pairs;
};

}  // namespace graze
