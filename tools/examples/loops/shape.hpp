#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <vector>

namespace loops {

/// A surface of triangles that face outward.
struct Shape {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Turns a line of points (radius, height) about the z axis, upwards. Its first and last point lie on the
/// axis. The surface is closed.
Shape revolved(std::span<const Eigen::Vector2d> line, std::uint32_t segments);

/// Returns a closed ball about the origin.
Shape ball(double radius, std::uint32_t segments, std::uint32_t rings);

/// Returns a closed box about the origin.
Shape box(const Eigen::Vector3d& size);

std::shared_ptr<const graze::Mesh> make_mesh(const Shape& shape);

}  // namespace loops
