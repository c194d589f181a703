#pragma once

#include <Eigen/Core>
#include <array>
#include <graze/export.hpp>
#include <limits>
#include <utility>

#include "core/base/box.hpp"

namespace graze {

/// A box along axes of its own, which holds what is in a region. The bounds of docs/numerics.md take its
/// axes as orthonormal to 2^-45, and allow for more than that.
struct GRAZE_API OrientedBox {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< unit vectors, in rows
  /// The position from which the box is given. Coordinates enter by their differences from it alone.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< from the origin, along the axes
  Eigen::Vector3d half = Eigen::Vector3d::Zero();    ///< half of the sides, not less for rounding

  /// A box along the coordinate axes as an oriented one, where nothing better is known.
  static OrientedBox of(const Box& box);
};

/// Axes through three points: from the first to the second, and square to that towards the third. Any axes
/// square to each other where the points do not say which.
[[nodiscard]] GRAZE_API Eigen::Matrix3d axes_through(const std::array<Eigen::Vector3d, 3>& points);

/// Makes an oriented box large enough for all that is added.
class GRAZE_API OrientedExtent {
 public:
  OrientedExtent(Eigen::Matrix3d axes, Eigen::Vector3d origin)
      : axes_(std::move(axes)), origin_(std::move(origin)) {}

  void add(const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = axes_ * (point - origin_);
    low_ = low_.cwiseMin(at);
    high_ = high_.cwiseMax(at);
  }
  void add(const OrientedBox& box);
  /// Something has been added.
  [[nodiscard]] OrientedBox box() const;

 private:
  Eigen::Matrix3d axes_;
  Eigen::Vector3d origin_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high_ = -low_;
};

/// At most the distance of any two points of the boxes, as it shows along a's axes.
[[nodiscard]] GRAZE_API double lower_along_axes(const OrientedBox& a, const OrientedBox& b);

}  // namespace graze
