#include "support/oracle_grouped_nearest.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "support/exact_distance.hpp"
#include "support/oracle_features.hpp"

namespace graze::oracle {
namespace {

class NearestContacts {
 public:
  NearestContacts(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs)
      : a_(a), b_(b), limit_(Limit::below(threshold)), pairs_(pairs) {
    add_vertices();
    add_edges();
    for (const auto& [name, contact] : collect_features(a_, b_, Limit::below(0), pairs))
      if (contact.pierced) contacts_.try_emplace(name, contact);
  }
  [[nodiscard]] std::vector<Named> all() const { return rounded(contacts_); }

 private:
  static Feature face_feature(std::uint32_t face) { return {FeatureKind::face, face}; }

  /// The closest point on the faces for which `may(face)` holds.
  template <typename May>
  [[nodiscard]] std::optional<Foot> foot_of(const Point& point, const ExactShape& other,
                                            const May& may) const {
    std::optional<Foot> best;
    for (std::uint32_t face = 0; face < other.faces.size(); ++face) {
      if (!may(face_feature(face))) continue;
      Foot foot = foot_on_face(point, other, face);
      if (!limit_.admits(foot.distance_squared)) continue;
      const int order = best ? cmp(foot.distance_squared, best->distance_squared) : -1;
      if (order < 0 || (order == 0 && foot.feature < best->feature)) best = std::move(foot);
    }
    return best;
  }
  void add_vertices() {
    for (const std::uint32_t vertex : a_.used) {
      const Feature of_a{FeatureKind::vertex, vertex};
      if (const auto foot =
              foot_of(a_.points[vertex], b_, [&](const Feature& face) { return pairs_.may(of_a, face); }))
        contacts_.try_emplace(name_of(of_a, foot->feature),
                              ExactContact{foot->distance_squared, a_.points[vertex], foot->point});
    }
    for (const std::uint32_t vertex : b_.used) {
      const Feature of_b{FeatureKind::vertex, vertex};
      if (const auto foot =
              foot_of(b_.points[vertex], a_, [&](const Feature& face) { return pairs_.may(face, of_b); }))
        contacts_.try_emplace(name_of(foot->feature, of_b),
                              ExactContact{foot->distance_squared, foot->point, b_.points[vertex]});
    }
  }

  /// Whether no face with `edge` for which `may(face)` holds comes nearer along `way`, square to the edge.
  template <typename May>
  static bool is_locally_closest(const ExactShape& shape, const Segment& edge, const Point& way,
                                 const May& may) {
    for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
      if (!may(face_feature(face))) continue;
      for (const Triangle& triangle : shape.faces[face].triangles)
        for (int side = 0; side < 3; ++side) {
          const auto corner = [&](int i) {
            return triangle.corners[static_cast<std::size_t>((side + i) % 3)];
          };
          const std::pair<std::uint32_t, std::uint32_t> ends = std::minmax(corner(0), corner(1));
          if (side == triangle.inner_side || ends != std::pair(edge.ends[0], edge.ends[1])) continue;
          // `way` is square to the edge, so what is along the edge does not count.
          if (dot(shape.points[corner(2)] - shape.points[ends.first], way) > 0) return false;
        }
    }
    return true;
  }
  void add_edges() {
    for (const Segment& edge_a : a_.edges())
      for (const Segment& edge_b : b_.edges()) {
        if (!pairs_.may(edge_a.owner, edge_b.owner)) continue;
        const auto contact = inner_contact(a_, edge_a, b_, edge_b);
        if (!contact || !limit_.admits(contact->a.distance_squared)) continue;
        const Point way = contact->b.point - contact->a.point;
        const Point back = contact->a.point - contact->b.point;
        if (is_locally_closest(a_, edge_a, way,
                               [&](const Feature& face) { return pairs_.may(face, edge_b.owner); }) &&
            is_locally_closest(b_, edge_b, back,
                               [&](const Feature& face) { return pairs_.may(edge_a.owner, face); }))
          contacts_.try_emplace(
              name_of(edge_a.owner, edge_b.owner),
              ExactContact{contact->a.distance_squared, contact->a.point, contact->b.point});
      }
  }

  ExactShape a_;
  ExactShape b_;
  Limit limit_;
  const FacePairs& pairs_;
  ExactContacts contacts_;
};

}  // namespace

std::vector<Named> nearest(const Shape& a, const Shape& b, double threshold, const FacePairs& pairs) {
  return NearestContacts(a, b, threshold, pairs).all();
}

}  // namespace graze::oracle
