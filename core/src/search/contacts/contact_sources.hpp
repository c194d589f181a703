#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <span>
#include <variant>

#include "core/pair/near_list.hpp"
#include "leaves/layout/leaf_features.hpp"
#include "search/workers/search_progress.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"
#include "vertices/near_vertices.hpp"

// The sources of a search for contacts: from where its candidates come, the pairs of features that may be in
// contact. A search chooses one when it begins. Every source has these functions:
//
//   begin   begins the stage that finds the candidates. The stage has no slices where they are known.
//   find    runs a slice of that stage.
//   cut     makes the slices of the next stage out of all candidates.
//   feed    gives a slice's candidates to a collector (key_collectors.hpp).
//   end     is called once all slices have been fed.

namespace graze {

/// The finders of keys that take two leaves, listed pairs of features, or blocks of vertices.
template <typename Finder>
concept TakesLeaves = requires(Finder& finder, const LeafOf& leaf) {
  finder.add(leaf, leaf);
};
template <typename Finder>
concept TakesListed = requires(Finder& finder, std::span<const FeaturePair> listed) {
  finder.add_listed(listed);
};
template <typename Finder>
concept TakesBlocks = requires(Finder& finder) {
  { finder.add_blocks(std::size_t{}, std::size_t{}) } -> std::same_as<bool>;
};

/// Which candidates a search for contacts wants: those that are in contact, or to be listed.
struct Wanted {
  double distance = 0;      ///< strictly nearer ones
  bool may_pierce = false;  ///< surfaces that touch may pierce each other, which counts at every distance

  /// Whether regions at least `lower` apart may have one before the surfaces have moved by `slack`.
  [[nodiscard]] bool operator()(double lower, double slack) const {
    const double nearest = std::max(0.0, lower - slack);
    return nearest < distance || (may_pierce && nearest == 0);
  }
};

/// A source of pairs of leaves that were found by their boxes.
class LeafSource {
 public:
  /// `nearest_first`: a limit will soon tell which contacts are too far to be kept.
  LeafSource(const SearchedPair& pair, SearchSlices& slices, const Wanted& wanted, bool nearest_first)
      : pair_(&pair), slices_(&slices), wanted_(wanted), nearest_first_(nearest_first) {}

  void cut();
  template <typename Collector>
  requires TakesLeaves<typename Collector::Finder>
  void feed(SearchSlice& slice, SearchWorker& worker, Collector& collector) const {
    feed(slice, worker, collector, [] { return true; });
  }
  static void end(SearchWorker& /*worker*/) {}

 protected:
  /// `spend()` is called for each pair of leaves; it is false when the budget is spent.
  template <typename Collector, typename Spend>
  void feed(SearchSlice& slice, SearchWorker& worker, Collector& collector, const Spend& spend) const;

  const SearchedPair* pair_;
  SearchSlices* slices_;
  Wanted wanted_;
  bool nearest_first_;
};

/// The pairs of leaves that a walk from the roots reaches. They become the front for later queries.
class WalkSource : public LeafSource {
 public:
  using LeafSource::LeafSource;
  SearchProgress begin(SearchWorker& worker);
  void find(SearchSlice& slice, SearchWorker& worker) const;
  void cut(SearchWorker& worker);
};

/// The pairs of leaves of the front that an earlier query left, where it has all that are wanted.
class FrontSource : public LeafSource {
 public:
  using LeafSource::LeafSource;
  SearchProgress begin(SearchWorker& worker);
  void find(SearchSlice& slice, SearchWorker& worker) const;
  void cut(SearchWorker& worker);
  /// No walk has counted these pairs against the budget.
  template <typename Collector>
  requires TakesLeaves<typename Collector::Finder>
  void feed(SearchSlice& slice, SearchWorker& worker, Collector& collector) const {
    LeafSource::feed(slice, worker, collector, [&] { return worker.meter.spend(); });
  }
};

/// The pairs of features of the near list that an earlier query left.
class ListSource {
 public:
  ListSource(const SearchedPair& pair, SearchSlices& slices) : pair_(&pair), slices_(&slices) {}

  SearchProgress begin(SearchWorker& worker);
  static void find(SearchSlice& /*slice*/, SearchWorker& /*worker*/) {}
  void cut(SearchWorker& worker);
  template <typename Collector>
  requires TakesListed<typename Collector::Finder>
  void feed(SearchSlice& slice, SearchWorker& worker, Collector& collector) const;
  static void end(SearchWorker& worker) { ++worker.meter.counters().pairs_by_list; }

 private:
  /// How many listed pairs cost one unit of the budget. Testing two leaves costs one as well.
  static constexpr std::size_t listed_in_one = 64;

  const SearchedPair* pair_;
  SearchSlices* slices_;
};

/// Blocks of vertices that are found by their boxes alone, without a walk.
class BlockSource {
 public:
  BlockSource(const SearchedPair& pair, SearchSlices& slices, NearBlocks& blocks, double distance)
      : pair_(&pair), slices_(&slices), blocks_(&blocks), distance_(distance) {}

  SearchProgress begin(SearchWorker& worker);
  static void find(SearchSlice& /*slice*/, SearchWorker& /*worker*/) {}
  void cut(SearchWorker& worker);
  template <typename Collector>
  requires TakesBlocks<typename Collector::Finder>
  void feed(SearchSlice& slice, SearchWorker& /*worker*/, Collector& collector) const {
    slice.complete = collector.add_blocks(slice.begin, slice.end);
  }
  static void end(SearchWorker& /*worker*/) {}

 private:
  const SearchedPair* pair_;
  SearchSlices* slices_;
  NearBlocks* blocks_;
  double distance_;
};

using ContactSource = std::variant<WalkSource, FrontSource, ListSource, BlockSource>;

template <typename Collector, typename Spend>
void LeafSource::feed(SearchSlice& slice, SearchWorker& worker, Collector& collector,
                      const Spend& spend) const {
  worker.begin_leaves(slices_->found());
  const Wanted wanted = wanted_;
  const double pierced = wanted.distance - pair_->query.threshold;  // what may come to pierce is listed, too
  for (std::size_t i = slice.begin; i < slice.end; ++i) {
    const LeafPair& leaves = slices_->found().leaves[i];
    slice.complete = spend();
    if (!slice.complete) return;
    if (!wanted(leaves.lower, 0) || !collector.wants(leaves.lower)) continue;
    if (!wanted(worker.leaf_pairs.lower_by_corners(leaves.pair), 0)) continue;
    if (!wanted(worker.leaf_pairs.lower_since_rest(leaves.pair, pierced), 0)) continue;
    ++worker.meter.counters().leaf_pairs_tested;
    collector.add(worker.leaf_pairs.leaf_a(leaves.pair), worker.leaf_pairs.leaf_b(leaves.pair));
  }
  collector.finish();
}

template <typename Collector>
requires TakesListed<typename Collector::Finder>
void ListSource::feed(SearchSlice& slice, SearchWorker& worker, Collector& collector) const {
  const auto listed = std::span(pair_->front->near->pairs).subspan(slice.begin, slice.end - slice.begin);
  for (std::size_t i = 0; i < listed.size() && slice.complete; i += listed_in_one)
    slice.complete = worker.meter.spend();
  if (!slice.complete) return;
  worker.begin_listed();
  collector.add_listed(listed);
  collector.finish();
}

}  // namespace graze
