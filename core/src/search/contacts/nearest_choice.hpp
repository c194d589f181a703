#pragma once

#include <optional>

#include "leaves/nearest_of_vertices.hpp"
#include "search/contacts/sunk_edges.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"

namespace graze {

/// Chooses what is nearest to each vertex out of what many slices have found. Each slice takes a range of all
/// vertices, and reads what all slices have found of them.
class NearestChoice {
 public:
  NearestChoice(const SearchedPair& pair, SearchSlices& slices, const SunkEdges& sunk_edges)
      : pair_(pair), slices_(slices), sunk_edges_(sunk_edges) {}

  /// Gives each of the first slices a range of the vertices.
  void begin();
  /// Appends to a slice's own keys what is nearest to the vertices of its range, and settles its edges that
  /// may be sunk. Any number of threads, one for each slice.
  void run(SearchSlice& slice, SearchWorker& worker) const;

 private:
  const SearchedPair& pair_;
  SearchSlices& slices_;
  const SunkEdges& sunk_edges_;
};

/// The nearest of the folds that slices have found. It is not there where there is none.
std::optional<NearKey> nearest_fold(const SearchSlices& slices, const SurfacePair& pair);

}  // namespace graze
