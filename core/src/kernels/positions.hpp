#pragma once

#include <cstddef>
#include <cstdint>

/// Passes over all positions of a surface, in memory order. Compiled once for each instruction set, so this
/// header has no inline function that another translation unit might share with them.
namespace graze::kernels {

/// What a pass over positions found; x, y and z.
template <typename Number>
struct PositionsSeen {
  Number min[3], max[3];
  Number furthest[3];  ///< the largest magnitudes of now - before, each rounded once
  bool changed;        ///< some bit is another than before
  bool bad;            ///< some coordinate is beyond the limit or NaN; then the rest means nothing
};

/// The passes of one instruction set, over `count` > 0 points of three numbers each.
struct PositionPasses {
  void (*floats)(const float* now, const float* before, std::size_t count, float limit,
                 PositionsSeen<float>& seen);
  void (*doubles)(const double* now, const double* before, std::size_t count, double limit,
                  PositionsSeen<double>& seen);
  /// Numbers of the points that no coordinate leads out of a box, ascending; how many. Room for `count`.
  std::size_t (*floats_inside)(const float* points, std::size_t count, const float* low, const float* high,
                               std::uint32_t* index);
  std::size_t (*doubles_inside)(const double* points, std::size_t count, const double* low,
                                const double* high, std::uint32_t* index);
};

/// The passes in use, of the set that `filter()` is of.
const PositionPasses& position_passes();

}  // namespace graze::kernels
