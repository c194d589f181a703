#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <graze/number_text.hpp>
#include <optional>
#include <string>

namespace graze {

/// What keeps the rows (r0, r1, r2, t) from being a pose: not finite, or further than 1e-9 from a rotation.
/// Nothing for a good one.
inline std::optional<std::string> problem_of_pose(const std::array<double, 12>& rows) {
  constexpr double furthest = 1e-9;
  Eigen::Matrix3d rotation;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      rotation(row, column) = rows[static_cast<std::size_t>(row * 4 + column)];
  if (!rotation.allFinite() || !Eigen::Vector3d(rows[3], rows[7], rows[11]).allFinite())
    return "the pose is not finite";
  // For a matrix at a small distance d from a rotation, |RᵀR − 1| is 2d to first order (Frobenius norms).
  const double off = (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).norm() / 2;
  if (!(off <= furthest)) return "the pose is " + number_text(off) + " from a rotation";
  if (rotation.determinant() < 0) return "the pose is a reflection";
  return std::nullopt;
}

/// What keeps a 4x4 matrix from being a pose: also a last row that is not (0, 0, 0, 1). The rounding of an
/// inverse in float is let pass.
inline std::optional<std::string> problem_of_pose(const std::array<double, 12>& rows,
                                                  const std::array<double, 4>& last_row) {
  constexpr double furthest = 1e-6;
  constexpr std::array<double, 4> wanted{0, 0, 0, 1};
  for (std::size_t column = 0; column < 4; ++column)
    if (!(std::abs(last_row[column] - wanted[column]) <= furthest))
      return "the last row of the pose is (" + number_text(last_row[0]) + ", " + number_text(last_row[1]) +
             ", " + number_text(last_row[2]) + ", " + number_text(last_row[3]) +
             "), not (0, 0, 0, 1); the translation belongs into the last column";
  return problem_of_pose(rows);
}

}  // namespace graze
