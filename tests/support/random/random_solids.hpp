#pragma once

#include "support/random/random_scenes.hpp"

namespace graze::oracle {

/// Two small shapes, most of them closed, and which of them are solids.
struct RandomSolids {
  Shape a, b;
  Solids solids;
  double threshold = 0;
};

/// The scene of a seed. Odd seeds put all coordinates and the threshold on a grid of small whole numbers.
/// Even ones move every vertex off the grid. Shapes have 4 to 20 vertices. There are boxes, tetrahedra,
/// octahedra, prisms, frames and tori, and two closed parts that are apart, touch, overlap or lie in each
/// other. Some are inside out, have vertices moved about, or lack a face. A shape that lacks one is no solid.
RandomSolids random_solids(std::uint64_t seed);

/// The next step of a shape: as a whole by up to one step of the grid along each axis, or only one vertex.
void move_on_grid(Shape& shape, Random& random);

/// Whether each edge has two faces that pass it in opposite directions.
bool is_closed(const Shape& shape);

/// How often scenes reached each case, so that a test can assert that none was missed.
struct SolidCoverage {
  std::array<std::size_t, 4> containments{};  ///< by Containment
  std::size_t inside_by_winding_two = 0;      ///< vertices with a winding number of 2 or more
  std::size_t inside_by_negative = 0;         ///< vertices with a negative winding number
  std::size_t on_surface = 0;                 ///< vertices on the surface of a solid
  std::size_t deep_contacts = 0;              ///< contacts that only a solid's inside makes
  std::size_t both_sides = 0;                 ///< VV contacts of two solids
  std::size_t without_piercing = 0;           ///< `crossing` although no edge pierces a face

  void count(const RandomSolids& scene);
};

}  // namespace graze::oracle
