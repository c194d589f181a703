#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/box.hpp"
#include "core/surface/oriented_box.hpp"
#include "kernels/filter.hpp"
#include "kernels/positions.hpp"
#include "surface/leaf_slab.hpp"

namespace graze {

/// The coordinates that the float kernels see. They are relative to a corner of the smaller of two leaves and
/// scaled by a power of two to its size. So neither the position nor the size of a scene makes a difference.
class FilterFrame {
 public:
  /// The frame of nothing.
  FilterFrame() = default;
  FilterFrame(const Box& a, const Box& b) {
    const Eigen::Vector3d extent_a = a.max - a.min;
    const Eigen::Vector3d extent_b = b.max - b.min;
    const bool a_is_smaller = extent_a.maxCoeff() <= extent_b.maxCoeff();
    origin_ = a_is_smaller ? a.min : b.min;
    double extent = a_is_smaller ? extent_a.maxCoeff() : extent_b.maxCoeff();
    if (extent == 0) extent = std::max(extent_a.maxCoeff(), extent_b.maxCoeff());
    if (extent == 0) extent = (b.min - a.min).cwiseAbs().maxCoeff();
    constexpr int most = 900;  // the scale and all local coordinates stay normal numbers
    scale_ = 1;
    if (extent > 0) scale_ = std::ldexp(1.0, -std::clamp(std::ilogb(extent), -most, most));
  }

  /// A frame along the axes of a long leaf, which is turned. There the boxes of its faces are tight.
  FilterFrame(const Box& a, const Box& b, const Eigen::Matrix3d& axes) : FilterFrame(a, b) {
    axes_ = axes;
    is_turned_ = true;
  }

  [[nodiscard]] bool is_turned() const { return is_turned_; }
  /// Whether it lies along a long leaf, or along the axes of space where that is null. Its boxes of the leaf
  /// may be about twice as wide as those along the leaf's own axes.
  [[nodiscard]] bool lies_along(const OrientedBox* leaf) const {
    if (leaf == nullptr || !is_turned_) return leaf == nullptr && !is_turned_;
    const double width = leaf->half.tail<2>().maxCoeff();
    const double sine = axes_.row(0).cross(leaf->axes.row(0)).norm();
    constexpr double little_roll = 0.98;
    return sine * leaf->half.x() <= width && std::abs(axes_.row(2).dot(leaf->axes.row(2))) >= little_roll;
  }
  /// Whether it does for other leaves: their own frame is not much larger or smaller, nor so far away that
  /// float would see too little of them.
  [[nodiscard]] bool serves(const Box& a, const Box& b) const {
    const FilterFrame own(a, b);
    const double ratio = scale_ / own.scale_;
    return ratio >= 0x1p-9 && ratio <= 0x1p9 &&
           (own.origin_ - origin_).cwiseAbs().maxCoeff() * own.scale_ <= 0x1p9;
  }
  friend bool operator==(const FilterFrame& left, const FilterFrame& right) {
    return left.origin_ == right.origin_ && left.scale_ == right.scale_ &&
           left.is_turned_ == right.is_turned_ && (!left.is_turned_ || left.axes_ == right.axes_);
  }

  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d local = (point - origin_) * scale_;
    return is_turned_ ? Eigen::Vector3d(axes_ * local) : local;
  }
  // The next four are of a frame that is not turned.

  /// The frame as the passes over many points take it.
  [[nodiscard]] kernels::PointFrame for_points() const {
    return {{origin_.x(), origin_.y(), origin_.z(), 0}, scale_};
  }
  /// A box as the kernels see it, no smaller for rounding. A box far larger than they can see becomes one
  /// within `largest_size`, where all features are that they trust.
  [[nodiscard]] kernels::BoxInFrame to_local(const Box& box) const {
    return rounded(to_local(box.min), to_local(box.max));
  }
  /// The largest size of a feature in a box that the kernels trust.
  [[nodiscard]] float size_of(const Box& box) const {
    return static_cast<float>(clamped_size(to_local(box.min), to_local(box.max)));
  }
  /// The part of a box that can be within a distance of another box. It may be empty.
  [[nodiscard]] kernels::BoxInFrame to_local_beside(const Box& box, const Box& other, double distance) const {
    const Eigen::Array3d reach = Eigen::Array3d::Constant(distance * scale_);
    return rounded(to_local(box.min).array().max(to_local(other.min).array() - reach),
                   to_local(box.max).array().min(to_local(other.max).array() + reach));
  }

