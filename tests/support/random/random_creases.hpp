#pragma once

#include <array>
#include <string>

#include "support/random/random_scenes.hpp"

namespace graze::oracle {

/// How two surfaces of a scene lie.
enum class Lie : std::uint8_t {
  resting,   ///< b on a, a little apart, flush or flat on each other
  tilted,    ///< as resting, but turned about a level axis by 1e-6 or 1e-3
  sunk,      ///< as resting or tilted, but into each other by less than the threshold
  crossing,  ///< b turned at random, its middle near the surface of a
  deep,      ///< b turned at random, its middle near the middle of a
  plates,    ///< two thin boxes on each other, apart, flush, or sunk by less than they are thick
  hulls,     ///< b turned at random, its lowest corner a little over the surface of a
};
inline constexpr std::size_t lie_count = 7;

/// Two surfaces with many creases: at rest, and where their vertices are now.
struct CreaseScene {
  Shape rest_a, rest_b;
  Shape a, b;
  double threshold = 0;
  Lie lie = Lie::resting;
  bool is_deformed = false;  ///< vertices moved, not only bodies
};

/// The scene of a seed. The lies follow one another. Surfaces have 2 to about 100 faces: boxes of triangles
/// and quads, coarse balls, spiky hulls, terrain, sheets, folded sheets close to the angle of a crease, boxes
/// of warped quads, open boxes, and pages that share an edge. Some scenes are scaled by 2^±100.
CreaseScene random_creases(std::uint64_t seed);

/// A step of a scene: b, and sometimes a, drifts or turns a little, or vertices of it move.
void move_a_little(CreaseScene& scene, Random& random);

/// Turned about an axis, not of length 0, by an angle in radians.
Shape turned_about(Shape shape, const Eigen::Vector3d& axis, double angle);

}  // namespace graze::oracle
