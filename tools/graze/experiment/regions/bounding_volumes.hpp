#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/box.hpp"

// Bounds that a region may carry. Each kind of bound is a class `Volume`. Its `name` is a static constexpr
// const char*. Its function `around(points)` makes the bound of all points of a region, which has one at
// least. Its constant `merges` says whether `add` gives what `around` gives for all points. Only bounds that
// merge have `add(child)`, which extends a bound by a child's. The function `lower_distance(a, b)` gives at
// most the distance of any two points in the two bounds. Numbers are double in all of them. Rounding is
// always to the safe side: by the factors of core/base/box.hpp, or by 2^-44 of the sizes that take part,
// which is at least 64 times what the operations before it lose.
namespace graze::tools {

/// The present positions of the points of one region.
struct RegionPoints {
  std::span<const Eigen::Vector3d> points;
  const Eigen::Vector3d& middle;  ///< of the middle vertex (eq. 1); lives as long as the bound
};

/// At most the distance of any point within `radius_a` of `a` and any within `radius_b` of `b`.
inline double lower_distance_of_balls(const Eigen::Vector3d& a, double radius_a, const Eigen::Vector3d& b,
                                      double radius_b) {
  const double centres = std::max(0.0, (b - a).norm() - lost_to_underflow) * round_down;
  return std::max(0.0, (centres - (radius_a + radius_b) * round_up) * round_down);
}

/// At least how far any of the points is from `centre`.
inline double radius_about(const Eigen::Vector3d& centre, std::span<const Eigen::Vector3d> points) {
  double squared = 0;
  for (const Eigen::Vector3d& point : points) squared = std::max(squared, (point - centre).squaredNorm());
  return squared == 0 ? lost_to_underflow : std::sqrt(squared) * round_up + lost_to_underflow;
}

/// The paper's: about the middle vertex, where it is now, with the radius of eq. 2.
struct MiddleSphere {
  static constexpr const char* name = "middle-vertex sphere";
  static constexpr bool merges = false;

  const Eigen::Vector3d* middle = nullptr;
  double radius = 0;

  static MiddleSphere around(const RegionPoints& region) {
    return {&region.middle, radius_about(region.middle, region.points)};
  }
  friend double lower_distance(const MiddleSphere& a, const MiddleSphere& b) {
    return lower_distance_of_balls(*a.middle, a.radius, *b.middle, b.radius);
  }
};

/// About the centre of the points' box.
struct CentredSphere {
  static constexpr const char* name = "centred sphere";
  static constexpr bool merges = false;

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;

  static CentredSphere around(const RegionPoints& region) {
    Box box;
    for (const Eigen::Vector3d& point : region.points) box.add(point);
    const Eigen::Vector3d centre = 0.5 * box.min + 0.5 * box.max;
    return {centre, radius_about(centre, region.points)};
  }
  friend double lower_distance(const CentredSphere& a, const CentredSphere& b) {
    return lower_distance_of_balls(a.centre, a.radius, b.centre, b.radius);
  }
};

/// The library's own.
struct AxisBox {
  static constexpr const char* name = "box";
  static constexpr bool merges = true;

  Box box;

  static AxisBox around(const RegionPoints& region) {
    AxisBox result;
    for (const Eigen::Vector3d& point : region.points) result.box.add(point);
    return result;
  }
  void add(const AxisBox& child) { box.add(child.box); }
  friend double lower_distance(const AxisBox& a, const AxisBox& b) {
    return graze::lower_distance(a.box, b.box);
  }
};

/// Between pairs of parallel planes, in `sides` / 2 directions: the axes, for 18 and 26 the diagonals of the
/// unit cube's faces, for 14 and 26 those of the cube.
template <std::size_t sides>
struct DirectionPolytope {
  static_assert(sides == 14 || sides == 18 || sides == 26);
  static constexpr const char* name = sides == 14 ? "14-DOP" : sides == 18 ? "18-DOP" : "26-DOP";
  static constexpr bool merges = true;
  static constexpr std::size_t direction_count = sides / 2;
  static constexpr bool has_face_diagonals = sides != 14;
  static constexpr bool has_cube_diagonals = sides != 18;
  static constexpr std::size_t first_cube_diagonal = has_face_diagonals ? 9 : 3;

  std::array<double, direction_count> low;
  std::array<double, direction_count> high;

  static DirectionPolytope around(const RegionPoints& region) {
    DirectionPolytope result = at(region.points.front());
    for (const Eigen::Vector3d& point : region.points.subspan(1)) result.add(at(point));
    double largest = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      largest = std::max({largest, std::abs(result.low[axis]), std::abs(result.high[axis])});
    // The axes' are exact; a diagonal's sums may cancel.
    for (std::size_t i = 3; i < direction_count; ++i) {
      result.low[i] -= largest * 0x1p-50;
      result.high[i] += largest * 0x1p-50;
    }
    return result;
  }
  void add(const DirectionPolytope& child) {
    for (std::size_t i = 0; i < direction_count; ++i) {
      low[i] = std::min(low[i], child.low[i]);
      high[i] = std::max(high[i], child.high[i]);
    }
  }

  /// The axes are at right angles to each other, and so is each to the two diagonals of the face across it,
  /// which are so to each other: gaps in such directions add up as sides of a right angle do.
  friend double lower_distance(const DirectionPolytope& a, const DirectionPolytope& b) {
    std::array<double, direction_count> squared;
    for (std::size_t i = 0; i < direction_count; ++i) {
      const double gap = std::max(0.0, std::max(a.low[i] - b.high[i], b.low[i] - a.high[i]));
      squared[i] = gap * gap;
    }
    double largest = squared[0] + squared[1] + squared[2];
    if constexpr (has_face_diagonals)
      for (std::size_t axis = 0; axis < 3; ++axis)
        largest = std::max(largest, squared[axis] + 0.5 * (squared[3 + 2 * axis] + squared[4 + 2 * axis]));
    if constexpr (has_cube_diagonals)
      for (std::size_t i = first_cube_diagonal; i < direction_count; ++i)
        largest = std::max(largest, squared[i] / 3);
    if (largest == 0) return 0;
    return std::max(0.0, std::sqrt(largest) - lost_to_underflow) * round_down;
  }

 private:
  static DirectionPolytope at(const Eigen::Vector3d& p) {
    DirectionPolytope result;
    auto& at = result.low;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = p[static_cast<Eigen::Index>(axis)];
      if constexpr (has_face_diagonals) {
        const double left = p[static_cast<Eigen::Index>((axis + 1) % 3)];
        const double right = p[static_cast<Eigen::Index>((axis + 2) % 3)];
        at[3 + 2 * axis] = left + right;
        at[4 + 2 * axis] = left - right;
      }
    }
    if constexpr (has_cube_diagonals) {
      at[first_cube_diagonal] = p.x() + p.y() + p.z();
      at[first_cube_diagonal + 1] = p.x() + p.y() - p.z();
      at[first_cube_diagonal + 2] = p.x() - p.y() + p.z();
      at[first_cube_diagonal + 3] = p.x() - p.y() - p.z();
    }
    result.high = result.low;
    return result;
  }
};

}  // namespace graze::tools
