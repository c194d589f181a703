#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::oracle {

/// The contour in which the triangles of two shapes cross: of all of them, by exact arithmetic.
struct Contour {
  /// The segments with b moved by a tiny vector, and with b moved by its opposite. They are directed along
  /// n_a × n_b.
  std::vector<std::array<Eigen::Vector3d, 2>> up, down;
  Eigen::Vector3d area = Eigen::Vector3d::Zero();  ///< half of ½ Σ (p − middle) × (q − middle) over both
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of all segments, weighted by their lengths
  double fullness = 0;
  double length = 0;  ///< of all segments
  double spread = 0;  ///< half of ½ Σ |(p − middle) × (q − middle)|: next to nothing for a line

  [[nodiscard]] bool is_empty() const { return up.empty() && down.empty(); }
  /// How far the contour and other points reach along a direction.
  [[nodiscard]] double extent_along(const Eigen::Vector3d& direction,
                                    const std::vector<Eigen::Vector3d>& others) const;
};

/// No value where an edge of one shape meets an edge or a vertex of the other even when b is moved.
std::optional<Contour> contour(const Shape& a, const Shape& b, const FacePairs& pairs = {});

}  // namespace graze::oracle
