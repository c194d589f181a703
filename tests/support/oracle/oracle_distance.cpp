#include "support/oracle/oracle_distance.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace graze::oracle {

namespace {

/// Two features of two shapes that may realise the distance.
struct Item {
  enum class Kind { vertex_face, face_vertex, segments } kind;
  std::uint32_t of_a, of_b;
  long double gap_squared;
};

std::vector<Item> items_within(const ExactShape& a, const ExactShape& b, long double reach_squared,
                               const FacePairs& pairs) {
  std::vector<Item> items;
  const auto add = [&](Item::Kind kind, std::uint32_t of_a, std::uint32_t of_b, const Extent& box_a,
                       const Extent& box_b) {
    const long double gap = gap_squared(box_a, box_b);
    if (gap <= reach_squared) items.push_back({kind, of_a, of_b, gap});
  };
  for (const std::uint32_t vertex : a.used)
    for (std::uint32_t face = 0; face < b.faces.size(); ++face)
      if (pairs.may({FeatureKind::vertex, vertex}, {FeatureKind::face, face}))
        add(Item::Kind::vertex_face, vertex, face, a.point_extents[vertex], b.faces[face].extent);
  for (const std::uint32_t vertex : b.used)
    for (std::uint32_t face = 0; face < a.faces.size(); ++face)
      if (pairs.may({FeatureKind::face, face}, {FeatureKind::vertex, vertex}))
        add(Item::Kind::face_vertex, face, vertex, a.faces[face].extent, b.point_extents[vertex]);
  for (std::uint32_t i = 0; i < a.segments.size(); ++i)
    for (std::uint32_t j = 0; j < b.segments.size(); ++j)
      if (pairs.may(a.segments[i].owner, b.segments[j].owner))
        add(Item::Kind::segments, i, j, a.segments[i].extent, b.segments[j].extent);
  std::sort(items.begin(), items.end(),
            [](const Item& p, const Item& q) { return p.gap_squared < q.gap_squared; });
  return items;
}

Rational distance_squared(const Item& item, const ExactShape& a, const ExactShape& b) {
  if (item.kind == Item::Kind::vertex_face)
    return foot_on_face(a.points[item.of_a], b, item.of_b).distance_squared;
  if (item.kind == Item::Kind::face_vertex)
    return foot_on_face(b.points[item.of_b], a, item.of_a).distance_squared;
  const Segment& segment_a = a.segments[item.of_a];
  const Segment& segment_b = b.segments[item.of_b];
  if (const auto inner = inner_contact(a, segment_a, b, segment_b)) return inner->a.distance_squared;
  return end_contacts(a, segment_a, b, segment_b)[0].a.distance_squared;
}

/// Whether a segment passes through a face that it may be looked at with.
template <typename May>
bool passes_through(const ExactShape& shape, std::span<const Segment> segments, const ExactShape& other,
                    const May& may) {
  for (const Segment& segment : segments) {
    for (std::uint32_t face = 0; face < other.faces.size(); ++face) {
      if (gap_squared(segment.extent, other.faces[face].extent) > 0) continue;
      if (!may(segment.owner, Feature{FeatureKind::face, face})) continue;
      if (crossing(shape, segment, other, face)) return true;
    }
  }
  return false;
}

bool do_pass(const ExactShape& a, std::span<const Segment> segments_a, const ExactShape& b,
             std::span<const Segment> segments_b, const FacePairs& pairs) {
  return passes_through(a, segments_a, b,
                        [&](Feature segment, Feature face) { return pairs.may_pierce(segment, face); }) ||
         passes_through(b, segments_b, a,
                        [&](Feature segment, Feature face) { return pairs.may_pierce(face, segment); });
}

/// The square of a distance beyond all others, for a shape whose features are not looked at against each
/// other.
Rational beyond_all() {
  return Rational(mpz_class(1) << 4096);
}

/// The nearest two vertices by long double, which suffices for a first upper bound. There are none only for a
/// shape and itself.
std::optional<std::pair<std::uint32_t, std::uint32_t>> roughly_nearest_vertices(const ExactShape& a,
                                                                                const ExactShape& b,
                                                                                const FacePairs& pairs) {
  std::optional<std::pair<std::uint32_t, std::uint32_t>> nearest;
  if (!pairs.is_of_self()) nearest = {a.used.at(0), b.used.at(0)};
  long double best = std::numeric_limits<long double>::infinity();
  for (const std::uint32_t i : a.used) {
    for (const std::uint32_t j : b.used) {
      const long double gap = gap_squared(a.point_extents[i], b.point_extents[j]);
      if (gap >= best || !pairs.may_vertices(i, j)) continue;
      best = gap;
      nearest = std::pair(i, j);
    }
  }
  return nearest;
}

/// The smallest double distance that is no less, squared with a margin far above the rounding of gaps.
long double reach_squared(const Rational& distance_squared) {
  const long double reach = round_sqrt(distance_squared, Rounding::up);
  return reach * reach * 1.0001L;
}

Pair pair_of(Rational distance_squared, bool pierced) {
  const double down = round_sqrt(distance_squared, Rounding::down);
  const double up = round_sqrt(distance_squared, Rounding::up);
  return {std::move(distance_squared), down, up, pierced};
}

Rational vertex_distance_squared(const ExactShape& a, const ExactShape& b, const FacePairs& pairs) {
  const auto first = roughly_nearest_vertices(a, b, pairs);
  if (!first) return beyond_all();
  Rational best = squared_length(a.points[first->first] - b.points[first->second]);
  const Limit limit = Limit::up_to(best);
  for (const std::uint32_t i : a.used) {
    for (const std::uint32_t j : b.used) {
      if (limit.certainly_excludes(a.point_extents[i], b.point_extents[j]) || !pairs.may_vertices(i, j))
        continue;
      best = std::min(best, squared_length(a.points[i] - b.points[j]));
    }
  }
  return best;
}

}  // namespace

bool is_pierced(const ExactShape& a, const ExactShape& b, const FacePairs& pairs) {
  return do_pass(a, a.edges(), b, b.edges(), pairs);
}

Rational smallest_distance_squared(const ExactShape& a, const ExactShape& b, const FacePairs& pairs) {
  if (do_pass(a, a.segments, b, b.segments, pairs)) return 0;
  // Two vertices of one shape may be looked at while no faces that have them are.
  Rational best = pairs.is_of_self() ? beyond_all() : vertex_distance_squared(a, b, pairs);
  long double reach = reach_squared(best);
  for (const Item& item : items_within(a, b, reach, pairs)) {
    if (item.gap_squared > reach) break;
    Rational candidate = distance_squared(item, a, b);
    if (candidate >= best) continue;
    best = std::move(candidate);
    reach = reach_squared(best);
  }
  return best;
}

Pair surface_distance(const Shape& shape_a, const Shape& shape_b, const FacePairs& pairs) {
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  return pair_of(smallest_distance_squared(a, b, pairs), is_pierced(a, b, pairs));
}

Pair vertex_distance(const Shape& shape_a, const Shape& shape_b, const FacePairs& pairs) {
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  return pair_of(vertex_distance_squared(a, b, pairs), is_pierced(a, b, pairs));
}

}  // namespace graze::oracle
