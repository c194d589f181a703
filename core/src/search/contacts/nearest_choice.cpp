#include "search/contacts/nearest_choice.hpp"

#include <algorithm>

#include "leaves/nearest_features.hpp"

namespace graze {
namespace {

/// The most slices that share the vertices out among them.
constexpr std::size_t most_that_choose = 64;

}  // namespace

void NearestChoice::begin() {
  const std::size_t vertices = VertexOfPair::count(*pair_.a, *pair_.b);
  const std::size_t parts = std::min(slices_.size(), most_that_choose);
  for (std::size_t i = 0; i < slices_.size(); ++i) {
    slices_[i].begin = std::min(i, parts) * vertices / parts;
    slices_[i].end = std::min(i + 1, parts) * vertices / parts;
  }
}

void NearestChoice::run(SearchSlice& slice, SearchWorker& worker) const {
  const auto comes_before = [](const VertexNearest& nearest, VertexOfPair vertex) {
    return nearest.vertex < vertex;
  };
  sunk_edges_.settle(slice.contacts, worker);
  if (slice.begin == slice.end) return;
  const VertexOfPair begin = VertexOfPair::at(slice.begin, *pair_.a);
  const VertexOfPair end = VertexOfPair::at(slice.end, *pair_.a);
  NearestOfVertices& nearest = worker.scratch.nearest_of_vertices;
  nearest.clear();
  for (const SearchSlice& found : slices_.all()) {
    const auto& all = found.contacts.of_vertices;
    auto each = std::lower_bound(all.begin(), all.end(), begin, comes_before);
    for (; each != all.end() && each->vertex < end; ++each) nearest.offer(worker.pair, *each);
  }
  append_below(worker.pair, nearest.all(), pair_.query.threshold, slice.contacts.keys);
}

std::optional<NearKey> nearest_fold(const SearchSlices& slices, const SurfacePair& pair) {
  std::optional<NearKey> nearest;
  for (const SearchSlice& slice : slices.all()) {
    if (!slice.contacts.fold) continue;
    if (nearest)
      keep_nearer(pair, *nearest, *slice.contacts.fold);
    else
      nearest = slice.contacts.fold;
  }
  return nearest;
}

}  // namespace graze
