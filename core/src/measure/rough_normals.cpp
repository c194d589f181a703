#include "measure/rough_normals.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/prefetch.hpp"
#include "surface/corner_lane.hpp"
#include "surface/passes_for.hpp"

namespace graze {

namespace {

using Corners = std::array<std::uint32_t, 3>;

/// The corners of a triangle from one of them around. Without branches, which could not be foretold.
Corners turned_to(std::uint32_t vertex, std::span<const std::uint32_t> corner) {
  constexpr std::array<std::size_t, 6> around{0, 1, 2, 0, 1, 2};
  const std::size_t corner_index = (corner[1] == vertex ? 1U : 0U) + (corner[2] == vertex ? 2U : 0U);
  return {vertex, corner[around[corner_index + 1]], corner[around[corner_index + 2]]};
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

void make_normals(const kernels::FanBatch<float>& batch) {
  kernels::measure().fans_of_floats(batch);
}
void make_normals(const kernels::FanBatch<double>& batch) {
  kernels::measure().fans_of_doubles(batch);
}

template <typename Number>
void finish_fans(kernels::FanBatch<Number>& batch) {
  if (batch.count == 0) return;
  for (std::size_t i = batch.count; i % 4 != 0; ++i) batch.fan[i] = batch.fan[0];
  make_normals(batch);
  batch.count = batch.longest = 0;
}

}  // namespace

void NormalSums::begin() {
  triangles_ = 0;
  std::apply([](auto&... batch) { ((batch.count = batch.longest = 0), ...); }, fans_);
}

void NormalSums::add(const Surface& surface, const FeaturePiece& piece, RoughNormal& normal) {
  const std::uint32_t index = piece.feature.index;
  switch (piece.feature.kind) {
    case FeatureKind::vertex:
      return add_vertex(surface, index, normal);
    case FeatureKind::edge:
      normal = {};
      return add_edge(surface, index, normal);
    case FeatureKind::face:
      normal = {};
      if (piece.piece != Piece::fold) add_triangle(surface, corners_of(surface.mesh(), piece), normal);
  }
}

void NormalSums::add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal) {
  const std::span<const std::uint32_t> around = surface.mesh().vertex_fans(vertex);
  if (around.empty()) {
    normal = {};
    return;
  }
  prefetch(around.data());
  with_points(surface, [&]<typename Number>(const kernels::PointArray<Number>& points) {
    auto& batch = std::get<kernels::FanBatch<Number>>(fans_);
    batch.fan[batch.count++] = {points, vertex, around.data(), around.size(), &normal};
    batch.longest = std::max(batch.longest, around.size());
    if (batch.count == kernels::contact_lanes) finish_fans(batch);
  });
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
    for (std::size_t axis = 0; axis < 3; ++axis)
      of_triangle_[i]->sum[axis] += triangle_batch_.normal[axis][i];
    of_triangle_[i]->error += triangle_batch_.error[i];
  }
  triangles_ = 0;
}

void NormalSums::finish() {
  finish_triangles();
  std::apply([](auto&... batch) { (finish_fans(batch), ...); }, fans_);
}

std::optional<Side> certain_side(const RoughNormal& normal, const Eigen::Vector3d& direction) {
  const double along = Eigen::Map<const Eigen::Vector3d>(normal.sum).dot(direction);
  if (!(std::abs(along) > normal.error + 0x1p-34)) return std::nullopt;
  return along > 0 ? Side::front : Side::back;
}

}  // namespace graze
