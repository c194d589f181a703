#include "examples/loops/shape.hpp"

#include <cmath>
#include <numbers>

namespace loops {

Shape revolved(std::span<const Eigen::Vector2d> line, std::uint32_t segments) {
  Shape shape;
  const auto add = [&](double x, double y, double z) {
    shape.points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  };
  add(0, 0, line.front().y());
  for (const Eigen::Vector2d& point : line.subspan(1, line.size() - 2))
    for (std::uint32_t i = 0; i < segments; ++i) {
      const double angle = 2 * std::numbers::pi * i / segments;
      add(point.x() * std::cos(angle), point.x() * std::sin(angle), point.y());
    }
  add(0, 0, line.back().y());

  const std::uint32_t rings = static_cast<std::uint32_t>(line.size()) - 2;
  const auto vertex = [&](std::uint32_t ring, std::uint32_t i) { return 1 + ring * segments + i % segments; };
  for (std::uint32_t i = 0; i < segments; ++i) {
    shape.triangles.push_back({0, vertex(0, i + 1), vertex(0, i)});
    for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
      shape.triangles.push_back({vertex(ring, i), vertex(ring, i + 1), vertex(ring + 1, i + 1)});
      shape.triangles.push_back({vertex(ring, i), vertex(ring + 1, i + 1), vertex(ring + 1, i)});
    }
    shape.triangles.push_back({vertex(rings - 1, i), vertex(rings - 1, i + 1), 1 + rings * segments});
  }
  return shape;
}

Shape ball(double radius, std::uint32_t segments, std::uint32_t rings) {
  std::vector<Eigen::Vector2d> line;
  for (std::uint32_t i = 0; i <= rings + 1; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / (rings + 1) - 0.5);
    line.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return revolved(line, segments);
}

Shape box(const Eigen::Vector3d& size) {
  Shape shape;
  for (const double z : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double x : {-0.5, 0.5})
        shape.points.push_back(size.cwiseProduct(Eigen::Vector3d(x, y, z)).cast<float>());
  shape.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

std::shared_ptr<const graze::Mesh> make_mesh(const Shape& shape) {
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
}

}  // namespace loops
