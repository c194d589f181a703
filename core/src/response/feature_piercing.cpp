#include "response/feature_piercing.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "arithmetic/certain.hpp"
#include "closest_features/piercing.hpp"
#include "core/surface/surface.hpp"

namespace graze {
namespace {

/// Whether all corners of a face lie on one side of a box along one of the axes.
bool is_beside(const Eigen::Array3d& low, const Eigen::Array3d& high, const PlacedMesh& placed,
               std::span<const std::uint32_t> corners) {
  Eigen::Array3d least = placed.point(corners[0]);
  Eigen::Array3d most = least;
  for (const std::uint32_t corner : corners.subspan(1)) {
    const Eigen::Array3d point = placed.point(corner);
    least = least.min(point);
    most = most.max(point);
  }
  return (least > high).any() || (most < low).any();
}

}  // namespace

std::int8_t pierced_triangle_of(const Segment& segment, const PlacedMesh& placed, std::uint32_t face) {
  const bool is_quad = placed.mesh.face(face).size() == 4;
  std::array<Simplex, 2> triangles{Simplex{3, {}, triangle_of(placed, face, 0)}};
  if (is_quad) triangles[1] = {3, {}, triangle_of(placed, face, 1)};
  const auto some = std::span(triangles).first(is_quad ? 2 : 1);
  std::int8_t passed = -1;
  bool is_sure = true;
  for (std::size_t i = 0; i < some.size(); ++i) {
    const Passing passing = certain_passing(segment, some[i].point);
    is_sure = is_sure && passing != Passing::unsure && (passing == Passing::no || passed < 0);
    if (passing == Passing::yes) passed = static_cast<std::int8_t>(i);
  }
  if (is_sure) return passed;
  const auto is_good = [](const Eigen::Vector3d& point) { return Surface::is_within_limits(point); };
  if (!std::all_of(segment.begin(), segment.end(), is_good)) return -1;
  for (const Simplex& triangle : some)
    if (!std::all_of(triangle.point.begin(), triangle.point.end(), is_good)) return -1;
  DecisionCount count;
  const bool has_fold = is_quad && diagonal_of(placed.mesh, face).feature.kind == FeatureKind::face;
  const auto pierced = pierced_triangle({2, {}, {segment[0], segment[1]}}, some, has_fold, count);
  if (!pierced) return -1;
  return *pierced == Piece::first ? 0 : 1;
}

bool pierces_any_face(const Segment& segment, const PlacedMesh& placed) {
  const Eigen::Array3d low = segment[0].array().min(segment[1].array());
  const Eigen::Array3d high = segment[0].array().max(segment[1].array());
  for (std::uint32_t face = 0; face < placed.mesh.face_count(); ++face)
    if (!is_beside(low, high, placed, placed.mesh.face(face)) &&
        pierced_triangle_of(segment, placed, face) >= 0)
      return true;
  return false;
}

}  // namespace graze
