#include "closest_features/listed_edges.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "closest_features/lean.hpp"
#include "closest_features/seen_faces.hpp"
#include "mesh/creases.hpp"

namespace graze {
namespace {

double largest(const Eigen::Vector3d& vector) {
  return vector.cwiseAbs().maxCoeff();
}

/// Two edges and their common normal n = d_a × d_b, along which the way between their closest points is.
class EdgePair {
 public:
  using Ends = std::array<Eigen::Vector3d, 2>;

  EdgePair(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b)
      : count_(pair.count),
        a_(ends_of(pair.a, edge_a)),
        b_(ends_of(pair.b, edge_b)),
        normal_((a_[1] - a_[0]).cross(b_[1] - b_[0])),
        size_(largest(a_[1] - a_[0]) * largest(b_[1] - b_[0])) {}

  /// The sign of n·(to − from).
  [[nodiscard]] int sign_along_normal(const Eigen::Vector3d& to, const Eigen::Vector3d& from) const {
    const Eigen::Vector3d way = to - from;
    const double volume = normal_.dot(way);
    if (std::abs(volume) > size_ * volume_error * largest(way) + 0x1p-1000) return volume > 0 ? 1 : -1;
    return decide_sign(count_, [&]<typename Number>() {
      return dot(cross(difference<Number>(a_[1], a_[0]), difference<Number>(b_[1], b_[0])),
                 difference<Number>(to, from));
    });
  }
  /// Whether the way into a triangle from its edge, square to the edge, is within τ of the plane square to n.
  [[nodiscard]] bool is_within_tolerance(const Eigen::Vector3d& corner, const Ends& edge) const {
    if (const auto certain = is_certainly_within(corner, edge)) return *certain;
    const int excess = decide_sign(count_, [&]<typename Number>() {
      const auto d = difference<Number>(edge[1], edge[0]);
      const auto r = difference<Number>(corner, edge[0]);
      const auto n = cross(difference<Number>(a_[1], a_[0]), difference<Number>(b_[1], b_[0]));
      const auto area = cross(r, d);
      const auto along = dot(n, r);
      return along * along * dot(d, d) * inverse_squared_lean - dot(n, n) * dot(area, area);
    });
    return excess <= 0;
  }
  /// Whether two corners in one plane with an edge make triangles with it, one on each side.
  [[nodiscard]] bool are_beside_each_other(const std::array<Eigen::Vector3d, 2>& corners,
                                           const Ends& edge) const {
    return decide_sign(count_, [&]<typename Number>() {
             const auto along = difference<Number>(edge[1], edge[0]);
             return dot(cross(difference<Number>(corners[0], edge[0]), along),
                        cross(difference<Number>(corners[1], edge[0]), along));
           }) < 0;
  }
  [[nodiscard]] const Ends& a() const { return a_; }
  [[nodiscard]] const Ends& b() const { return b_; }

 private:
  // docs/numerics.md derives both.
  static constexpr double volume_error = 0x1p-46;
  static constexpr double area_error = 0x1p-48;

  static Ends ends_of(const Surface& surface, std::uint32_t edge) {
    const auto [first, second] = surface.mesh().edge(edge);
    return {surface.position(first), surface.position(second)};
  }
  /// Compares |n·r| |d| √32 with |n| |r × d|, which is the same as `is_within_tolerance`. 32 is
  /// `inverse_squared_lean`.
  [[nodiscard]] std::optional<bool> is_certainly_within(const Eigen::Vector3d& corner,
                                                        const Ends& edge) const {
    const Eigen::Vector3d d = edge[1] - edge[0];
    const Eigen::Vector3d r = corner - edge[0];
    const double length = d.norm() * std::sqrt(inverse_squared_lean);
    const double normal = normal_.norm();
    const double area = r.cross(d).norm();
    const double left = std::abs(normal_.dot(r)) * length;
    const double right = normal * area;
    const double area_off = largest(r) * largest(d) * area_error;
    const double error = size_ * volume_error * largest(r) * length + size_ * area_error * (area + area_off) +
                         normal * area_off + (left + right) * 0x1p-48;
    if (!(left + right < 0x1p500) || !(error > 0x1p-500)) return std::nullopt;
    if (left + error < right) return true;
    return left - error > right ? std::optional(false) : std::nullopt;
  }

  DecisionCount& count_;
  Ends a_;
  Ends b_;
  Eigen::Vector3d normal_;
  double size_;
};

/// One of the two edges with the triangles beside it.
class EdgeSide {
 public:
  /// `gap` is the sign of the way from this edge to the other one along n.
  EdgeSide(const SurfacePair& pair, const EdgePair& edges, bool is_of_a, std::uint32_t edge,
           std::uint32_t other, int gap)
      : pair_(pair), edges_(edges), is_of_a_(is_of_a), edge_(edge), other_(other), gap_(gap) {
    if (pair.groups != nullptr && groups().hides_some()) seen_ = seen_faces(groups(), surface().mesh(), edge);
  }

