#include "vertex_pairs.hpp"

#include "bounds.hpp"
#include "closest_set.hpp"

namespace graze {
namespace {

template <typename AtLeaves>
bool walk(const SurfacePair& pair, const PairQuery& query, VertexScratch& scratch, WorkMeter& meter,
          const AtLeaves& at_leaves) {
  const auto near = [&](const RegionPair& regions) {
    return vertex_lower_distance(pair.a, pair.b, regions) < query.threshold;
  };
  return dmv(
      pair.a.mesh().regions(), pair.b.mesh().regions(), scratch.dmv, meter,
      [&](const RegionPair& regions, const Region&, const Region&) { return near(regions); },
      [&](const RegionPair& regions, const Region& leaf_a, const Region& leaf_b) {
        if (!near(regions)) return;
        ++meter.counters().leaf_pairs_tested;
        at_leaves(leaf_a, leaf_b);
      });
}

ContactName vertex_pair(std::uint32_t a, std::uint32_t b) {
  return ContactName::of(vertex_piece(a), vertex_piece(b));
}

double lower_distance_of(const SurfacePair& pair, std::uint32_t a, std::uint32_t b) {
  return lower_distance(pair.a.position(a), pair.b.position(b));
}

}  // namespace

bool find_vertex_pairs(const SurfacePair& pair, const PairQuery& query, VertexScratch& scratch,
                       WorkMeter& meter, std::vector<ContactName>& names) {
  return walk(pair, query, scratch, meter, [&](const Region& leaf_a, const Region& leaf_b) {
    add_close_vertices(pair, leaf_a, leaf_b, query.threshold, names);
  });
}

bool find_region_pairs(const SurfacePair& pair, const PairQuery& query, VertexScratch& scratch,
                       WorkMeter& meter, std::vector<ContactName>& names) {
  return walk(pair, query, scratch, meter, [&](const Region& leaf_a, const Region& leaf_b) {
    const ContactName name = closest_vertices(pair, leaf_a, leaf_b, scratch.closest);
    if (is_closer_than(pair, name, query.threshold)) names.push_back(name);
  });
}

void add_close_vertices(const SurfacePair& pair, const Region& leaf_a, const Region& leaf_b, double limit,
                        std::vector<ContactName>& names) {
  for (const std::uint32_t a : pair.a.mesh().regions().vertices(leaf_a))
    for (const std::uint32_t b : pair.b.mesh().regions().vertices(leaf_b))
      if (lower_distance_of(pair, a, b) < limit && is_closer_than(pair, vertex_pair(a, b), limit))
        names.push_back(vertex_pair(a, b));
}

ContactName closest_vertices(const SurfacePair& pair, const Region& leaf_a, const Region& leaf_b,
                             std::vector<ContactName>& scratch) {
  ClosestSet closest(pair, Ties::lowest, scratch);
  for (const std::uint32_t a : pair.a.mesh().regions().vertices(leaf_a))
    for (const std::uint32_t b : pair.b.mesh().regions().vertices(leaf_b))
      if (lower_distance_of(pair, a, b) <= closest.upper()) closest.offer(vertex_pair(a, b));
  return closest.names().front();
}

}  // namespace graze
