#include "support/oracle/self_pairs.hpp"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "support/exact/exact_distance.hpp"

namespace graze::oracle {
namespace {

constexpr std::uint32_t not_joined = std::numeric_limits<std::uint32_t>::max();

/// How many edges lead from one vertex to each other one, or `not_joined`.
std::vector<std::uint32_t> edges_from(const ExactShape& shape, std::uint32_t start) {
  std::vector<std::uint32_t> count(shape.points.size(), not_joined);
  count[start] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Segment& edge : shape.edges())
      for (const auto& [from, to] : {std::pair(edge.ends[0], edge.ends[1]), {edge.ends[1], edge.ends[0]}})
        if (count[from] != not_joined && count[from] + 1 < count[to]) {
          count[to] = count[from] + 1;
          changed = true;
        }
  }
  return count;
}

}  // namespace

SelfPairs::SelfPairs(const Shape& rest, std::uint32_t rings, double rest_distance)
    : rest_(rest), rings_(rings), limit_(Limit::below(rest_distance)) {
  for (std::uint32_t vertex = 0; vertex < rest_.points.size(); ++vertex)
    edges_between_.push_back(edges_from(rest_, vertex));
}

std::vector<std::uint32_t> SelfPairs::vertices_of(const Feature& feature) const {
  if (feature.kind == FeatureKind::vertex) return {feature.index};
  if (feature.kind == FeatureKind::face) return rest_.faces[feature.index].corners;
  const auto& ends = rest_.segments[feature.index].ends;
  return {ends[0], ends[1]};
}

std::uint32_t SelfPairs::fewest_edges(const Feature& a, const Feature& b) const {
  std::uint32_t fewest = not_joined;
  for (const std::uint32_t of_a : vertices_of(a))
    for (const std::uint32_t of_b : vertices_of(b)) fewest = std::min(fewest, edges_between_[of_a][of_b]);
  return fewest;
}

bool SelfPairs::may(const Feature& a, const Feature& b) const {
  return fewest_edges(a, b) > rings_ && !are_near_at_rest(a, b);
}

bool SelfPairs::may_pierce(const Feature& a, const Feature& b) const {
  return fewest_edges(a, b) > 0;
}

FacePairs SelfPairs::pairs() const {
  return FacePairs({[this](const Feature& a, const Feature& b) { return may(a, b); },
                    [this](const Feature& a, const Feature& b) { return may_pierce(a, b); }});
}

bool SelfPairs::are_near_at_rest(const Feature& a, const Feature& b) const {
  return !limit_.certainly_excludes(extent_of(a), extent_of(b)) && limit_.admits(rest_distance_squared(a, b));
}

const Extent& SelfPairs::extent_of(const Feature& feature) const {
  if (feature.kind == FeatureKind::vertex) return rest_.point_extents[feature.index];
  return feature.kind == FeatureKind::edge ? rest_.segments[feature.index].extent
                                           : rest_.faces[feature.index].extent;
}

/// The least distance of a corner of one from the other, or of their edges. Faces that pierce each other have
/// none smaller that matters: no test has one at rest.
Rational SelfPairs::rest_distance_squared(const Feature& a, const Feature& b) const {
  if (b.kind < a.kind) return rest_distance_squared(b, a);
  if (a.kind == FeatureKind::vertex) {
    const Point& point = rest_.points[a.index];
    if (b.kind == FeatureKind::vertex) return squared_length(point - rest_.points[b.index]);
    if (b.kind == FeatureKind::edge)
      return foot_on_segment(point, rest_, rest_.segments[b.index]).distance_squared;
    return foot_on_face(point, rest_, b.index).distance_squared;
  }
  if (b.kind == FeatureKind::edge) {
    const Segment& edge_a = rest_.segments[a.index];
    const Segment& edge_b = rest_.segments[b.index];
    if (const auto inner = inner_contact(rest_, edge_a, rest_, edge_b)) return inner->a.distance_squared;
    return end_contacts(rest_, edge_a, rest_, edge_b)[0].a.distance_squared;
  }
  const auto edges_of_feature = [&](const Feature& feature) {
    return feature.kind == FeatureKind::edge ? std::vector{feature.index} : rest_.faces[feature.index].edges;
  };
  Rational least = rest_distance_squared({FeatureKind::vertex, vertices_of(a)[0]}, b);
  for (const auto& [one, other] : {std::pair(a, b), {b, a}})
    for (const std::uint32_t vertex : vertices_of(one))
      least = std::min(least, rest_distance_squared({FeatureKind::vertex, vertex}, other));
  for (const std::uint32_t of_a : edges_of_feature(a))
    for (const std::uint32_t of_b : edges_of_feature(b))
      least = std::min(least, rest_distance_squared({FeatureKind::edge, of_a}, {FeatureKind::edge, of_b}));
  return least;
}

std::vector<Named> each_once(std::vector<Named> contacts) {
  for (Named& contact : contacts)
    if (contact.b < contact.a) {
      std::swap(contact.a, contact.b);
      std::swap(contact.point_a, contact.point_b);
    }
  const auto name = [](const Named& contact) { return std::tuple(contact.kind, contact.a, contact.b); };
  std::stable_sort(contacts.begin(), contacts.end(),
                   [&](const Named& left, const Named& right) { return name(left) < name(right); });
  contacts.erase(
      std::unique(contacts.begin(), contacts.end(),
                  [&](const Named& left, const Named& right) { return name(left) == name(right); }),
      contacts.end());
  return contacts;
}

}  // namespace graze::oracle
