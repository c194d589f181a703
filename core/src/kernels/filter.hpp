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

/// The components of a block: the corners of a feature, its `size`, and its box, grown by `margin * size`.
/// The size is the largest magnitude of its coordinates, at least `least_size`. It is infinite where the
/// coordinates are not to be trusted. Then all coordinates are 0, the box is everything, and the feature
/// survives every test.
template <std::size_t Corners>
inline constexpr std::size_t size_at = 3 * Corners;
template <std::size_t Corners>
inline constexpr std::size_t box_at = size_at<Corners> + 1;
inline constexpr std::size_t box_components = 6;
template <std::size_t Corners>
inline constexpr std::size_t component_count = box_at<Corners> + box_components;

/// How far a lower bound may be above the truth, relative to the sum of the two features' sizes: 24 units of
/// 2^-24, of which the analysis needs 17.
inline constexpr float margin = 0x1.8p-20F;
/// Below it underflow could count.
inline constexpr float least_size = 0x1p-20F;
/// Above it products could overflow.
inline constexpr float largest_size = 0x1p20F;
/// A separating axis shorter than this says nothing.
inline constexpr float least_axis = 0x1p-30F;
/// How far the difference of two corners may be from the truth, relative to the sum of their features' sizes:
/// 7 units of 2^-24.
inline constexpr float error_of_difference = 0x1.cp-22F;

/// A vertex in a frame.
struct Point {
  float position[3];
  float size;
};

/// Numbers into a block of points, ascending, and a lower bound of each one's distance, which minus infinity
/// stands for where a size is not to be trusted. Room for a whole block each.
struct Survivors {
  std::uint32_t* index = nullptr;
  float* bound = nullptr;
};

/// A box by itself, no smaller for rounding than what it is the box of.
struct BoxInFrame {
  float min[3], max[3];
};

/// A slab between two planes. `low` and `high` are at most and at least the products of points with the
/// normal. The normal's length is at most 1, so that the products are no further apart than the points.
/// Without a normal the slab holds everything.
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

/// The output of `clip_…`: ascending indices into the block, of features that may touch and of the others.
/// Each list has room for a whole block and `lanes` more. `box`, if not null, is extended by the features
/// kept.
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

/// Two numbers for each pair, with room for as many pairs as were tested and `lanes` more.
struct NearPairs {
  std::uint32_t* row;
  std::uint32_t* column;
};

/// Some features of a block that boxes are compared with, one after the other.
struct RowsOfBoxes {
  const Block& features;
  std::size_t box;  ///< the component where their boxes begin
  const std::uint32_t* index;
  std::size_t count;
};

/// Limits of a kernel's question. Pairs certainly further than `limit` are discarded. For pairs certainly
/// closer than `below` it finds the Voronoi regions. If `below` is not above 0, it finds them for none.
struct NearLimits {
  float limit;
  float below = 0;
};

/// Pairs of features by their corners.
template <std::size_t CornersA, std::size_t CornersB>
struct FeaturePairs {
  Point a[lanes][CornersA];
  Point b[lanes][CornersB];
  // Filled in by the kernel.
  float bound[lanes];  ///< of the distance, from below, minus infinity where a size is not to be trusted
  std::int32_t voronoi[lanes];  ///< where the closest points certainly are, or `unsure_voronoi`
  /// The distance from above, of a point and a triangle where the Voronoi region is known.
  float upper[lanes];
};
/// A number of `VoronoiRegion`, or for two segments four times one of `Along` plus another. Or it is this.
inline constexpr std::int32_t unsure_voronoi = -1;
/// The number for a segment that passes through its triangle.
inline constexpr std::int32_t passes_through = 0;
using SegmentPairs = FeaturePairs<2, 2>;
using PointTrianglePairs = FeaturePairs<1, 3>;
using SegmentTrianglePairs = FeaturePairs<2, 3>;

/// The kernels of one instruction set. `lay_out_…` fills blocks from vertices. `corners` has the index of
/// each feature's corners among the vertices, one feature after the other. The corners are also listed as
/// they are. It reads corners and writes features up to a multiple of 4, of which those behind `count` may be
/// any. `clip_…` returns how many are left.
struct Filter {
  using LayOut = void (*)(const Point* vertices, const std::uint32_t* corners, std::size_t count, float* data,
                          std::size_t stride, Point* points);
  LayOut lay_out_points;
  LayOut lay_out_segments;
  LayOut lay_out_triangles;
  using Clip = ClipCount (*)(const Block& features, const ClipBy& by, const Clipped& out);
  Clip clip_points;
  Clip clip_segments;
  Clip clip_triangles;
  /// Copies components of the features of a block that are listed. The list goes on up to a multiple of 4,
  /// with anything of the block.
  void (*gather)(const Block& from, std::size_t components, const std::uint32_t* index, std::size_t count,
                 float* to, std::size_t to_stride);
  /// Lists the pairs of a row and a box, whose six components are `boxes`, that are not certainly further
  /// than `limit` from each other, row after row. Returns how many.
  std::size_t (*near_boxes)(const RowsOfBoxes& rows, const Block& boxes, float limit, const NearPairs& out);
  /// The points that are not certainly further than `limit`. Returns how many.
  std::size_t (*near_points)(const Point& point, const Block& points, float limit, const Survivors& out);
  /// Bounds all pairs, and gives one bit for each that is not certainly further than the limit. Voronoi
  /// regions are those of pairs with a bit. They mean nothing for lanes that hold no pair.
  std::uint32_t (*bound_segments)(SegmentPairs& pairs, const NearLimits& limits);
  std::uint32_t (*bound_points_and_triangles)(PointTrianglePairs& pairs, const NearLimits& limits);
  /// Bounds how far segments are to one side of their triangles' planes, and gives one bit for each that is
  /// not certainly further than the limit.
  std::uint32_t (*bound_over_planes)(SegmentTrianglePairs& pairs, float limit);
  /// Gives one bit for each segment that does not certainly pass by its triangle. The bound is 0 or less. The
  /// Voronoi number is `passes_through` where the segment certainly goes through the triangle's inside from
  /// one side to the other.
  std::uint32_t (*passing)(SegmentTrianglePairs& pairs);
  /// Lists the boxes, six rows of them, that meet another one, of those in `group_count` groups of sixteen:
  /// the listed ones, or the first ones where `groups` is null. Room for all of them and `lanes` more.
  std::size_t (*meeting)(const Block& boxes, const std::uint32_t* groups, std::size_t group_count,
                         const BoxInFrame& with, std::uint32_t* found);
};

/// The kernels in use, chosen once, see graze/instruction_set.hpp.
const Filter& filter();

}  // namespace graze::kernels
