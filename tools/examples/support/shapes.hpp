#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

/// Shapes that the examples are made of. All lengths are in metres, and z is up.
namespace examples {

using Points = std::vector<Eigen::Vector3d>;

/// A surface of triangles. Those of closed shapes are wound so that they face outward.
struct Shape {
  Points points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Turns a line of points (radius, height) about the z axis. The first and the last of them lie on the axis.
/// The surface faces to the right of the line's way. It is closed.
Shape revolved(std::span<const Eigen::Vector2d> line, int segments);

/// Returns a closed ball about the origin, of `rings` circles of `segments` vertices and two poles.
Shape ball(double radius, int segments, int rings);

/// Returns the lower half of a spherical shell about the origin, open at the top. It is a closed surface with
/// an inside: its wall has the given thickness, and its rim is at z = 0. `radius` is that of the hollow.
Shape bowl(double radius, double thickness, int segments, int rings);

/// Returns a closed box about the origin.
Shape box(const Eigen::Vector3d& size);

/// Returns a closed box whose top is the middle of the plane z = 0. A floor is a large and thick one.
Shape floor_box(double width, double thickness);

/// Returns a closed box about the origin, whose top and bottom have columns × rows cells, along x and y.
Shape box_of_cells(const Eigen::Vector3d& size, int columns, int rows);

/// Returns an open square sheet about the origin in the plane z = 0, facing up, of vertices × vertices
/// points.
Shape sheet(double width, int vertices);

/// Returns an open square sheet that hangs in slight waves, so that it folds where its lower edge is stopped.
/// That edge is at the given height. `waves` are those in 2 pi metres of height.
Shape hanging_sheet(double width, int vertices, double height, double waves);

/// Returns a shape that is moved by an offset.
Shape moved(Shape shape, const Eigen::Vector3d& offset);

}  // namespace examples
