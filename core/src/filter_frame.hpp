#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <graze/box.hpp>
#include <limits>

namespace graze {

/// The coordinates that the float kernels see for two leaves: about a corner of the smaller one and scaled by
/// a power of two to its size, so that neither where a scene is nor how large it is makes a difference.
class FilterFrame {
 public:
  FilterFrame(const Box& a, const Box& b) {
    const Eigen::Vector3d extent_a = a.max - a.min;
    const Eigen::Vector3d extent_b = b.max - b.min;
    const bool a_is_smaller = extent_a.maxCoeff() <= extent_b.maxCoeff();
    origin_ = a_is_smaller ? a.min : b.min;
    double extent = a_is_smaller ? extent_a.maxCoeff() : extent_b.maxCoeff();
    if (extent == 0) extent = std::max(extent_a.maxCoeff(), extent_b.maxCoeff());
    if (extent == 0) extent = (b.min - a.min).cwiseAbs().maxCoeff();
    constexpr int most = 900;  // the scale and all local coordinates stay normal numbers
    if (extent > 0) scale_ = std::ldexp(1.0, -std::clamp(std::ilogb(extent), -most, most));
  }

  [[nodiscard]] Eigen::Vector3d to_local(const Eigen::Vector3d& point) const {
    return (point - origin_) * scale_;
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

 private:
  Eigen::Vector3d origin_;
  double scale_ = 1;
};

}  // namespace graze
