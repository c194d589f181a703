#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

#include "core/base/number_text.hpp"

namespace graze {

/// The upper three rows, row by row, of a 4x4 matrix column by column.
inline std::array<double, 12> rows_of(std::span<const double, 16> matrix) {
  std::array<double, 12> rows;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) rows[row * 4 + column] = matrix[column * 4 + row];
  return rows;
}
inline std::array<double, 12> rows_of(const Eigen::Isometry3d& pose) {
  return rows_of(std::span<const double, 16>(pose.data(), 16));
}

/// Says why the rows (r0, r1, r2, t) are not a pose, or nothing for a pose. A pose is finite and its matrix R
/// is within 1e-3 of a rotation: no entry of RᵀR − 1 is larger, and R is no reflection. So the float
/// rotations of an engine are accepted.
inline std::optional<std::string> problem_of_pose(const std::array<double, 12>& rows) {
  constexpr double furthest = 1e-3;
  Eigen::Matrix3d matrix;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      matrix(row, column) = rows[static_cast<std::size_t>(row * 4 + column)];
  if (!matrix.allFinite() || !Eigen::Vector3d(rows[3], rows[7], rows[11]).allFinite())
    return "its matrix is not finite";
  const double off = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= furthest))
    return "its matrix is no rotation: an entry of RᵀR - 1 is " + number_text(off, 4) + ", more than 1e-3";
  if (matrix.determinant() < 0) return "its matrix is a reflection";
  return std::nullopt;
}

/// Says why a 4x4 matrix is not a pose, or nothing for a pose. Its last row may differ from (0, 0, 0, 1) by
/// up to 1e-6 in each number, since the inverse of a float matrix is rounded.
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
