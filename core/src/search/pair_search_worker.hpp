#pragma once

#include "search/pair_search.hpp"
#include "walk/dmv.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

inline constexpr std::size_t least_limit =
    16;  ///< neither fronts nor lists are kept where all have to be shorter

/// One thread's view of the search.
class PairSearch::Worker {
 public:
  Worker(const PairSearch& search, SearchScratch& given, PairCounters& counters)
      : scratch(given),
        time(search.query_.deadline, decisions_),
        pair{*search.a_, *search.b_, decisions_, time.is_set() ? &time : nullptr},
        meter(search.query_, counters, pair.time),
        leaf_pairs(pair, search.query_, given.leaf_pairs, meter) {
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
  ~Worker() {
    meter.counters().discarded_in_float += decisions_.discarded_in_float;
    meter.counters().named_in_float += decisions_.named_in_float;
    meter.counters().decided_in_double += decisions_.in_double;
    meter.counters().exact_decisions += decisions_.exact;
  }
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

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
