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

/// The passes of one instruction set, over points of three numbers each, of which there is one at least.
struct PositionPasses {
  void (*floats)(const float* now, const float* before, std::size_t count, float limit,
                 PositionsSeen<float>& seen);
  void (*doubles)(const double* now, const double* before, std::size_t count, double limit,
                  PositionsSeen<double>& seen);
  /// The largest square of a point's motion: differences, squares and sums rounded in double.
  double (*furthest_of_floats)(const float* now, const float* before, std::size_t count);
  double (*furthest_of_doubles)(const double* now, const double* before, std::size_t count);
  /// Numbers of the points from `begin` to `end` that no coordinate leads out of a box, ascending; how many.
  /// Room for all of them.
  std::size_t (*floats_inside)(const float* points, std::uint32_t begin, std::uint32_t end, const float* low,
                               const float* high, std::uint32_t* index);
  std::size_t (*doubles_inside)(const double* points, std::uint32_t begin, std::uint32_t end,
                                const double* low, const double* high, std::uint32_t* index);
  /// The box of the points from `begin` to `end`; x, y and z.
  void (*extent_of_floats)(const float* points, std::uint32_t begin, std::uint32_t end, float* low,
                           float* high);
  void (*extent_of_doubles)(const double* points, std::uint32_t begin, std::uint32_t end, double* low,
                            double* high);
};

/// The passes in use, of the set that `filter()` is of.
const PositionPasses& position_passes();

}  // namespace graze::kernels
