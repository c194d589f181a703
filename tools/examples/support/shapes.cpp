#include "examples/support/shapes.hpp"

#include <cmath>
#include <numbers>

namespace examples {
namespace {

constexpr double pi = std::numbers::pi;

Eigen::Vector2d on_circle(double radius, double angle) {
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

Shape revolved(std::span<const Eigen::Vector2d> line, int segments) {
  Shape shape;
  shape.points.emplace_back(0, 0, line.front().y());
  for (const Eigen::Vector2d& point : line.subspan(1, line.size() - 2))
    for (int i = 0; i < segments; ++i) {
      const double angle = 2 * pi * i / segments;
      shape.points.emplace_back(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
    }
  shape.points.emplace_back(0, 0, line.back().y());

  const auto count = static_cast<std::uint32_t>(segments);
  const auto last_ring = static_cast<std::uint32_t>(line.size()) - 3;
  const auto vertex = [&](std::uint32_t ring, std::uint32_t i) { return 1 + ring * count + i % count; };
  const auto last = static_cast<std::uint32_t>(shape.points.size()) - 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    shape.triangles.push_back({0, vertex(0, i + 1), vertex(0, i)});
    for (std::uint32_t ring = 0; ring < last_ring; ++ring) {
      shape.triangles.push_back({vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1)});
      shape.triangles.push_back({vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring + 1, i)});
    }
    shape.triangles.push_back({vertex(last_ring, i), vertex(last_ring, i + 1), last});
  }
  return shape;
}

Shape ball(double radius, int segments, int rings) {
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i <= rings + 1; ++i) line.push_back(on_circle(radius, pi * i / (rings + 1) - pi / 2));
  return revolved(line, segments);
}

Shape bowl(double radius, double thickness, int segments, int rings) {
  std::vector<Eigen::Vector2d> line;
  for (int i = 0; i <= rings; ++i)  // up on the outside
    line.push_back(on_circle(radius + thickness, pi / 2 * i / rings - pi / 2));
  for (int i = rings; i >= 0; --i)  // down on the inside
    line.push_back(on_circle(radius, pi / 2 * i / rings - pi / 2));
  return revolved(line, segments);
}

Shape box(const Eigen::Vector3d& size) {
  Shape shape;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5}) shape.points.push_back(size.cwiseProduct(Eigen::Vector3d(x, y, z)));
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

Shape floor_box(double width, double thickness) {
  return moved(box({width, width, thickness}), {0, 0, -thickness / 2});
}

Shape box_of_cells(const Eigen::Vector3d& size, int columns, int rows) {
  Shape shape;
  for (const double z : {0.0, 1.0})
    for (int row = 0; row <= rows; ++row)
      for (int column = 0; column <= columns; ++column)
        shape.points.push_back(size.cwiseProduct(
            Eigen::Vector3d(1.0 * column / columns - 0.5, 1.0 * row / rows - 0.5, z - 0.5)));
  const auto vertex = [&](int column, int row, int level) {
    return static_cast<std::uint32_t>((level * (rows + 1) + row) * (columns + 1) + column);
  };
  const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, std::uint32_t l) {
    shape.triangles.push_back({i, j, k});
    shape.triangles.push_back({i, k, l});
  };
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < rows; ++y) {
      add(vertex(x, y, 1), vertex(x + 1, y, 1), vertex(x + 1, y + 1, 1), vertex(x, y + 1, 1));
      add(vertex(x, y, 0), vertex(x, y + 1, 0), vertex(x + 1, y + 1, 0), vertex(x + 1, y, 0));
    }
  for (int x = 0; x < columns; ++x) {
    add(vertex(x, 0, 0), vertex(x + 1, 0, 0), vertex(x + 1, 0, 1), vertex(x, 0, 1));
    add(vertex(x, rows, 0), vertex(x, rows, 1), vertex(x + 1, rows, 1), vertex(x + 1, rows, 0));
  }
  for (int y = 0; y < rows; ++y) {
    add(vertex(0, y, 0), vertex(0, y, 1), vertex(0, y + 1, 1), vertex(0, y + 1, 0));
    add(vertex(columns, y, 0), vertex(columns, y + 1, 0), vertex(columns, y + 1, 1), vertex(columns, y, 1));
  }
  return shape;
}

Shape sheet(double width, int vertices) {
  Shape shape;
  const double edge = width / (vertices - 1);
  for (int row = 0; row < vertices; ++row)
    for (int column = 0; column < vertices; ++column)
      shape.points.emplace_back(edge * column - width / 2, edge * row - width / 2, 0);
  const auto count = static_cast<std::uint32_t>(vertices);
  for (std::uint32_t row = 0; row + 1 < count; ++row)
    for (std::uint32_t column = 0; column + 1 < count; ++column) {
      const std::uint32_t corner = row * count + column;
      shape.triangles.push_back({corner, corner + 1, corner + count + 1});
      shape.triangles.push_back({corner, corner + count + 1, corner + count});
    }
  return shape;
}

Shape hanging_sheet(double width, int vertices, double height, double waves) {
  Shape shape = sheet(width, vertices);
  for (Eigen::Vector3d& point : shape.points) {
    const double z = point.y() + width / 2 + height;
    point = {point.x(), 0.01 * std::sin(waves * z) + 0.003 * point.x(), z};
  }
  return shape;
}

Shape moved(Shape shape, const Eigen::Vector3d& offset) {
  for (Eigen::Vector3d& point : shape.points) point += offset;
  return shape;
}

}  // namespace examples
