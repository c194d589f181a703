#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "closest_features/key_bins.hpp"
#include "core/mesh/pair_room.hpp"
#include "leaves/nearest_features.hpp"
#include "leaves/nearest_of_vertices.hpp"
#include "leaves/piercing_edges.hpp"
#include "leaves/touching_edges.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"
#include "walk/closest_range.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

/// The results of a slice of a search for contacts.
struct FoundContacts {
  std::vector<FeaturePair> near;
  bool near_is_too_long = false;  ///< and was forgotten
  std::vector<FeaturePairKey> keys;
  std::vector<BinRun> runs;                ///< of `keys`, where there are many slices
  TouchingEdges touching;                  ///< collected where the pair has a solid
  PiercingEdges piercing;                  ///< collected for details that list them
  std::vector<EdgesIfSunk> edges_if_sunk;  ///< for `ContactDetail::nearest`
  std::optional<NearKey> fold;  ///< the nearest where one feature is a fold, for `ContactDetail::nearest`
  std::vector<VertexNearest> of_vertices;  ///< what is nearest to each vertex, by vertices
  std::size_t first = 0;                   ///< the index of the first contact of a range of keys
  double nearest = 0;                      ///< the least distance of the contacts that were measured
};

/// A part of a stage, which one thread runs. It reads what the stage has in common, and writes its own
/// results, which both searches keep here to use the same memory.
struct SearchSlice {
  std::span<const RegionPair> start;  ///< where to walk from
  std::size_t begin = 0;              ///< a range of a front, a list, of leaf pairs, of blocks or of keys
  std::size_t end = 0;
  bool complete = true;
  LeafPairList found;
  FoundContacts contacts;
  ClosestFound closest;
};

/// The slices of one stage of a search, and the leaf pairs that they found together. How a stage is cut
/// depends on the surfaces and the query only, so the answer does not depend on who ran what.
class SearchSlices {
 public:
  explicit SearchSlices(const SearchedPair& pair) : pair_(pair) {}

  /// Begins a query. `may_cut`: a stage may have more than one slice.
  void begin(bool may_cut);
  [[nodiscard]] bool may_cut() const { return may_cut_; }

  /// The slices of this stage, in their order.
  [[nodiscard]] std::span<SearchSlice> all() { return std::span(slices_).first(count_); }
  [[nodiscard]] std::span<const SearchSlice> all() const { return std::span(slices_).first(count_); }
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] SearchSlice& operator[](std::size_t index) { return slices_[index]; }
  [[nodiscard]] bool are_complete() const;

  void clear() { count_ = 0; }
  /// Adds slices for a range, of `each` elements.
  void add_range(std::size_t begin, std::size_t end, std::size_t each);
  /// Makes slices of the front that the last query left.
  void cut_front();
  /// Walks from the roots until there is enough for many slices, and makes these. `keep` and `meet` are as in
  /// `LeafPairs::walk`. What the walk found on the way belongs to the first slice.
  template <typename Keep, typename Meet>
  void walk(SearchWorker& worker, const Keep& keep, const Meet& meet);

  /// Puts the leaf pairs of all slices together.
  void gather_found();
  [[nodiscard]] LeafPairList& found() { return found_; }
  /// Makes the leaf pairs found by a walk the front. Leaves out those that do not matter before the surfaces
  /// have moved by the slack, for a search within `wanted`.
  void keep_front(double wanted, SearchWorker& worker);

  /// The slice that a query has that is not cut. It is there after `reserve` and `reserve_as`.
  [[nodiscard]] SearchSlice& first() { return slices_.front(); }
  [[nodiscard]] const SearchSlice& first() const { return slices_.front(); }
  /// Whether no query has had a slice yet.
  [[nodiscard]] bool are_unused() const { return slices_.empty(); }
  void reserve_as(const SearchSlices& other);
  void reserve(const PairRoom& room);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  // A slice is some tens of microseconds of work, against about one for giving it to a thread. Below that a
  // pair is not cut at all.
  static constexpr std::size_t roots_of_sliced_walk = 1024;
  static constexpr std::size_t roots_each = 64;
  static constexpr std::size_t front_pairs_each = 256;

  SearchSlice& add();
  void add_walks(std::span<const RegionPair> start, std::size_t each);

  const SearchedPair& pair_;
  bool may_cut_ = false;
  std::vector<SearchSlice> slices_;  ///< kept longer than `count_` for their memory
  std::size_t count_ = 0;
  std::vector<RegionPair> roots_;  ///< where the slices walk from
  LeafPairList found_;
};

template <typename Keep, typename Meet>
void SearchSlices::walk(SearchWorker& worker, const Keep& keep, const Meet& meet) {
  clear();
  SearchSlice& first = add();
  const std::size_t most = may_cut_ ? roots_of_sliced_walk : std::numeric_limits<std::size_t>::max();
  first.complete = worker.leaf_pairs.walk_all(keep, meet, first.found, most);
  if (!first.complete) return;
  const auto rest = worker.leaf_pairs.front();
  roots_.assign(rest.begin(), rest.end());
  add_walks(roots_, roots_each);
}

/// Rounds a bound down to half of the memory, as fronts keep it. It is not negative.
float rounded_down(double lower);

}  // namespace graze
