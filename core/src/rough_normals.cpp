#include "rough_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include "corner_lane.hpp"
#include "passes_for.hpp"

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

/// Where both are at one place there is no edge, nor a triangle with area at it. Edges that are none in float
/// alone are made such that nothing is certain.
template <typename Number>
void put_edge(const Number* from, const Number* to, kernels::FanBatch& batch, std::size_t edge,
              std::size_t lane) {
  std::array<float, 3> way;
  for (std::size_t axis = 0; axis < 3; ++axis) way[axis] = static_cast<float>(to[axis] - from[axis]);
  if constexpr (std::is_same_v<Number, double>)
    if (way[0] == 0 && way[1] == 0 && way[2] == 0 && !std::equal(from, from + 3, to))
      way[0] = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t axis = 0; axis < 3; ++axis) batch.edge[edge][axis][lane] = way[axis];
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
      if (piece.piece != Piece::fold) add_triangle(surface, corners_of(surface.mesh(), piece), normal);
  }
}

/// A long fan is walked in parts, of which each begins with the last edge of the one before.
void NormalSums::add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal) {
  std::span<const std::uint32_t> around = surface.mesh().vertex_fans(vertex);
  while (around.size() > kernels::fan_edges) {
    add_fan(surface, vertex, around.first(kernels::fan_edges), normal);
    around = around.subspan(kernels::fan_edges - 1);
  }
  add_fan(surface, vertex, around, normal);
}

void NormalSums::add_fan(const Surface& surface, std::uint32_t vertex, std::span<const std::uint32_t> around,
                         RoughNormal& normal) {
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    const Number* const centre = points.numbers + std::size_t{3} * vertex;
    for (std::size_t k = 0; k < around.size(); ++k)
      put_edge(centre, points.numbers + std::size_t{3} * around[k], fan_batch_, k, fans_);
  });
  fan_edges_[fans_] = around.size();
  of_fan_[fans_] = &normal;
  if (++fans_ == of_fan_.size()) finish_fans();
}

void NormalSums::finish_fans() {
  if (fans_ == 0) return;
  fan_batch_.edges = *std::max_element(fan_edges_.begin(), fan_edges_.begin() + fans_);
  for (std::size_t i = 0; i < fans_; ++i)
    for (std::size_t k = fan_edges_[i]; k < fan_batch_.edges; ++k)
      for (auto& coordinates : fan_batch_.edge[k]) coordinates[i] = 0;
  kernels::measure().fans(fan_batch_);
  for (std::size_t i = 0; i < fans_; ++i) {
    const auto& normal = fan_batch_.normal;
    of_fan_[i]->sum += Eigen::Vector3f(normal[0][i], normal[1][i], normal[2][i]).cast<double>();
    of_fan_[i]->error += fan_batch_.error[i];
  }
  fans_ = 0;
}

void NormalSums::add_edge(const Surface& surface, std::uint32_t edge, RoughNormal& normal) {
  const std::array<std::uint32_t, 2> end = surface.mesh().edge(edge);
  for (const std::uint32_t face : surface.mesh().edge_faces(edge))
    for_each_triangle_from(end[0], surface.mesh().face(face), [&](const Corners& corner) {
      if (corner[1] == end[1] || corner[2] == end[1]) add_triangle(surface, corner, normal);
    });
}

void NormalSums::add_triangle(const Surface& surface, const Corners& corner, RoughNormal& normal) {
  for (std::size_t i = 0; i < 3; ++i) put_corner(surface, corner[i], triangle_batch_.corner[i], triangles_);
  of_triangle_[triangles_] = &normal;
  if (++triangles_ == of_triangle_.size()) finish_triangles();
}

void NormalSums::finish_triangles() {
  if (triangles_ == 0) return;
  kernels::measure().normals(triangle_batch_);
  for (std::size_t i = 0; i < triangles_; ++i) {
    const auto& normal = triangle_batch_.normal;
    of_triangle_[i]->sum += Eigen::Vector3d(normal[0][i], normal[1][i], normal[2][i]);
    of_triangle_[i]->error += triangle_batch_.error[i];
  }
  triangles_ = 0;
}

void NormalSums::finish() {
  finish_triangles();
  finish_fans();
}

std::optional<Side> certain_side(const RoughNormal& normal, const Eigen::Vector3d& direction) {
  const double along = normal.sum.dot(direction);
  if (!(std::abs(along) > normal.error + 0x1p-34)) return std::nullopt;
  return along > 0 ? Side::front : Side::back;
}

}  // namespace graze
