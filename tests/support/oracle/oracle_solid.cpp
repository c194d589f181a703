#include <algorithm>

#include "support/exact/exact_winding.hpp"
#include "support/oracle/oracle_nearest.hpp"

namespace graze::oracle {

namespace {

/// On which sides of a solid the used vertices of the other shape lie. The others are on no side.
std::vector<Side> sides_of_vertices(const ExactShape& exact, const Shape& shape, const Shape& solid) {
  std::vector<Side> sides(shape.positions.size(), Side::none);
  const WindingOracle winding(solid);
  for (const std::uint32_t vertex : exact.used) {
    const Winding about = winding.about(shape.positions[vertex]);
    if (!about.on_surface) sides[vertex] = about.is_inside() ? Side::back : Side::front;
  }
  return sides;
}

/// The vertices of a shape, and where they lie with regard to the other object if that is a solid.
class VertexSides {
 public:
  VertexSides(const ExactShape& exact, const Shape& shape, const Shape& other, bool is_other_solid)
      : used_(exact.used) {
    if (is_other_solid) sides_ = sides_of_vertices(exact, shape, other);
  }

  [[nodiscard]] bool is_inside(std::uint32_t vertex) const {
    return !sides_.empty() && sides_[vertex] == Side::back;
  }
  [[nodiscard]] bool are_all_inside() const {
    return std::all_of(used_.begin(), used_.end(), [this](std::uint32_t v) { return is_inside(v); });
  }
  [[nodiscard]] bool is_any_inside() const {
    return std::any_of(used_.begin(), used_.end(), [this](std::uint32_t v) { return is_inside(v); });
  }
  /// The side that a contact has by its vertex. None if its feature here is no vertex or the other no solid.
  [[nodiscard]] std::optional<Side> side_of(Feature feature) const {
    if (sides_.empty() || feature.kind != FeatureKind::vertex) return std::nullopt;
    return sides_[feature.index];
  }

 private:
  const std::vector<std::uint32_t>& used_;
  std::vector<Side> sides_;
};

Containment containment_of(const VertexSides& of_a, const VertexSides& of_b, bool is_pierced) {
  if (is_pierced) return Containment::crossing;
  if (of_a.are_all_inside()) return Containment::a_in_b;
  if (of_b.are_all_inside()) return Containment::b_in_a;
  return of_a.is_any_inside() || of_b.is_any_inside() ? Containment::crossing : Containment::none;
}

}  // namespace

SolidPair solid_pair(const Shape& shape_a, const Shape& shape_b, Solids solids, double threshold,
                     const Shape& rest_a, const Shape& rest_b) {
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  const VertexSides of_a(a, shape_a, shape_b, solids.b);
  const VertexSides of_b(b, shape_b, shape_a, solids.a);

  SolidPair pair;
  pair.contacts = rounded(collect_nearest(
      a, b, Limit::below(threshold), Creases(rest_a, rest_b),
      [&](std::uint32_t vertex) { return of_a.is_inside(vertex); },
      [&](std::uint32_t vertex) { return of_b.is_inside(vertex); }));
  for (const Named& contact : pair.contacts)
    pair.sides.push_back({of_b.side_of(contact.b), of_a.side_of(contact.a)});
  pair.has_vertex_inside = of_a.is_any_inside() || of_b.is_any_inside();
  const bool is_pierced = std::any_of(pair.contacts.begin(), pair.contacts.end(),
                                      [](const Named& contact) { return contact.pierced; });
  if (solids.a || solids.b) pair.inside = containment_of(of_a, of_b, is_pierced);
  return pair;
}

Containment containment(const Shape& shape_a, const Shape& shape_b, Solids solids, const FacePairs& pairs) {
  if (!solids.a && !solids.b) return Containment::none;
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  const auto contacts = features(shape_a, shape_b, 0, pairs);
  const bool is_pierced =
      std::any_of(contacts.begin(), contacts.end(), [](const Named& contact) { return contact.pierced; });
  return containment_of(VertexSides(a, shape_a, shape_b, solids.b),
                        VertexSides(b, shape_b, shape_a, solids.a), is_pierced);
}

}  // namespace graze::oracle