  [[nodiscard]] bool is_seam() const { return seen_.are_at_seam(); }
  /// Whether the edge allows that the two edges are locally closest.
  [[nodiscard]] bool is_locally_closest() const { return !leads_nearer() && !is_within_flat_surface(); }
  /// Whether the way into a triangle leads nearer to the other point.
  [[nodiscard]] bool leads_nearer() const {
    return any_across([&](std::uint32_t corner) { return lead(corner) > 0; });
  }
  /// Whether the edge is a crease, and the way to the other point within τ of its normal cone. The way is the
  /// opposite if `sign` is −1.
  [[nodiscard]] bool has_in_cone(int sign) const {
    return !any_across([&](std::uint32_t corner) {
      return lead(corner) == sign && !edges_.is_within_tolerance(surface().position(corner), ends());
    });
  }
  [[nodiscard]] bool is_crease() const {
    if (!seen_.hides_some) return surface().mesh().is_crease(edge_);
    const auto& faces = seen_.faces;
    return faces.size() != 2 || is_crease_between(surface().mesh(), edge_, {faces[0], faces[1]});
  }

 private:
  [[nodiscard]] const Surface& surface() const { return is_of_a_ ? pair_.a : pair_.b; }
  [[nodiscard]] const FaceGroups& groups() const {
    return is_of_a_ ? pair_.groups->of_a() : pair_.groups->of_b();
  }
  [[nodiscard]] const EdgePair::Ends& ends() const { return is_of_a_ ? edges_.a() : edges_.b(); }
  [[nodiscard]] int lead(std::uint32_t corner) const {
    return edges_.sign_along_normal(surface().position(corner), ends()[0]) * gap_;
  }
  /// Whether the surface goes on to both sides of the edge in the plane square to the way. Such an edge
  /// bounds nothing, and any tilt would make it lead nearer.
  [[nodiscard]] bool is_within_flat_surface() const {
    const IndexedMesh& mesh = surface().mesh();
    if (is_crease()) return false;
    std::array<Eigen::Vector3d, 2> places;
    std::size_t triangles = 0;
    for (const std::uint32_t corner : mesh.edge_across(edge_)) {
      if (!is_across_in_seen_face(corner)) continue;
      if (lead(corner) != 0 || triangles == places.size()) return false;
      places[triangles++] = surface().position(corner);
    }
    const auto faces = mesh.edge_faces(edge_);
    return triangles == places.size() && edges_.are_beside_each_other(places, ends()) &&
           (pair_.groups == nullptr || std::all_of(faces.begin(), faces.end(), [&](std::uint32_t face) {
              return groups().hides(face) || may(face);
            }));
  }
  [[nodiscard]] bool is_across_in_seen_face(std::uint32_t corner) const {
    return !seen_.hides_some || std::any_of(seen_.faces.begin(), seen_.faces.end(), [&](std::uint32_t face) {
      return is_across_in(surface().mesh(), face, edge_, corner);
    });
  }
  /// Whether `holds` for a corner across the edge in a face that counts. Without groups all faces count, and
  /// none is asked for.
  template <typename Holds>
  [[nodiscard]] bool any_across(const Holds& holds) const {
    const IndexedMesh& mesh = surface().mesh();
    for (const std::uint32_t corner : mesh.edge_across(edge_)) {
      if (!holds(corner)) continue;
      if (pair_.groups == nullptr) return true;
      for (const std::uint32_t face : mesh.edge_faces(edge_))
        if (may(face) && is_across_in(mesh, face, edge_, corner)) return true;
    }
    return false;
  }
  [[nodiscard]] bool may(std::uint32_t face) const {
    const FeatureRef this_face{FeatureRefKind::face, face};
    const FeatureRef other_edge{FeatureRefKind::edge, other_};
    return is_of_a_ ? pair_.groups->may_groups(this_face, other_edge)
                    : pair_.groups->may_groups(other_edge, this_face);
  }

  const SurfacePair& pair_;
  const EdgePair& edges_;
  bool is_of_a_;
  std::uint32_t edge_;
  std::uint32_t other_;
  int gap_;
  SeenFaces seen_;  ///< left empty where the surface hides no faces
};

}  // namespace

// The way d between the closest points is square to both edges, so it is along n. The way from an edge to the
// corner across is the inward direction plus a part along the edge. That part has no product with d.
EdgesListed listed_edges(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b) {
  const EdgePair edges(pair, edge_a, edge_b);
  const int gap = edges.sign_along_normal(edges.b()[0], edges.a()[0]);
  if (gap == 0) return EdgesListed::always;
  const EdgeSide a(pair, edges, true, edge_a, edge_b, gap);
  const EdgeSide b(pair, edges, false, edge_b, edge_a, -gap);
  if (a.is_seam() || b.is_seam())
    return a.leads_nearer() || b.leads_nearer() ? EdgesListed::never : EdgesListed::only_alone;
  if (a.is_locally_closest() && b.is_locally_closest()) return EdgesListed::always;
  if (!a.is_crease() || !b.is_crease()) return EdgesListed::never;
  const bool if_not_sunk = a.has_in_cone(1) && b.has_in_cone(1);
  const bool if_sunk = a.has_in_cone(-1) && b.has_in_cone(-1);
  if (if_sunk && if_not_sunk) return EdgesListed::always;
  if (if_sunk) return EdgesListed::if_sunk;
  return if_not_sunk ? EdgesListed::if_not_sunk : EdgesListed::never;
}

}  // namespace graze
