#include "examples/support/body.hpp"

#include <algorithm>
#include <array>

namespace examples {
namespace {

Body body_of(const Shape& shape, double inverse_mass, bool is_solid) {
  Body body;
  body.is_solid = is_solid;
  body.mesh = std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
  body.positions = shape.points;
  body.previous = shape.points;
  body.velocities.assign(shape.points.size(), Eigen::Vector3d::Zero());
  body.inverse_masses.assign(shape.points.size(), inverse_mass);
  return body;
}

void add_spring(Body& body, std::uint32_t a, std::uint32_t b, double compliance) {
  body.springs.push_back({a, b, (body.positions[a] - body.positions[b]).norm(), compliance});
}

void add_edge_springs(Body& body, double compliance) {
  for (std::uint32_t edge = 0; edge < body.mesh->edge_count(); ++edge) {
    const auto [a, b] = body.mesh->edge(edge);
    add_spring(body, a, b, compliance);
  }
}

/// Returns the corner of a triangle that is not on an edge of it.
std::uint32_t corner_opposite(const graze::Mesh& mesh, std::uint32_t face, std::uint32_t edge) {
  const std::array<std::uint32_t, 2> ends = mesh.edge(edge);
  const auto corners = mesh.face(face);
  return *std::find_if(corners.begin(), corners.end(),
                       [&](auto corner) { return corner != ends[0] && corner != ends[1]; });
}

/// A spring for each two triangles that share an edge, between their corners opposite of it.
void add_bend_springs(Body& body, double compliance) {
  for (std::uint32_t edge = 0; edge < body.mesh->edge_count(); ++edge) {
    const auto faces = body.mesh->edge_faces(edge);
    if (faces.size() == 2)
      add_spring(body, corner_opposite(*body.mesh, faces[0], edge),
                 corner_opposite(*body.mesh, faces[1], edge), compliance);
  }
}

}  // namespace

Body fixed_body(const Shape& shape) {
  return body_of(shape, 0, true);
}

Body cloth(const Shape& shape, double mass) {
  Body body = body_of(shape, static_cast<double>(shape.points.size()) / mass, false);
  add_edge_springs(body, 1e-6);
  add_bend_springs(body, 1e-2);
  return body;
}

Body soft_ball(const Shape& shape, const Eigen::Vector3d& centre, double mass, double compliance) {
  Shape with_centre = shape;
  with_centre.points.push_back(centre);
  const std::size_t surface_vertices = shape.points.size();
  Body body = body_of(with_centre, static_cast<double>(surface_vertices) / (mass / 2), true);
  body.inverse_masses.back() = 1 / (mass / 2);
  add_edge_springs(body, compliance);
  for (std::uint32_t vertex = 0; vertex < surface_vertices; ++vertex)
    add_spring(body, vertex, static_cast<std::uint32_t>(surface_vertices), compliance);
  return body;
}

double energy(const Body& body, double gravity) {
  double sum = 0;
  for (std::size_t i = 0; i < body.positions.size(); ++i)
    if (body.inverse_masses[i] > 0)
      sum +=
          (body.velocities[i].squaredNorm() / 2 + gravity * body.positions[i].z()) / body.inverse_masses[i];
  return sum;
}

double largest_speed(const Body& body) {
  double largest = 0;
  for (const Eigen::Vector3d& velocity : body.velocities) largest = std::max(largest, velocity.norm());
  return largest;
}

}  // namespace examples
