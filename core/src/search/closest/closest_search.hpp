#pragma once

#include <cstddef>
#include <cstdint>

#include "core/mesh/pair_room.hpp"
#include "leaves/touching_edges.hpp"
#include "search/workers/search_progress.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"
#include "vertices/near_vertices.hpp"
#include "walk/closest_range.hpp"
#include "walk/touching_order.hpp"

namespace graze {

/// The search for the closest points of two surfaces, by branch and bound. Surfaces that touched mostly still
/// do, and then one point where they do is enough. So it searches for that first, alone.
class ClosestSearch {
 public:
  ClosestSearch(const SearchedPair& pair, SearchSlices& slices, NearBlocks& near_blocks)
      : pair_(pair), slices_(slices), near_blocks_(near_blocks) {}

  SearchProgress begin(SearchWorker& worker);
  /// Puts the results of the stage together, whose slices have all been run, and begins the next.
  SearchProgress next_stage(SearchWorker& worker);
  void run(SearchSlice& slice, SearchWorker& worker);

  /// The edges that touch, of a pair with a solid. It is null if the search has not found all of them: it
  /// ends early in a pair of more than two leaves.
  [[nodiscard]] const TouchingEdges* touching() const { return has_touching_ ? &touching_ : nullptr; }

  void reserve_as(const ClosestSearch& other);
  void reserve(const PairRoom& room);
  void reserve_for_solids() { touching_.reserve(); }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The purpose of the slices that were made last.
  enum class Stage : std::uint8_t {
    approach,  ///< pairs of leaves where the closest points may be
    closest,   ///< the closest points in them
  };
  /// The source of the pairs of leaves that are tested.
  enum class LeafSource : std::uint8_t {
    walk,            ///< a walk from the roots
    front,           ///< the front of the last query
    front_if_apart,  ///< that front, which says that no edge pierces a face
  };

  SearchProgress begin_vertices(SearchWorker& worker);
  SearchProgress begin_surfaces(SearchWorker& worker);
  SearchProgress walk_anew(SearchWorker& worker);
  void choose_source();
  SearchProgress approach(SearchWorker& worker);
  void run_approach(SearchSlice& slice, SearchWorker& worker);
  SearchProgress begin_closest(SearchWorker& worker);
  SearchProgress finish(SearchWorker& worker);
  bool test_leaves(std::size_t begin, std::size_t end, ClosestFound& found, SearchWorker& worker);
  bool test_leaves(LeafPair& leaves, ClosestRange& range, SearchWorker& worker);
  void seed(SearchSlice& slice) const;
  void merge_slices(SearchWorker& worker);
  SearchProgress find_nothing(SearchWorker& worker);
  SearchProgress answer_nothing();
  void raise_bounds_of_front();
  void set_apart();
  SearchProgress report(SearchWorker& worker);

  // Points at distance 0:
  SearchProgress begin_touching(SearchWorker& worker);
  SearchProgress test_front(SearchWorker& worker);
  SearchProgress walk_touching(SearchWorker& worker);
  [[nodiscard]] bool test_overlapping(const RegionPair& start, const TouchingOrder& order,
                                      ClosestRange& range, SearchWorker& worker);
  [[nodiscard]] TouchingOrder touching_order() const;
  void sort_front();

  [[nodiscard]] Ties ties() const;
  [[nodiscard]] bool is_one_pair_of_leaves() const;
  [[nodiscard]] bool about_vertices() const { return is_about_vertices(pair_.query.detail); }
  [[nodiscard]] double unlisted_lower_bound() const;
  [[nodiscard]] auto offering_middles(ClosestRange& range) const;

  const SearchedPair& pair_;
  SearchSlices& slices_;
  NearBlocks& near_blocks_;
  Stage stage_ = Stage::approach;
  LeafSource source_ = LeafSource::walk;
  bool is_bounded_ = false;     ///< by the last answer, so that middle vertices need not be asked
  bool are_many_near_ = false;  ///< pairs of leaves that are no further than the bound known before
  ClosestFound closest_;
  TouchingEdges touching_;
  bool has_touching_ = false;
};

}  // namespace graze
