#pragma once

#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/support/shapes.hpp"

namespace examples {

/// Holds two vertices of a body at a distance from each other.
struct Spring {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double rest_length = 0;
  double compliance = 0;  ///< stretch by force, in m/N, 0 is rigid
  double multiplier = 0;  ///< of XPBD: grows over the iterations of one step
};

/// Point masses at the vertices of a mesh, and springs between them. Masses are in kg.
struct Body {
  std::shared_ptr<const graze::Mesh> mesh;
  Points positions;
  Points previous;  ///< positions at the beginning of the step
  Points velocities;
  std::vector<double> inverse_masses;  ///< 0 where nothing pushes a vertex
  std::vector<Spring> springs;
  bool is_solid = false;      ///< whether the surface is closed and bounds a volume
  bool meets_itself = false;  ///< whether graze tests the surface against itself, all but neighbours
};

/// Returns a solid body without springs that nothing pushes. It moves by the velocities that a program gives
/// it.
Body fixed_body(const Shape& shape);

/// Returns a cloth, which is no solid. Each vertex has the same share of the mass. It resists stretch along
/// the edges of the mesh, and bending across them.
Body cloth(const Shape& shape, double mass);

/// Returns a solid soft ball of a closed shape. Its last vertex is at `centre`, belongs to no face and has
/// half of the mass. Springs go along the edges of the mesh, and from each vertex to that centre. So the ball
/// stays round without any measure of its volume.
Body soft_ball(const Shape& shape, const Eigen::Vector3d& centre, double mass, double compliance);

/// Returns kinetic and potential energy of a body, in J. Height 0 has none. Springs are left out.
double energy(const Body& body, double gravity);

/// Returns the speed of the fastest vertex.
double largest_speed(const Body& body);

}  // namespace examples
