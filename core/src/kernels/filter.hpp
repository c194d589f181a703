#pragma once

#include <cstddef>
#include <cstdint>

/// Float kernels that say which pairs of features are certainly far apart. They are compiled once for each
/// instruction set, so this header has no inline function that another translation unit might share with
/// them. docs/numerics.md derives the margin.
namespace graze::kernels {

/// Features as a structure of arrays: component k of feature i is data[k * stride + i]. The stride is a
/// multiple of `lanes`, and the values between count and stride may be anything.
struct Block {
  const float* data = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
};
inline constexpr std::size_t lanes = 16;

/// Components of a block. A feature's `size` is the largest magnitude of its coordinates, at least
/// `least_size`; infinite where they are not to be trusted, and then the feature survives everything. Those
/// below `laid_out` are filled in by `lay_out_…`, the others by `prepare_…`.
namespace point {
inline constexpr std::size_t position = 0, size = 3, laid_out = 4, count = 4;
}
namespace segment {
inline constexpr std::size_t p = 0, q = 3, size = 6, laid_out = 7;
inline constexpr std::size_t inverse_length_squared = 7, count = 8;
}  // namespace segment
namespace triangle {
inline constexpr std::size_t corner0 = 0, corner1 = 3, corner2 = 6, size = 9;
inline constexpr std::size_t box_min = 10, box_max = 13, laid_out = 16, normal = 16;
inline constexpr std::size_t uu = 19, uv = 20, vv = 21;  // products of the sides u = 0-1 and v = 0-2
inline constexpr std::size_t inverse_uu = 22, inverse_vv = 23, inverse_ww = 24, count = 25;  // w = 1-2
}  // namespace triangle

/// How far a lower bound may be above the truth, relative to the sum of the two features' sizes: 24 units of
/// 2^-24, of which the analysis needs 17.
inline constexpr float margin = 0x1.8p-20F;
/// Below it underflow could count.
inline constexpr float least_size = 0x1p-20F;
/// Above it products could overflow.
inline constexpr float largest_size = 0x1p20F;
/// A separating axis shorter than this says nothing.
inline constexpr float least_axis_squared = 0x1p-60F;

/// One feature of a block by itself: its components up to and with its size. Of a point with an infinite
/// size the position is 0.
struct Point {
  float position[3];
  float size;
};
struct Segment {
  float p[3], q[3];
  float size;
};

/// What is left: numbers into the block, ascending, and a lower bound of each one's distance, which minus
/// infinity stands for where a size is not to be trusted. Room for a whole block each.
struct Survivors {
  std::uint32_t* index = nullptr;
  float* bound = nullptr;
};

/// A box by itself; `size` as of a feature.
struct BoxInFrame {
  float min[3], max[3];
  float size;
};

/// What is between two planes: `low` and `high` are at most and at least the products of points with the
/// normal, whose length is at most 1, so that these are no further apart than the points. All is between
/// planes without a normal.
struct SlabInFrame {
  float normal[3];
  float low, high;
};

/// Which features `clip_…` keep: those not certainly further than `limit` from `box` and from `slab`. Of
/// these it says which may touch something in `touched`.
struct ClipBy {
  BoxInFrame box;
  BoxInFrame touched;
  SlabInFrame slab;
  float limit;
};

/// What is kept: numbers into the block, ascending, of those that may touch and of the others, with room for
/// a whole block each; or both null. And the box of all of them, which is extended; or null.
struct Clipped {
  std::uint32_t* touching = nullptr;
  std::uint32_t* others = nullptr;
  BoxInFrame* box = nullptr;
};
/// How many were listed.
struct ClipCount {
  std::size_t touching = 0;
  std::size_t others = 0;
};

/// Two points' numbers each, with room for as many as were looked at.
struct NearPairs {
  std::uint32_t* row;
  std::uint32_t* point;
};

/// The kernels of one instruction set. `lay_out_…` fills blocks from vertices and the places of each
/// feature's corners among them, one feature after the other; it reads corners and writes features up to a
/// multiple of 4, of which those behind `count` may be any. `prepare_…` computes the rest. `near_…` discards
/// what is certainly further than `limit`, `maybe_pierced` the triangles that the segment certainly does not
/// touch; both, and `clip_…`, return how many are left. `gather` copies the features of a block that are
/// listed; the list goes on up to a multiple of 4, with anything of the block.
struct Filter {
  using LayOut = void (*)(const Point* vertices, const std::uint32_t* corners, std::size_t count, float* data,
                          std::size_t stride);
  LayOut lay_out_points;
  LayOut lay_out_segments;
  LayOut lay_out_triangles;
  void (*prepare_segments)(float* data, std::size_t stride, std::size_t count);
  void (*prepare_triangles)(float* data, std::size_t stride, std::size_t count);
  std::size_t (*near_points)(const Point& point, const Block& points, float limit, const Survivors& out);
  std::size_t (*near_segments)(const Segment& segment, const Block& segments, float limit,
                               const Survivors& out);
  std::size_t (*near_triangles)(const Point& point, const Block& triangles, float limit,
                                const Survivors& out);
  std::size_t (*maybe_pierced)(const Segment& segment, const Block& triangles, const Survivors& out);
  using Clip = ClipCount (*)(const Block& features, const ClipBy& by, const Clipped& out);
  Clip clip_points;
  Clip clip_segments;
  Clip clip_triangles;
  void (*gather)(const Block& from, std::size_t components, const std::uint32_t* index, std::size_t count,
                 float* to, std::size_t to_stride);
  /// Compares every row from `first` to `last` with the points from `begin[row]` to `end[row]`, and lists
  /// those whose squared distance is below `reach_squared`, row after row; how many. Behind the points
  /// `lanes` more may be read.
  std::size_t (*near_rows)(const Block& rows, std::size_t first, std::size_t last, const Block& points,
                           const std::uint32_t* begin, const std::uint32_t* end, float reach_squared,
                           const NearPairs& out);
};

/// The kernels in use, chosen once; see graze/instruction_set.hpp.
const Filter& filter();

}  // namespace graze::kernels
