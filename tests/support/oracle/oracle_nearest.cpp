#include "support/oracle/oracle_nearest.hpp"

#include <algorithm>
#include <utility>

namespace graze::oracle {

namespace {

class NearestCollector {
 public:
  NearestCollector(const ExactShape& a, const ExactShape& b, const Limit& limit)
      : a_(a), b_(b), limit_(limit) {}

  void add_vertices_of_a(const ListedAnyway& listed_anyway) {
    for (const std::uint32_t vertex : a_.used) {
      const auto foot = foot_of(vertex, a_, b_, listed_anyway);
      if (foot)
        add({FeatureKind::vertex, vertex}, foot->feature,
            {foot->distance_squared, a_.points[vertex], foot->point, false});
    }
  }

  void add_vertices_of_b(const ListedAnyway& listed_anyway) {
    for (const std::uint32_t vertex : b_.used) {
      const auto foot = foot_of(vertex, b_, a_, listed_anyway);
      if (foot)
        add(foot->feature, {FeatureKind::vertex, vertex},
            {foot->distance_squared, foot->point, b_.points[vertex], false});
    }
  }

  void add_edges(const Creases& creases) {
    for (const EdgePair& pair : EdgeOracle(a_, b_).pairs_within(limit_, creases))
      if (pair.is_listed())
        add(pair.a, pair.b,
            {pair.contact.a.distance_squared, pair.contact.a.point, pair.contact.b.point, false,
             pair.is_sunk});
  }

  void add_piercings() {
    for (const Segment& edge : a_.edges())
      for (std::uint32_t face = 0; face < b_.faces.size(); ++face)
        if (const auto point = piercing(a_, edge, b_, face))
          add(edge.owner, {FeatureKind::face, face}, {0, *point, *point, true});
    for (const Segment& edge : b_.edges())
      for (std::uint32_t face = 0; face < a_.faces.size(); ++face)
        if (const auto point = piercing(b_, edge, a_, face))
          add({FeatureKind::face, face}, edge.owner, {0, *point, *point, true});
  }

  /// Adds the nearest contact at the fold of a quad, if nothing is within the limit or pierces.
  void add_fold_if_alone() {
    const auto counts = [this](const auto& entry) {
      return entry.second.pierced || limit_.admits(entry.second.distance_squared);
    };
    if (std::any_of(contacts_.begin(), contacts_.end(), counts)) return;
    const ExactContacts all = collect_features(a_, b_, limit_);
    auto best = all.end();
    for (auto contact = all.begin(); contact != all.end(); ++contact) {
      if (contact->first.kind < ContactKind::EF) continue;
      if (best == all.end() || contact->second.distance_squared < best->second.distance_squared)
        best = contact;
    }
    if (best != all.end()) contacts_.insert(*best);
  }

  ExactContacts take() { return std::move(contacts_); }

 private:
  void add(Feature a, Feature b, ExactContact contact) {
    contacts_.try_emplace(name_of(a, b), std::move(contact));
  }

  [[nodiscard]] std::optional<Foot> foot_of(std::uint32_t vertex, const ExactShape& shape,
                                            const ExactShape& other,
                                            const ListedAnyway& listed_anyway) const {
    const Extent& extent = shape.point_extents[vertex];
    if (listed_anyway(vertex)) return foot_on_surface(shape.points[vertex], extent, other, Limit::none());
    return foot_on_surface(shape.points[vertex], extent, other, limit_);
  }

  static std::optional<Point> piercing(const ExactShape& shape, const Segment& edge, const ExactShape& other,
                                       std::uint32_t face) {
    if (gap_squared(edge.extent, other.faces[face].extent) > 0) return std::nullopt;
    const auto t = crossing(shape, edge, other, face);
    if (!t) return std::nullopt;
    return point_at(shape, edge, *t);
  }

  const ExactShape& a_;
  const ExactShape& b_;
  const Limit& limit_;
  ExactContacts contacts_;
};

/// The faces that the limit does not exclude, those with the nearest boxes first.
std::vector<std::uint32_t> faces_by_gap(const Extent& extent, const ExactShape& shape, const Limit& limit) {
  std::vector<std::pair<long double, std::uint32_t>> order;
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
    if (limit.certainly_excludes(extent, shape.faces[face].extent)) continue;
    order.emplace_back(gap_squared(extent, shape.faces[face].extent), face);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> faces;
  faces.reserve(order.size());
  for (const auto& entry : order) faces.push_back(entry.second);
  return faces;
}

}  // namespace

std::optional<Foot> foot_on_surface(const Point& point, const Extent& extent, const ExactShape& shape,
                                    const Limit& limit) {
  std::optional<Foot> best;
  Limit nearer = limit;
  for (const std::uint32_t face : faces_by_gap(extent, shape, limit)) {
    if (nearer.certainly_excludes(extent, shape.faces[face].extent)) break;
    Foot foot = foot_on_face(point, shape, face);
    const int order = best ? cmp(foot.distance_squared, best->distance_squared) : -1;
    if (order > 0 || (order == 0 && best->feature < foot.feature)) continue;
    if (order < 0 && limit.admits(foot.distance_squared)) nearer = Limit::up_to(foot.distance_squared);
    best = std::move(foot);
  }
  if (best && !limit.admits(best->distance_squared)) best.reset();
  return best;
}

ExactContacts collect_nearest(const ExactShape& a, const ExactShape& b, const Limit& limit,
                              const Creases& creases, const ListedAnyway& listed_of_a,
                              const ListedAnyway& listed_of_b) {
  NearestCollector collector(a, b, limit);
  collector.add_vertices_of_a(listed_of_a);
  collector.add_vertices_of_b(listed_of_b);
  collector.add_edges(creases);
  collector.add_piercings();
  collector.add_fold_if_alone();
  return collector.take();
}

std::vector<Named> nearest(const Shape& a, const Shape& b, double threshold, const Shape& rest_a,
                           const Shape& rest_b) {
  const auto none = [](std::uint32_t) { return false; };
  return rounded(collect_nearest(ExactShape(a), ExactShape(b), Limit::below(threshold),
                                 Creases(rest_a, rest_b), none, none));
}

}  // namespace graze::oracle
