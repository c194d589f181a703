#pragma once

#include <cstddef>
#include <cstdint>

#include "kernels/filter.hpp"
#include "kernels/points.hpp"

/// Passes over the positions of a surface, in memory order or as listed. Compiled once for each instruction
/// set, so this header has no inline function that another translation unit might share with them.
namespace graze::kernels {

/// The result of a pass over positions, in x, y and z.
template <typename Number>
struct PositionsSeen {
  Number min[3], max[3];
  Number furthest[3];  ///< the largest magnitudes of now - before, each rounded once
  bool changed;        ///< some bit is another than before
  bool bad;            ///< some coordinate is beyond the limit or NaN. Then the rest means nothing
};

/// A frame of points: kernels see p as `(p - origin) * scale`, computed in double and then rounded. The
/// fourth number is unused.
struct PointFrame {
  double origin[4];
  double scale;
};

/// Points of a block.
inline constexpr std::size_t block_size = 8;
/// Points of a stretch.
inline constexpr std::size_t stretch_size = 64;

/// Passes over points of three floats or doubles each, of which there is one at least.
template <typename Number>
struct PassesOf {
  /// Compares points with where they were.
  void (*compare)(const Number* now, const Number* before, std::size_t count, Number limit,
                  PositionsSeen<Number>& seen);
  /// As `compare`, for the points alone: it takes them as not moved.
  void (*survey)(const Number* now, std::size_t count, Number limit, PositionsSeen<Number>& seen);
  /// The largest square of a point's motion: differences, squares and sums rounded in double.
  double (*furthest)(const Number* now, const Number* before, std::size_t count);
  /// Listed points in a frame, as `lay_out_…` of Filter reads them.
  void (*to_frame)(const PointArray<Number>& points, const std::uint32_t* listed, std::size_t count,
                   const PointFrame& frame, Point* converted);
  /// The boxes of listed points, one for each eight of them, about `origin`: differences of coordinates,
  /// rounded to Number and then to float, in six rows.
  void (*box_blocks)(const PointArray<Number>& points, const std::uint32_t* listed, std::size_t count,
                     const Number* origin, float* boxes, std::size_t stride);
  /// As `box_blocks`, of points as they lie in memory, one box for each stretch of them.
  void (*box_stretches)(const Number* points, std::size_t count, const Number* origin, float* boxes,
                        std::size_t stride);
  /// Up to eight listed points as a block: eight x, eight y, eight z. Missing points are not-a-number.
  void (*lay_out_block)(const PointArray<Number>& points, const std::uint32_t* listed, std::size_t count,
                        Number* block);
  /// Compares the first `count` points of one block with those of all listed blocks. Lists the pairs whose
  /// squared distance, each operation rounded, is at most `reach_squared`, point after point. A pair is the
  /// point's number, and eight times the index in the list plus the number there. Returns how many there are.
  std::size_t (*near_points)(const Number* block, std::size_t count, const Number* blocks,
                             const std::uint32_t* listed, std::size_t listed_count, Number reach_squared,
                             const NearPairs& out);
  /// The least of the squared distances that `near_points` compares. It is infinite where there are none.
  Number (*least_squared)(const Number* block, std::size_t count, const Number* blocks,
                          const std::uint32_t* listed, std::size_t listed_count);
};

/// The passes of one instruction set.
struct PositionPasses {
  PassesOf<float> floats;
  PassesOf<double> doubles;
};

/// The passes in use, of the set that `filter()` is of.
const PositionPasses& position_passes();

}  // namespace graze::kernels
