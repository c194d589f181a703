#pragma once

#include <cstddef>
#include <cstdint>

#include "core/mesh/pair_room.hpp"
#include "core/pair/pair_counters.hpp"
#include "search/closest/closest_search.hpp"
#include "search/contacts/contact_search.hpp"
#include "search/workers/search_scratch.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/searched_pair.hpp"
#include "vertices/near_vertices.hpp"

namespace graze {

/// One query about one pair of surfaces: DMV, DV and contact determination, as stages of slices. It searches
/// for contacts. Where none are wanted, or where there are none, it searches for the closest points.
///
/// Slices may run on any threads in any order. Between stages `advance` puts their results together in their
/// order, on one thread.
class PairSearch {
 public:
  /// Begins a query. The arguments that are pointed to have to stay until it is answered. `sliced`: a stage
  /// may be cut into many slices.
  void begin(const Surface& a, const Surface& b, const PairQuery& query, LeafFront& front, PairAnswer& answer,
             bool sliced);

  /// Goes on to the next stage of several slices; true when the answer is there instead. Otherwise each of
  /// the slices below `slice_count` is to be run once, and then this called again.
  bool advance(SearchScratch& scratch, PairCounters& counters);
  [[nodiscard]] std::size_t slice_count() const;
  void run_slice(std::size_t index, SearchScratch& scratch, PairCounters& counters);

  /// Reserves as much as another search has. Neither is cut into slices.
  void reserve_as(const PairSearch& other);
  void reserve(const PairRoom& room);
  void reserve_for_solids() {
    contacts_.reserve_for_solids();
    closest_.reserve_for_solids();
  }
  void reserve_for_limit(std::size_t most, const PairRoom& room) { contacts_.reserve_for_limit(most, room); }
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The search that is under way.
  enum class Phase : std::uint8_t { start, contacts, closest, done };

  void go_on(SearchWorker& worker);
  void next_stage(SearchWorker& worker);
  SearchProgress end_stage(SearchWorker& worker);
  SearchProgress begin_search(SearchWorker& worker);
  SearchProgress complete_solids(SearchWorker& worker);
  void run(std::size_t index, SearchWorker& worker);
  void give_up();

  SearchedPair pair_;
  SearchSlices slices_{pair_};
  NearBlocks near_blocks_;  ///< for the vertices of either search
  ContactSearch contacts_{pair_, slices_, near_blocks_};
  ClosestSearch closest_{pair_, slices_, near_blocks_};
  Phase phase_ = Phase::done;
};

}  // namespace graze
