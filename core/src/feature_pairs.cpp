#include "feature_pairs.hpp"

#include <algorithm>

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

/// What a query for contacts wants: what is below the threshold, and piercing at every threshold, so that
/// overlapping boxes are always looked into.
struct BelowThreshold {
  double threshold;

  [[nodiscard]] double limit() const { return threshold; }
  [[nodiscard]] bool keep(double lower) const { return lower < threshold || lower == 0; }
  void left_out(double /*limit*/) const {}
};

}  // namespace

bool find_feature_pairs(const SurfacePair& pair, const PairQuery& query, LeafPairs& leaf_pairs,
                        LeafScratch& scratch, std::vector<ContactName>& names) {
  BelowThreshold range{query.threshold};
  const bool complete = leaf_pairs.each_below_threshold(true, [&](const RegionPair& leaves) {
    for_each_name(
        pair, {leaf_pairs.leaf_a(leaves), leaf_pairs.box_a(leaves)},
        {leaf_pairs.leaf_b(leaves), leaf_pairs.box_b(leaves)}, scratch, range, [&](const ContactName& name) {
          const bool edge_pierces = name.meeting == Meeting::pierced && name.kind == ContactKind::EF;
          if (edge_pierces || is_closer_than(pair, name, query.threshold)) names.push_back(name);
        });
  });
  keep_nearest_of_each(pair, names);
  return complete;
}

}  // namespace graze
