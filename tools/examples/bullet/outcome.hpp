#pragma once

#include <cstddef>
#include <string>

#include "examples/bullet/bodies.hpp"
#include "examples/bullet/graze_world.hpp"

namespace examples::bullet {

/// How bodies lie in each other, by the exact winding number of each vertex.
struct Through {
  std::size_t vertices = 0;
  double deepest = 0;  ///< m, from such a vertex to the surface it is behind
};

/// Looks at the vertices of all balls and of the paddle, where they are now.
Through through(const Bodies& bodies);

/// Compares the contacts of a world's last report with the exact oracle of the tests. Returns how many
/// contacts were compared. Appends what differs to `difference`.
std::size_t compare(const GrazeWorld& world, const Bodies& bodies, std::string& difference);

}  // namespace examples::bullet
