#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace graze::io {

/// A grid of values, row by row from the top.
template <typename Value>
struct Grid {
  Grid(int grid_width, int grid_height, const Value& value)
      : width(grid_width),
        height(grid_height),
        values(static_cast<std::size_t>(grid_width) * static_cast<std::size_t>(grid_height), value) {}

  [[nodiscard]] Value& at(int x, int y) { return values[index(x, y)]; }
  [[nodiscard]] const Value& at(int x, int y) const { return values[index(x, y)]; }
  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }

  int width;
  int height;
  std::vector<Value> values;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// Corners on the screen: x and y in samples, z grows towards the eye and is linear over the screen.
using ScreenTriangle = std::array<Eigen::Vector3d, 3>;

inline double cross_2d(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Calls visit(x, y, weights of the corners) for every sample whose centre the triangle covers.
template <typename Visit>
void for_each_sample(const ScreenTriangle& corners, int width, int height, Visit visit) {
  const auto& [a, b, c] = corners;
  const double area = cross_2d(a, b, c);
  if (!std::isfinite(area) || area == 0) return;
  const auto clamp = [](double value, int limit) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(limit)));
  };
  const int first_x = clamp(std::floor(std::min({a.x(), b.x(), c.x()})), width);
  const int last_x = clamp(std::ceil(std::max({a.x(), b.x(), c.x()})), width);
  const int first_y = clamp(std::floor(std::min({a.y(), b.y(), c.y()})), height);
  const int last_y = clamp(std::ceil(std::max({a.y(), b.y(), c.y()})), height);
  for (int y = first_y; y < last_y; ++y)
    for (int x = first_x; x < last_x; ++x) {
      const Eigen::Vector3d point(x + 0.5, y + 0.5, 0);
      const Eigen::Vector3d weights(cross_2d(b, c, point) / area, cross_2d(c, a, point) / area,
                                    cross_2d(a, b, point) / area);
      if (weights.minCoeff() >= 0) visit(x, y, weights);
    }
}

}  // namespace graze::io
