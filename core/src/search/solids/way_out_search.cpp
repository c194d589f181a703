#include "search/solids/way_out_search.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <tuple>

#include "closest_features/piercing.hpp"
#include "leaves/near_piercings.hpp"
#include "solid/highest_along.hpp"

namespace graze {
namespace {

/// Below it a contour has no direction: what is left of its area may be chance.
constexpr double least_fullness = 0.1;

/// How far points reach along a direction.
class ExtentAlong {
 public:
  explicit ExtentAlong(const Eigen::Vector3d& direction) : direction_(direction) {}
  void add(const Eigen::Vector3d& point) {
    const double along = point.dot(direction_);
    lowest_ = std::min(lowest_, along);
    highest_ = std::max(highest_, along);
  }
  [[nodiscard]] double extent() const { return std::max(0.0, highest_ - lowest_); }

 private:
  const Eigen::Vector3d& direction_;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

SearchProgress WayOutSearch::complete() {
  if (!may_cross()) return SearchProgress::answered;
  Contour contour(worker_.pair, scratch_.contour);
  if (!list_near(contour.shift_length())) return SearchProgress::gave_up;
  for (const FeaturePair& near : scratch_.near) {
    worker_.pair.check_time();
    contour.add(near);
  }
  contour.join();
  if (pair_.answer->inside == Inside::crossing || contour.crosses_either_way() || pierces()) measure(contour);
  return SearchProgress::answered;
}

/// Whether the surfaces may pass through each other, by what the answer says.
bool WayOutSearch::may_cross() const {
  const PairAnswer& answer = *pair_.answer;
  if (!answer.listed || !answer.complete || answer.distance.lower > 0) return false;
  return answer.inside == Inside::crossing || answer.inside == Inside::none;
}

/// Lists the edges and diagonals with the faces that they may cross when the surfaces move by a distance, in
/// order and each once. Returns false if the budget is spent.
bool WayOutSearch::list_near(double distance) {
  auto& near = scratch_.near;
  near.clear();
  scratch_.leaves.clear();
  const auto may_cross = [distance](double lower, double /*slack*/) { return lower <= distance; };
  if (!worker_.leaf_pairs.walk_all(
          may_cross, [](const RegionPair&) {}, scratch_.leaves))
    return false;
  worker_.begin_leaves(scratch_.leaves);
  NearPiercings piercings(worker_.pair, distance, worker_.scratch.features, near);
  for (const LeafPair& leaves : scratch_.leaves.leaves)
    piercings.add(worker_.leaf_pairs.leaf_a(leaves.pair), worker_.leaf_pairs.leaf_b(leaves.pair));
  piercings.finish();
  const auto order = [](const FeaturePair& pair) {
    return std::tie(pair.a.kind, pair.a.index, pair.b.kind, pair.b.index);
  };
  std::sort(near.begin(), near.end(),
            [&](const FeaturePair& left, const FeaturePair& right) { return order(left) < order(right); });
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return true;
}

/// Whether an edge pierces a face. Of pairs with a solid the answer says it.
bool WayOutSearch::pierces() const {
  if (pair_.query.has_solid()) return false;
  const auto pierces = [&](const FeatureRef& edge, const Surface& own, const FeatureRef& face,
                           const Surface& other) {
    return edge.kind == FeatureRefKind::edge &&
           pierced_piece(own, edge_piece(edge.index), other, face.index, worker_.pair.count).has_value();
  };
  return std::any_of(scratch_.near.begin(), scratch_.near.end(), [&](const FeaturePair& near) {
    worker_.pair.check_time();
    return pierces(near.a, *pair_.a, near.b, *pair_.b) || pierces(near.b, *pair_.b, near.a, *pair_.a);
  });
}

void WayOutSearch::measure(const Contour& contour) const {
  const ContourArea area = contour.area();
  WayOut& way = pair_.answer->way_out;
  way.point = area.middle;
  way.fullness = area.fullness;
  if (!(area.fullness >= least_fullness)) return;
  way.direction = area.area.normalized();
  way.thickness = thickness_along(way.direction, contour);
  way.extent = extent_along(way.direction);
}

double WayOutSearch::thickness_along(const Eigen::Vector3d& direction, const Contour& contour) const {
  ExtentAlong extent(direction);
  contour.visit_points([&](const Eigen::Vector3d& point) { extent.add(point); });
  const FeatureFilter* const groups = pair_.query.groups;
  const SolidScratch& solid = worker_.scratch.solid;
  if (pair_.query.b_is_solid)
    for (const std::uint32_t vertex : solid.a_in_b.inside())
      if (groups == nullptr || groups->may_vertex_of_a(vertex)) extent.add(pair_.a->position(vertex));
  if (pair_.query.a_is_solid)
    for (const std::uint32_t vertex : solid.b_in_a.inside())
      if (groups == nullptr || groups->may_vertex_of_b(vertex)) extent.add(pair_.b->position(vertex));
  return extent.extent();
}

/// How far b has to go until all of it is beyond all of a, rounded up.
double WayOutSearch::extent_along(const Eigen::Vector3d& direction) const {
  const auto largest = [](const Box& box) { return box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).sum(); };
  const double highest_of_a = highest_along(*pair_.a, direction);
  const double lowest_of_b = -highest_along(*pair_.b, -direction);
  const double rounding = (largest(pair_.a->box()) + largest(pair_.b->box())) * 0x1p-50;
  return std::max(0.0, (highest_of_a - lowest_of_b + rounding) * round_up);
}

}  // namespace graze
