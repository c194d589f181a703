#include "rough_normals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "corner_lane.hpp"

namespace graze {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// The corners of a triangle from one of them around. Without branches, which could not be foretold.
Corners turned_to(std::uint32_t vertex, std::span<const std::uint32_t> corner) {
  constexpr std::array<std::size_t, 6> around{0, 1, 2, 0, 1, 2};
  const std::size_t place = (corner[1] == vertex ? 1U : 0U) + (corner[2] == vertex ? 2U : 0U);
  return {vertex, corner[around[place + 1]], corner[around[place + 2]]};
}

/// The corners of each triangle that has the vertex, of a face that has it, from it around.
template <typename Use>
void for_each_triangle_from(std::uint32_t vertex, std::span<const std::uint32_t> face, Use use) {
  if (face.size() == 3) return use(turned_to(vertex, face));
  for (std::size_t last = 2; last < face.size(); ++last) {
    const Corners corner{face[0], face[last - 1], face[last]};
    if (std::find(corner.begin(), corner.end(), vertex) != corner.end()) use(turned_to(vertex, corner));
  }
}

}  // namespace

void NormalSums::add(const Surface& surface, const FeaturePiece& piece, RoughNormal& normal) {
  normal = {};
  const std::uint32_t index = piece.feature.index;
  switch (piece.feature.kind) {
    case FeatureKind::vertex:
      return add_vertex(surface, index, normal);
    case FeatureKind::edge:
      return add_edge(surface, index, normal);
    case FeatureKind::face:
      if (piece.piece != Piece::fold) add_triangle(surface, corners_of(surface.mesh(), piece), 1, normal);
  }
}

void NormalSums::add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal) {
  for (const std::uint32_t face : surface.mesh().vertex_faces(vertex))
    for_each_triangle_from(vertex, surface.mesh().face(face),
                           [&](const Corners& corner) { add_triangle(surface, corner, 0, normal); });
}

void NormalSums::add_edge(const Surface& surface, std::uint32_t edge, RoughNormal& normal) {
  const std::array<std::uint32_t, 2> end = surface.mesh().edge(edge);
  for (const std::uint32_t face : surface.mesh().edge_faces(edge))
    for_each_triangle_from(end[0], surface.mesh().face(face), [&](const Corners& corner) {
      if (corner[1] == end[1] || corner[2] == end[1]) add_triangle(surface, corner, std::numbers::pi, normal);
    });
}

void NormalSums::add_triangle(const Surface& surface, const Corners& corner, double weight,
                              RoughNormal& normal) {
  for (std::size_t i = 0; i < 3; ++i) put_corner(surface, corner[i], batch_.corner[i], count_);
  batch_.weight[count_] = weight;
  normal_[count_] = &normal;
  if (++count_ == normal_.size()) finish();
}

void NormalSums::finish() {
  if (count_ == 0) return;
  kernels::measure().normals(batch_);
  for (std::size_t i = 0; i < count_; ++i) {
    normal_[i]->sum += Eigen::Vector3d(batch_.part[0][i], batch_.part[1][i], batch_.part[2][i]);
    normal_[i]->weights += batch_.weight[i];
  }
  count_ = 0;
}

std::optional<Side> certain_side(const RoughNormal& normal, const Eigen::Vector3d& direction) {
  const double along = normal.sum.dot(direction);
  if (!(std::abs(along) > std::max(normal.weights * 0x1p-20, 0x1p-34)) || normal.weights == 0)
    return std::nullopt;
  return along > 0 ? Side::front : Side::back;
}

}  // namespace graze
