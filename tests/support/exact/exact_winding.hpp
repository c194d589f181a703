#pragma once

#include <array>
#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::oracle {

/// Says where points lie with regard to one closed surface, by rays in random directions. It throws a
/// direction away for another one if the ray runs in the plane of a triangle or meets an edge. All arithmetic
/// is that of integers: of 64 bits where the coordinates are small multiples of one power of two, otherwise
/// of any length.
class WindingOracle {
 public:
  /// In a closed surface each edge is passed as often in one direction as in the other.
  explicit WindingOracle(const Shape& closed);

  [[nodiscard]] Winding about(const Eigen::Vector3d& point) const;
  /// Does the same, always with integers of any length.
  [[nodiscard]] Winding about_in_any_length(const Eigen::Vector3d& point) const;

 private:
  using Corners = std::array<Eigen::Vector3d, 3>;

  [[nodiscard]] bool is_outside_box(const Eigen::Vector3d& point) const;

  std::vector<Corners> triangles_;
  Eigen::Vector3d low_, high_;
  int unit_ = 0;  ///< all coordinates are multiples of two to this power
};

}  // namespace graze::oracle
