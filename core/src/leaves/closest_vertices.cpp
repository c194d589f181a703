#include "leaves/closest_vertices.hpp"

#include "leaves/leaf_vertex_pairs.hpp"

namespace graze {
namespace {

FeaturePairKey vertex_pair(std::uint32_t a, std::uint32_t b) {
  return FeaturePairKey::of(vertex_piece(a), vertex_piece(b));
}

/// A range that holds pairs at most as far as the nearest so far.
struct AsNear {
  const ClosestSet& closest;

  [[nodiscard]] double limit() const { return closest.upper(); }
  [[nodiscard]] bool keep(double lower) const { return lower <= closest.upper(); }
  void left_out(double /*limit*/) const {}
};

}  // namespace

std::optional<FeaturePairKey> closest_vertices(const SurfacePair& pair, const LeafOf& leaf_a,
                                               const LeafOf& leaf_b, LeafScratch& scratch, Closest& closest) {
  closest.clear();
  ClosestSet set(pair, Ties::lowest, closest);
  const auto offer = [&](std::uint32_t a, std::uint32_t b) {
    if (pair.may_vertices(a, b)) set.offer(vertex_pair(a, b));
  };
  offer(leaf_a.region.middle, leaf_b.region.middle);
  AsNear range{set};
  for_each_vertex_pair(pair, leaf_a, leaf_b, scratch, range, offer);
  if (closest.keys.empty()) return std::nullopt;
  return set.front();
}

}  // namespace graze
