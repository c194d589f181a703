#include "feature_pairs.hpp"

#include <algorithm>

#include "bounds.hpp"

namespace graze {
namespace {

/// Where two features meet in several pieces (a fold and a triangle, two crossings), the nearest stands for
/// them; a piercing sorts first, and of equally near ones the first.
void keep_nearest_of_each(const SurfacePair& pair, std::vector<ContactName>& names) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (kept == 0 || !names[kept - 1].same_features(names[i]))
      names[kept++] = names[i];
    else if (compare_distances(pair, names[i], names[kept - 1]) < 0)
      names[kept - 1] = names[i];
  }
  names.resize(kept);
}

}  // namespace

bool find_feature_pairs(const SurfacePair& pair, const PairQuery& query, FeatureScratch& scratch,
                        WorkMeter& meter, std::vector<ContactName>& names) {
  const RegionTree& tree_a = pair.a.mesh().regions();
  const RegionTree& tree_b = pair.b.mesh().regions();
  const auto boxes_a = pair.a.face_boxes();
  const auto boxes_b = pair.b.face_boxes();
  // Piercing counts at every threshold, so overlapping boxes are always looked into.
  const auto keep = [&](double lower) { return lower < query.threshold || lower == 0; };
  const auto near = [&](const RegionPair& regions) {
    return keep(lower_distance(boxes_a[regions.a], boxes_b[regions.b]));
  };
  const bool complete = dmv(
      tree_a, tree_b, scratch.dmv, meter,
      [&](const RegionPair& regions, const Region&, const Region&) { return near(regions); },
      [&](const RegionPair& regions, const Region& leaf_a, const Region& leaf_b) {
        if (!near(regions)) return;
        ++meter.counters().leaf_pairs_tested;
        for_each_name(pair, leaf_a, boxes_a[regions.a], leaf_b, boxes_b[regions.b], scratch.leaves, keep,
                      [&](const ContactName& name) {
                        const bool edge_pierces =
                            name.meeting == Meeting::pierced && name.kind == ContactKind::EF;
                        if (edge_pierces || is_closer_than(pair, name, query.threshold))
                          names.push_back(name);
                      });
      });
  keep_nearest_of_each(pair, names);
  return complete;
}

}  // namespace graze
