#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace graze::bench {

/// An axis-aligned box in float, empty at first.
struct FloatBox {
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  float min[3] = {infinity, infinity, infinity};
  float max[3] = {-infinity, -infinity, -infinity};

  [[nodiscard]] bool is_empty() const { return min[0] > max[0]; }
  void add(const FloatBox& other) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = other.min[axis] < min[axis] ? other.min[axis] : min[axis];
      max[axis] = other.max[axis] > max[axis] ? other.max[axis] : max[axis];
    }
  }
  void add(const float* point) {
    for (int axis = 0; axis < 3; ++axis) {
      min[axis] = point[axis] < min[axis] ? point[axis] : min[axis];
      max[axis] = point[axis] > max[axis] ? point[axis] : max[axis];
    }
  }
  [[nodiscard]] bool meets(const FloatBox& other) const {
    bool result = true;
    for (int axis = 0; axis < 3; ++axis)
      result = result && min[axis] <= other.max[axis] && other.min[axis] <= max[axis];
    return result;
  }
};

/// The box grown by at least `by` on every side.
inline FloatBox grown(const FloatBox& box, double by) {
  constexpr float rounding = 0x1p-21F;  // more than the three operations lose
  const float more = static_cast<float>(by) * (1 + rounding);
  FloatBox result;
  for (int axis = 0; axis < 3; ++axis) {
    result.min[axis] = box.min[axis] - (more + rounding * std::abs(box.min[axis]));
    result.max[axis] = box.max[axis] + (more + rounding * std::abs(box.max[axis]));
  }
  return result;
}

/// The box of all points that are in both boxes.
FloatBox common(const FloatBox& a, const FloatBox& b);

/// The box of `count` points of three floats.
FloatBox box_of(const float* points, std::size_t count);

/// The sum of `count` floats, in some order.
float sum_of(const float* numbers, std::size_t count);

/// A number that no squared distance below distance² exceeds, when both are made in float of float
/// coordinates.
float square_above(double distance);

/// Some points of an object, by coordinate. The arrays are longer than `count`: whole vectors of eight may be
/// read and written behind it.
struct PointList {
  void clear() { count = 0; }
  /// Room for so many more, and a vector behind them.
  void make_room(std::size_t more);
  [[nodiscard]] FloatBox box() const;

  std::size_t count = 0;
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> index;
};

/// Adds those of `count` points, numbered from `first`, that are inside the box.
void add_inside(const float* points, std::uint32_t first, std::size_t count, const FloatBox& box,
                PointList& list);
/// Keeps those that are inside the box.
void keep_inside(const FloatBox& box, PointList& list);

/// The places among `begin` to `end` of a list whose squared distance from the point is at most `limit`.
/// Returns behind the last one written. `out` has room for all and a vector.
std::uint32_t* add_near(const PointList& list, std::size_t begin, std::size_t end, float x, float y, float z,
                        float limit, std::uint32_t* out);

}  // namespace graze::bench
