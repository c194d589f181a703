#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/certain.hpp"
#include "core/cast/ray.hpp"

namespace graze {

/// The first point that a ray and a triangle share.
struct RayMeeting {
  double t = 0;        ///< correctly rounded
  VoronoiRegion part;  ///< a corner, the inside of a side, or the inside of the triangle
};

/// Asks triangles whether a ray meets them. Decides exactly, so that a ray never passes between two triangles
/// with a common edge.
class RayTriangleTest {
 public:
  explicit RayTriangleTest(const Ray& ray);

  /// Says that the corners of the triangles that come are in a box.
  void begin(const Box& box);
  /// Returns nothing where the ray misses the triangle. It may, if they meet after `limit`.
  [[nodiscard]] std::optional<RayMeeting> meet(const std::array<Eigen::Vector3d, 3>& corner, double limit,
                                               DecisionCount& count) const {
    const Turns turns = turns_about(corner);
    if (turns.least < -off_turn_ && turns.most > off_turn_) return std::nullopt;
    return meet_near(corner, turns, limit, count);
  }

 private:
  /// The least and the largest of the ray's turns about the three sides, each divided by one positive number.
  struct Turns {
    double least, most;
  };

  [[nodiscard]] Turns turns_about(const std::array<Eigen::Vector3d, 3>& corner) const {
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    for (std::size_t i = 0; i < 3; ++i) {
      const double along = corner[i][main_axis_] - ray_.origin[main_axis_];
      x[i] = corner[i][x_axis_] - ray_.origin[x_axis_] - x_slope_ * along;
      y[i] = corner[i][y_axis_] - ray_.origin[y_axis_] - y_slope_ * along;
    }
    const double turn_01 = x[0] * y[1] - y[0] * x[1];
    const double turn_12 = x[1] * y[2] - y[1] * x[2];
    const double turn_20 = x[2] * y[0] - y[2] * x[0];
    return {std::min({turn_01, turn_12, turn_20}), std::max({turn_01, turn_12, turn_20})};
  }
  [[nodiscard]] std::optional<RayMeeting> meet_near(const std::array<Eigen::Vector3d, 3>& corner,
                                                    const Turns& turns, double limit,
                                                    DecisionCount& count) const;

  Ray ray_;
  // The axis along which the direction is largest, and the two others. A turn has the sign of a determinant
  // in this order of axes.
  int main_axis_ = 0;
  int x_axis_ = 0;
  int y_axis_ = 0;
  double x_slope_ = 0;  ///< of the ray's line, along x for each unit of the main axis
  double y_slope_ = 0;
  double off_turn_ = 0;  ///< by which a turn may be off
};

}  // namespace graze
