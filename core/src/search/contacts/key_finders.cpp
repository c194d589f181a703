#include "search/contacts/key_finders.hpp"

#include <algorithm>

#include "leaves/closest_vertices.hpp"

namespace graze {
namespace {

/// Begins the memory that the nearest of each vertex are found in.
NearestFound emptied(const FinderInput& input) {
  input.worker.scratch.nearest_of_vertices.clear();
  FoundContacts& found = input.found;
  return {found.keys, found.edges_if_sunk, found.piercing, found.fold,
          input.worker.scratch.nearest_of_vertices};
}

}  // namespace

void RegionFinder::add(const LeafOf& a, const LeafOf& b) {
  const SurfacePair& pair = input_.worker.pair;
  SearchScratch& scratch = input_.worker.scratch;
  const auto key = closest_vertices(pair, a, b, scratch.features, scratch.nearest_of_leaves);
  if (key && is_closer_than(pair, *key, input_.threshold)) input_.found.keys.push_back(*key);
}

VertexFinder::VertexFinder(const FinderInput& input) : input_(input), threshold_(input.threshold) {}

void VertexFinder::add_listed(std::span<const FeaturePair> listed) {
  const SurfacePair& pair = input_.worker.pair;
  for (const FeaturePair& vertices : listed) {
    const FeaturePairKey key =
        FeaturePairKey::of(vertex_piece(vertices.a.index), vertex_piece(vertices.b.index));
    pair.check_time();
    if (is_closer_than(pair, key, threshold_)) input_.found.keys.push_back(key);
  }
}

/// Returns false when the budget ran out.
bool VertexFinder::add_blocks(std::size_t begin, std::size_t end) {
  SearchWorker& worker = input_.worker;
  NearVertices vertices(worker.pair, input_.threshold + input_.listing.slack, input_.blocks,
                        worker.scratch.vertices);
  return vertices.append_near(begin, end, threshold_, worker.meter, input_.found.keys, input_.listing);
}

FeatureFinder::FeatureFinder(const FinderInput& input)
    : CloseFeatures(input.worker.pair, input.threshold, input.worker.scratch.features, input.found.keys,
                    input.found.piercing, input.listing, input.touching) {}

NearestFinder::NearestFinder(const FinderInput& input)
    : NearestFeatures(input.worker.pair, input.threshold, input.worker.scratch.features, emptied(input),
                      input.listing, input.touching),
      input_(input) {}

void NearestFinder::finish() {
  NearestFeatures::finish();
  const auto nearest = input_.worker.scratch.nearest_of_vertices.all();
  if (input_.is_only_slice)
    return append_below(input_.worker.pair, nearest, input_.threshold, input_.found.keys);
  auto& of_vertices = input_.found.of_vertices;
  of_vertices.assign(nearest.begin(), nearest.end());
  std::sort(of_vertices.begin(), of_vertices.end(),
            [](const VertexNearest& left, const VertexNearest& right) { return left.vertex < right.vertex; });
}

}  // namespace graze