  /// The slab of a leaf with this middle vertex. In a turned frame boxes serve as well, so it has none.
  [[nodiscard]] kernels::SlabInFrame to_local(const LeafSlab& slab, const Eigen::Vector3d& middle) const {
    if (!slab.is_known() || is_turned_) return {{0, 0, 0}, 0, 0};
    const Eigen::Vector3d local = to_local(middle);
    const double along = slab.normal.cast<double>().dot(local);
    const double rounding = (local.cwiseAbs().sum() + static_cast<double>(slab.radius) * scale_) * 0x1p-22;
    const auto height = [&](float of_slab, double slack) {
      return static_cast<float>(
          std::clamp(along + static_cast<double>(of_slab) * scale_ + slack, -0x1p100, 0x1p100));
    };
    return {{slab.normal.x(), slab.normal.y(), slab.normal.z()},
            height(slab.low, -rounding),
            height(slab.high, rounding)};
  }
  /// Local units for one of the scene.
  [[nodiscard]] double scale() const { return scale_; }
  /// A distance in local units, rounded up.
  [[nodiscard]] float to_local_limit(double distance) const {
    const double scaled = distance * scale_;
    if (!(scaled < 0x1p100)) return std::numeric_limits<float>::infinity();
    const auto rounded = static_cast<float>(scaled);
    return static_cast<double>(rounded) < scaled
               ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
               : rounded;
  }
  /// Converts a distance to the frame, rounded down.
  [[nodiscard]] float to_local_below(double distance) const {
    return static_cast<float>(std::min(distance * scale_, 0x1p100) * (1 - 0x1p-23));
  }

 private:
  static Eigen::Vector3d clamped(const Eigen::Vector3d& local) {
    constexpr double largest = kernels::largest_size;
    return local.cwiseMax(-largest).cwiseMin(largest);
  }
  static double clamped_size(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return std::max({clamped(low).cwiseAbs().maxCoeff(), clamped(high).cwiseAbs().maxCoeff(),
                     double{kernels::least_size}});
  }
  static kernels::BoxInFrame rounded(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    const Eigen::Vector3d grown =
        Eigen::Vector3d::Constant(clamped_size(low, high) * double{kernels::margin});
    const Eigen::Vector3f min = (clamped(low) - grown).cast<float>();
    const Eigen::Vector3f max = (clamped(high) + grown).cast<float>();
    return {{min.x(), min.y(), min.z()}, {max.x(), max.y(), max.z()}};
  }

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double scale_ = 0;                                ///< 0 for the frame of nothing
  Eigen::Matrix3d axes_ = Eigen::Matrix3d::Zero();  ///< in rows, where the frame is turned
  bool is_turned_ = false;
};

/// Holds nothing, and is extended by what it is to hold.
inline kernels::BoxInFrame empty_box() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}
/// A box grown by a distance along each axis.
inline kernels::BoxInFrame grown(const kernels::BoxInFrame& box, float by) {
  kernels::BoxInFrame grown{};
  for (int axis = 0; axis < 3; ++axis) {
    grown.min[axis] = box.min[axis] - by;
    grown.max[axis] = box.max[axis] + by;
  }
  return grown;
}
inline bool is_empty(const kernels::BoxInFrame& box) {
  return box.min[0] > box.max[0] || box.min[1] > box.max[1] || box.min[2] > box.max[2];
}

}  // namespace graze
