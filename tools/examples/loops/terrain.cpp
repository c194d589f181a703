#include "examples/loops/terrain.hpp"

#include <algorithm>
#include <cmath>

namespace loops {
namespace {

constexpr std::uint32_t cells = 64;  // along each side

using Triangle = std::array<std::uint32_t, 3>;

/// Returns the vertices along the border of the grid, counterclockwise seen from above.
std::vector<std::uint32_t> border() {
  constexpr std::uint32_t row = cells + 1;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < cells; ++i) found.push_back(i);
  for (std::uint32_t i = 0; i < cells; ++i) found.push_back(i * row + cells);
  for (std::uint32_t i = cells; i > 0; --i) found.push_back(cells * row + i);
  for (std::uint32_t i = cells; i > 0; --i) found.push_back(i * row);
  return found;
}

}  // namespace

double ground_height(double x, double y) {
  const double hills = 0.5 * std::sin(0.3 * x) * std::cos(0.25 * y);
  const double outwards = std::max(0.0, std::hypot(x, y) - 22);
  return hills + 0.06 * outwards * outwards;
}

Shape terrain() {
  Shape shape;
  for (const bool is_top : {true, false})
    for (std::uint32_t row = 0; row <= cells; ++row)
      for (std::uint32_t column = 0; column <= cells; ++column) {
        const double x = terrain_half_width * (2.0 * column / cells - 1);
        const double y = terrain_half_width * (2.0 * row / cells - 1);
        shape.points.push_back(Eigen::Vector3d(x, y, is_top ? ground_height(x, y) : -4).cast<float>());
      }
  const auto below = static_cast<std::uint32_t>(shape.points.size() / 2);
  for (std::uint32_t row = 0; row < cells; ++row)
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t a = row * (cells + 1) + column, b = a + 1, c = a + cells + 2, d = a + cells + 1;
      for (const Triangle& triangle : {Triangle{a, b, c}, Triangle{a, c, d}}) {
        shape.triangles.push_back(triangle);
        shape.triangles.push_back({triangle[0] + below, triangle[2] + below, triangle[1] + below});
      }
    }
  const std::vector<std::uint32_t> around = border();
  for (std::size_t i = 0; i < around.size(); ++i) {
    const std::uint32_t a = around[i], b = around[(i + 1) % around.size()];
    shape.triangles.push_back({a, a + below, b + below});
    shape.triangles.push_back({a, b + below, b});
  }
  return shape;
}

}  // namespace loops
