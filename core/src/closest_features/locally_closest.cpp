#include "closest_features/locally_closest.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace graze {
namespace {

/// The volumes that two edges and a way span. Their signs say on which side of both edges the way leads.
class VolumesOverEdges {
 public:
  VolumesOverEdges(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b)
      : count_(pair.count),
        a_(ends_of(pair.a, edge_a)),
        b_(ends_of(pair.b, edge_b)),
        normal_((a_[1] - a_[0]).cross(b_[1] - b_[0])),
        // docs/numerics.md derives it.
        error_(largest(a_[1] - a_[0]) * largest(b_[1] - b_[0]) * 0x1p-46) {}

  [[nodiscard]] int sign_to(const Eigen::Vector3d& to, const Eigen::Vector3d& from) const {
    const Eigen::Vector3d way = to - from;
    const double volume = normal_.dot(way);
    if (std::abs(volume) > error_ * largest(way) + 0x1p-1000) return volume > 0 ? 1 : -1;
    return decide_sign(count_, [&]<typename Number>() {
      return dot(cross(difference<Number>(a_[1], a_[0]), difference<Number>(b_[1], b_[0])),
                 difference<Number>(to, from));
    });
  }
  [[nodiscard]] const Eigen::Vector3d& on_a() const { return a_[0]; }
  [[nodiscard]] const Eigen::Vector3d& on_b() const { return b_[0]; }

 private:
  static std::array<Eigen::Vector3d, 2> ends_of(const Surface& surface, std::uint32_t edge) {
    const auto [first, second] = surface.mesh().edge(edge);
    return {surface.position(first), surface.position(second)};
  }
  static double largest(const Eigen::Vector3d& vector) { return vector.cwiseAbs().maxCoeff(); }

  DecisionCount& count_;
  std::array<Eigen::Vector3d, 2> a_;
  std::array<Eigen::Vector3d, 2> b_;
  Eigen::Vector3d normal_;
  double error_;
};

/// Whether a corner is across from an edge in a triangle of a face.
bool is_across_in(const IndexedMesh& mesh, std::uint32_t face, std::uint32_t edge, std::uint32_t corner) {
  const auto corners = mesh.face(face);
  const auto [low, high] = mesh.edge(edge);
  for (std::size_t last = 2; last < corners.size(); ++last) {
    const std::array<std::uint32_t, 3> triangle{corners[0], corners[last - 1], corners[last]};
    const auto has = [&](std::uint32_t vertex) {
      return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
    };
    if (has(low) && has(high) && has(corner)) return true;
  }
  return false;
}

/// Calls `is_nearer(corner)` with the corners across from an edge in faces for which `may(face)` holds, until
/// it returns true. Without groups all faces count, and none is asked for.
template <typename May, typename IsNearer>
bool any_across(const SurfacePair& pair, const IndexedMesh& mesh, std::uint32_t edge, const May& may,
                const IsNearer& is_nearer) {
  for (const std::uint32_t corner : mesh.edge_across(edge)) {
    if (!is_nearer(corner)) continue;
    if (pair.groups == nullptr) return true;
    for (const std::uint32_t face : mesh.edge_faces(edge))
      if (may(FeatureRef{FeatureRefKind::face, face}) && is_across_in(mesh, face, edge, corner)) return true;
  }
  return false;
}

}  // namespace

// The way d between the closest points is square to both edges, so it is along their cross product. The way
// from an edge to the corner across is the inward direction plus a part along the edge. That part has no
// product with d.
bool are_locally_closest(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b) {
  const VolumesOverEdges volumes(pair, edge_a, edge_b);
  const int gap = volumes.sign_to(volumes.on_b(), volumes.on_a());
  if (gap == 0) return true;
  const FeatureRef a{FeatureRefKind::edge, edge_a};
  const FeatureRef b{FeatureRefKind::edge, edge_b};
  const auto leads_a_nearer = [&](std::uint32_t corner) {
    return volumes.sign_to(pair.a.position(corner), volumes.on_a()) * gap > 0;
  };
  const auto leads_b_nearer = [&](std::uint32_t corner) {
    return volumes.sign_to(pair.b.position(corner), volumes.on_b()) * gap < 0;
  };
  return !any_across(
             pair, pair.a.mesh(), edge_a, [&](const FeatureRef& face) { return pair.may(face, b); },
             leads_a_nearer) &&
         !any_across(
             pair, pair.b.mesh(), edge_b, [&](const FeatureRef& face) { return pair.may(a, face); },
             leads_b_nearer);
}

}  // namespace graze
