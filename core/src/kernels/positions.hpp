#pragma once

#include <cstddef>
#include <cstdint>

#include "filter.hpp"

/// Passes over the positions of a surface, in memory order or as listed. Compiled once for each instruction
/// set, so this header has no inline function that another translation unit might share with them.
namespace graze::kernels {

/// What a pass over positions found; x, y and z.
template <typename Number>
struct PositionsSeen {
  Number min[3], max[3];
  Number furthest[3];  ///< the largest magnitudes of now - before, each rounded once
  bool changed;        ///< some bit is another than before
  bool bad;            ///< some coordinate is beyond the limit or NaN; then the rest means nothing
};

/// Points of three numbers each, and the number of the last: behind that nothing may be read.
template <typename Number>
struct PointArray {
  const Number* numbers;
  std::uint32_t last;
};

/// Where `(p - origin) * scale` is what kernels see of p, in double and then rounded; the fourth is nothing.
struct PointFrame {
  double origin[4];
  double scale;
};

/// Rows of x, of y and of z, with room for a multiple of four.
struct PointRows {
  float* x;
  std::size_t stride;
};

/// Passes over points of three floats or doubles each, of which there is one at least.
template <typename Number>
struct PassesOf {
  /// Compares points with where they were.
  void (*compare)(const Number* now, const Number* before, std::size_t count, Number limit,
                  PositionsSeen<Number>& seen);
  /// The same of the points alone, of which nothing has moved.
  void (*survey)(const Number* now, std::size_t count, Number limit, PositionsSeen<Number>& seen);
  /// The largest square of a point's motion: differences, squares and sums rounded in double.
  double (*furthest)(const Number* now, const Number* before, std::size_t count);
  /// Numbers of the points from `begin` to `end` that no coordinate leads out of a box, ascending; how many.
  /// Room for all of them and `lanes` more.
  std::size_t (*inside)(const Number* points, std::uint32_t begin, std::uint32_t end, const Number* low,
                        const Number* high, std::uint32_t* index);
  /// The box of the points from `begin` to `end`; x, y and z.
  void (*extent)(const Number* points, std::uint32_t begin, std::uint32_t end, Number* low, Number* high);
  /// Listed points in a frame, as `lay_out_…` of Filter reads them.
  void (*bring)(const PointArray<Number>& points, const std::uint32_t* listed, std::size_t count,
                const PointFrame& frame, Point* brought);
  /// The same in rows and without sizes; of one at least. And the box of the points, each of four numbers.
  void (*bring_in_rows)(const PointArray<Number>& points, const std::uint32_t* listed, std::size_t count,
                        const PointFrame& frame, const PointRows& rows, Number* low, Number* high);
  /// Those listed points that no coordinate leads out of a box, of four numbers each; how many. Room for all.
  std::size_t (*listed_inside)(const PointArray<Number>& points, const std::uint32_t* listed,
                               std::size_t count, const Number* low, const Number* high,
                               std::uint32_t* inside);
};

/// The passes of one instruction set.
struct PositionPasses {
  PassesOf<float> floats;
  PassesOf<double> doubles;
};

/// The passes in use, of the set that `filter()` is of.
const PositionPasses& position_passes();

}  // namespace graze::kernels
