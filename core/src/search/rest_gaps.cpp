#include "core/search/rest_gaps.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/pair/group_filter.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "walk/closest_range.hpp"

namespace graze {
namespace {

/// Gaps beyond this part of a leaf's size are not told apart.
constexpr double most_leaf_sizes = 0.5;

/// The least distance at rest of a leaf's features from others that they are tested against, for each leaf.
/// `rest` is refitted.
std::vector<float> gaps_of(const Surface& rest, const SelfExclusion& exclusion) {
  const FeatureFilter filter(FeatureFilter(nullptr, nullptr), SelfQuery{&exclusion});
  SearchedPair searched{&rest, &rest, {}, nullptr, nullptr};
  searched.query.detail = ContactDetail::none;
  searched.query.reach = most_leaf_sizes * rest.leaf_size();
  searched.query.groups = &filter;
  SearchScratch scratch;
  PairCounters counters;
  SearchWorker worker(searched, scratch, counters);
  const double reach = searched.query.reach;
  LeafPairList near;
  worker.leaf_pairs.walk_all([&](double lower, double /*slack*/) { return lower < reach; },
                             [](const RegionPair&) {}, near);
  std::vector<float> gaps(rest.mesh().regions().region_count(), rounded_down(reach));
  worker.begin_leaves(near);
  for (const LeafPair& leaves : near.leaves) {
    ClosestFound found;
    ClosestRange range(worker.pair, searched.query, Ties::lowest, found);
    range.offer_features(worker.leaf_pairs.leaf_a(leaves.pair), worker.leaf_pairs.leaf_b(leaves.pair),
                         scratch.features);
    // The upper bound is good to 2^-40.
    const double nearest = std::min({found.closest.upper * (1 - 0x1p-38), found.lower, reach});
    const float gap = rounded_down(nearest);
    for (const std::uint32_t leaf : {leaves.pair.a, leaves.pair.b}) gaps[leaf] = std::min(gaps[leaf], gap);
  }
  return gaps;
}

std::vector<Box> boxes_of(const Surface& rest) {
  const RegionTree& tree = rest.mesh().regions();
  std::vector<Box> boxes(tree.region_count());
  for (std::uint32_t index = 0; index < tree.region_count(); ++index)
    if (tree.region(index).is_leaf()) boxes[index] = rest.box_now(tree.region(index), RefitOf::faces);
  return boxes;
}

}  // namespace

std::shared_ptr<const SelfExclusion> make_self_exclusion(std::shared_ptr<const IndexedMesh> mesh,
                                                         std::uint32_t rings) {
  Surface rest(mesh);
  rest.refit(RefitOf::faces);
  // Neighbours may pierce each other, unless they share a vertex.
  const SelfExclusion of_contacts(mesh, rings);
  const SelfExclusion of_piercings(mesh, 0);
  return std::make_shared<const SelfExclusion>(
      std::move(mesh), rings,
      RestGaps{gaps_of(rest, of_contacts), gaps_of(rest, of_piercings), boxes_of(rest)});
}

}  // namespace graze
