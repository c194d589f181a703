#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "arithmetic/arithmetic.hpp"

namespace graze {

/// Which way a segment crosses a triangle, by the triangle's winding.
enum class CrossingWay : std::uint8_t {
  none,      ///< it does not cross it
  to_front,  ///< from back to front
  to_back,
};

/// Which of the two is moved by an infinitesimal vector, in the direction (1, δ, δ²) for an infinitesimal δ,
/// or in the opposite direction.
enum class Nudge : std::uint8_t { triangle_up, triangle_down };

/// Which way a segment crosses a triangle. Where the segment ends in the triangle's plane, or passes through
/// its border, the answer is that for the nudged triangle. So two triangles that share an edge are never both
/// crossed, and never both missed, by a segment that passes through the edge. Decided exactly.
CrossingWay crossing_way(const std::array<Eigen::Vector3d, 2>& segment,
                         const std::array<Eigen::Vector3d, 3>& triangle, Nudge nudge, DecisionCount& count);

/// The crossings that double is certain of, however the two are moved against each other within a distance.
enum class LastingCrossing : std::uint8_t { none, to_front, to_back, unsure };

/// Which way a segment crosses a triangle if it does so wherever the two are moved against each other by at
/// most `distance`. It is `unsure` too where such a motion changes the place of the crossing by more than a
/// millionth of the segment.
LastingCrossing lasting_crossing(const std::array<Eigen::Vector3d, 2>& segment,
                                 const std::array<Eigen::Vector3d, 3>& triangle, double distance);

}  // namespace graze
