#include "bench/rigid_bodies/rigid_body_shapes.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "models/models.hpp"

namespace graze::bench {
namespace {

using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr double density = 500;  // kg/m³

std::vector<double> numbers_of(const Points& points, const Vector3d& origin) {
  std::vector<double> numbers;
  for (const Vector3d& point : points)
    for (int i = 0; i < 3; ++i) numbers.push_back(point[i] - origin[i]);
  return numbers;
}

/// Parts and surface may stand anywhere: the centre of mass becomes the origin.
RigidBodyShape shape_of(const models::MeshData& data, const std::vector<Points>& parts) {
  const auto mesh_at = [&](const Points& points) {
    return std::make_shared<const Mesh>(Mesh::from_triangles(points, data.corners));
  };
  const Vector3d centre = rigid::mass_of(*mesh_at(data.positions), density).centre;
  RigidBodyShape shape;
  Points centred = data.positions;
  for (Vector3d& point : centred) point -= centre;
  shape.mesh = mesh_at(centred);
  shape.mass = rigid::mass_of(*shape.mesh, density);
  shape.plain.points = numbers_of(centred, Vector3d::Zero());
  for (std::size_t i = 0; i < data.corners.size(); i += 3)
    shape.plain.triangles.push_back({{data.corners[i], data.corners[i + 1], data.corners[i + 2]}});
  for (const Points& part : parts) shape.plain.parts.push_back(numbers_of(part, centre));
  return shape;
}

RigidBodyShapePtr kept(RigidBodyShape shape) {
  return std::make_shared<const RigidBodyShape>(std::move(shape));
}

/// The corners of a box between two points.
Points corners_between(const Vector3d& low, const Vector3d& high) {
  Points corners;
  for (unsigned i = 0; i < 8; ++i)
    corners.emplace_back((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                         (i & 4U) != 0 ? high.z() : low.z());
  return corners;
}

}  // namespace

RigidBodyShapePtr box_shape(const Vector3d& half) {
  const models::MeshData data = models::box(2 * half, models::Faces::triangles);
  RigidBodyShape shape = shape_of(data, {data.positions});
  for (int i = 0; i < 3; ++i) shape.plain.half[i] = half[i];
  return kept(std::move(shape));
}

RigidBodyShapePtr l_shape() {
  constexpr std::array<std::array<double, 2>, 6> outline = {
      {{0, 0}, {0.5, 0}, {0.5, 0.2}, {0.2, 0.2}, {0.2, 0.5}, {0, 0.5}}};
  models::MeshData data;
  for (const double z : {0.0, 0.2})
    for (const auto& [x, y] : outline) data.positions.emplace_back(x, y, z);
  for (std::uint32_t i = 1; i + 1 < 6; ++i) {
    data.add_face({0, i + 1, i});
    data.add_face({6, 6 + i, 6 + i + 1});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    data.add_face({i, next, 6 + next});
    data.add_face({i, 6 + next, 6 + i});
  }
  return kept(shape_of(
      data, {corners_between({0, 0, 0}, {0.5, 0.2, 0.2}), corners_between({0, 0.2, 0}, {0.2, 0.5, 0.2})}));
}

RigidBodyShapePtr ring_shape() {
  constexpr std::uint32_t around = 16;
  constexpr std::uint32_t across = 10;
  const models::MeshData data = models::torus(around, across, 0.18, 0.07);
  std::vector<Points> parts(around);
  for (std::uint32_t i = 0; i < around; ++i)
    for (const std::uint32_t ring : {i, (i + 1) % around})
      for (std::uint32_t j = 0; j < across; ++j) parts[i].push_back(data.positions[ring * across + j]);
  return kept(shape_of(data, parts));
}

RigidBodyShapePtr pawn_shape() {
  models::MeshData data = models::pawn();
  for (Vector3d& point : data.positions) point *= 0.25;
  constexpr std::size_t segments = 32;
  const std::size_t rings = (data.positions.size() - 2) / segments;
  const auto radius = [&](std::size_t ring) { return data.positions[1 + ring * segments].head<2>().norm(); };
  const auto height = [&](std::size_t ring) { return data.positions[1 + ring * segments].z(); };
  // Cuts at each ring where the outline turns outward.
  std::vector<Points> parts(1);
  for (std::size_t ring = 0; ring < rings; ++ring) {
    const auto add = [&] {
      for (std::size_t i = 0; i < segments; i += 2)
        parts.back().push_back(data.positions[1 + ring * segments + i]);
    };
    add();
    if (ring == 0 || ring + 1 == rings) continue;
    const double before = (radius(ring) - radius(ring - 1)) * (height(ring + 1) - height(ring));
    const double after = (radius(ring + 1) - radius(ring)) * (height(ring) - height(ring - 1));
    if (after <= before + 1e-12) continue;
    parts.emplace_back();
    add();
  }
  parts.back().push_back(data.positions.back());
  return kept(shape_of(data, parts));
}

}  // namespace graze::bench
