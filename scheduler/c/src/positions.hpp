#pragma once

#include <graze/graze.h>

#include <Eigen/Geometry>
#include <graze/position_view.hpp>

#include "calls.hpp"

namespace graze::c {

/// Returns the view of positions that a caller describes.
[[nodiscard]] inline PositionView view_of(const graze_positions& positions) {
  const std::size_t number = positions.is_double ? sizeof(double) : sizeof(float);
  const std::size_t apart =
      positions.coordinate_stride_bytes == 0 ? number : positions.coordinate_stride_bytes;
  const std::size_t stride = positions.stride_bytes == 0 ? 3 * number : positions.stride_bytes;
  if (positions.is_double)
    return {static_cast<const double*>(positions.first), positions.count, stride, apart};
  return {static_cast<const float*>(positions.first), positions.count, stride, apart};
}

[[nodiscard]] inline PositionView view_of(const graze_positions* positions, const char* name) {
  return view_of(given(positions, name));
}

/// Describes a view to a caller. An empty view without memory has no strides.
[[nodiscard]] inline graze_positions described(const PositionView& view) {
  return {view.data(), view.size(), view.stride_bytes(), view.coordinate_stride_bytes(), view.is_double()};
}

/// Returns the pose of a caller's rows.
[[nodiscard]] inline Eigen::Isometry3d pose_of(const double* rows) {
  const auto from = numbers<12>(rows, "rows");
  Eigen::Isometry3d pose;
  pose.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(from.data());
  pose.makeAffine();
  return pose;
}

}  // namespace graze::c
