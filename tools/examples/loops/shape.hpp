#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/support/shapes.hpp"

namespace loops {

/// A surface of triangles that face outward. Its points are floats, as most animations have them.
struct Shape {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Rounds the points of a shape to float.
Shape rounded(const examples::Shape& shape);

std::shared_ptr<const graze::Mesh> make_mesh(const Shape& shape);

}  // namespace loops
