// The float kernels discard only: every lower bound they give is compared with the distance in long double,
// and every instruction set with plain code.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <graze/error.hpp>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <string>

#include "feature_block.hpp"
#include "filter_frame.hpp"
#include "leaf_slab.hpp"
#include "leaf_vertices.hpp"
#include "support/catch.hpp"
#include "support/exact.hpp"
#include "support/random_scenes.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr double unit = 0x1p-24;  // the rounding of a float

/// What a batch of features looks like.
enum class Family {
  plain,
  grid,
  needles,
  flat,
  tiny_and_large,
  far,
  minute,
  huge,
  degenerate,
  interlocked,
  count
};

template <std::size_t Corners>
using Corner = std::array<Vector3d, Corners>;

/// The features of two leaves.
struct Batch {
  std::vector<Corner<1>> points;
  std::vector<Corner<2>> segments;
  std::vector<Corner<3>> triangles;
  Box box;
};

/// About three corners, a tenth of a side thick to either side of the first.
LeafSlab slab_of(const Corner<3>& corner) {
  const Vector3d u = corner[1] - corner[0];
  const Vector3d across = u.stableNormalized().cross((corner[2] - corner[0]).stableNormalized());
  LeafSlab slab;
  if (across.norm() < 0x1p-20) return slab;
  slab.normal = (across.normalized() * (1 - 0x1p-22)).cast<float>();
  slab.radius = static_cast<float>(4 * u.stableNorm());
  slab.high = static_cast<float>(u.stableNorm() / 10);
  slab.low = -slab.high;
  return slab;
}

class Generator {
 public:
  Generator(Family family, std::uint64_t seed) : family_(family), random_(seed) {
    if (family == Family::far) origin_ = {0x1p40, -0x1p39, 0x1p38};
    if (family == Family::minute) scale_ = 0x1p-400;
    if (family == Family::huge) scale_ = 0x1p100;
  }

  Batch batch(const Vector3d& beside, std::size_t count) {
    Batch batch;
    for (std::size_t i = 0; i < count; ++i) {
      batch.points.push_back(feature<1>(beside));
      batch.segments.push_back(feature<2>(beside));
      batch.triangles.push_back(feature<3>(beside));
    }
    for (const auto& corners : batch.points) grow(batch.box, corners);
    for (const auto& corners : batch.segments) grow(batch.box, corners);
    for (const auto& corners : batch.triangles) grow(batch.box, corners);
    return batch;
  }

 private:
  template <std::size_t Corners>
  Corner<Corners> feature(const Vector3d& beside) {
    const Vector3d middle = beside + vector(1);
    double size = 0.3;
    if (family_ == Family::tiny_and_large) size = std::ldexp(1.0, -static_cast<int>(random_.below(30)) + 8);
    if (family_ == Family::interlocked) size = 1.5;
    Corner<Corners> corners;
    const Vector3d along = vector(1);
    for (Vector3d& corner : corners) {
      Vector3d offset = vector(size);
      if (family_ == Family::needles) offset = along * random_.between(-1, 1) + offset * 1e-9;
      if (family_ == Family::degenerate && random_.chance(0.7)) offset = along * random_.below(3);
      if (family_ == Family::flat) offset.z() *= 1e-7;
      corner = middle + offset;
      if (family_ == Family::flat) corner.z() = beside.z() + offset.z();
      if (family_ == Family::grid) corner = (corner * 4).array().round().matrix() / 4;
      corner = corner * scale_ + origin_;
    }
    return corners;
  }

  Vector3d vector(double size) {
    const double x = random_.between(-size, size);
    const double y = random_.between(-size, size);
    return {x, y, random_.between(-size, size)};
  }

  template <std::size_t Corners>
  static void grow(Box& box, const Corner<Corners>& corners) {
    for (const Vector3d& corner : corners) box.add(corner);
  }

  Family family_;
  Random random_;
  Vector3d origin_ = Vector3d::Zero();
  double scale_ = 1;
};

Vector real(const Vector3d& point) {
  return point.cast<Real>();
}

Real to_segment(const Vector& p, const Vector& from, const Vector& to) {
  const Vector along = to - from;
  const Real length_squared = along.squaredNorm();
  const Real t = length_squared > 0 ? std::clamp<Real>(along.dot(p - from) / length_squared, 0, 1) : 0;
  return (from + along * t - p).norm();
}

Real distance(const Corner<1>& a, const Corner<1>& b) {
  return (real(a[0]) - real(b[0])).norm();
}

/// To the nearest side, or straight down where that lands inside.
Real distance(const Corner<1>& a, const Corner<3>& b) {
  const Vector p = real(a[0]);
  const std::array<Vector, 3> c{real(b[0]), real(b[1]), real(b[2])};
  Real nearest = std::min({to_segment(p, c[0], c[1]), to_segment(p, c[1], c[2]), to_segment(p, c[2], c[0])});
  const Vector normal = (c[1] - c[0]).cross(c[2] - c[0]);
  if (normal.squaredNorm() == 0) return nearest;
  for (std::size_t i = 0; i < 3; ++i)
    if (normal.cross(c[(i + 1) % 3] - c[i]).dot(p - c[i]) < 0) return nearest;
  return std::min(nearest, std::abs(normal.dot(p - c[0])) / normal.norm());
}

/// Between the ends and the other segment, or between the inside of both.
Real distance(const Corner<2>& a, const Corner<2>& b) {
  const std::array<Vector, 4> c{real(a[0]), real(a[1]), real(b[0]), real(b[1])};
  Real nearest = std::min({to_segment(c[0], c[2], c[3]), to_segment(c[1], c[2], c[3]),
                           to_segment(c[2], c[0], c[1]), to_segment(c[3], c[0], c[1])});
  const Vector u = c[1] - c[0];
  const Vector v = c[3] - c[2];
  const Vector w = c[2] - c[0];
  const Vector normal = u.cross(v);
  const Real determinant = normal.squaredNorm();
  if (determinant == 0) return nearest;
  const Real s = w.cross(v).dot(normal) / determinant;
  const Real t = w.cross(u).dot(normal) / determinant;
  if (s < 0 || s > 1 || t < 0 || t > 1) return nearest;
  return std::min(nearest, (c[0] + u * s - c[2] - v * t).norm());
}

/// What the bounds of many pairs were worth.
struct Tally {
  std::size_t compared = 0;
  std::size_t violations = 0;
  std::size_t loose = 0;  ///< bounds more than a thousandth of the sizes below the truth
  double most_used = 0;   ///< the largest part of the margin that rounding needed

  void add(Real bound, Real truth, Real sizes) {
    ++compared;
    if (bound > truth) ++violations;
    if (bound < truth - sizes * 1e-3L) ++loose;
    const Real allowed = kernels::margin * sizes;
    most_used = std::max(most_used, static_cast<double>((bound + allowed - truth) / allowed));
  }
};

template <std::size_t Corners, std::size_t Components>
FeatureBlock<Corners, Components> block_of(const std::vector<Corner<Corners>>& features, Part part,
                                           const FilterFrame& frame) {
  FeatureBlock<Corners, Components> block(part);
  std::vector<Vector3d> positions;
  CornerList corners;
  block.begin(features.size());
  corners.begin(Corners * features.size());
  for (std::size_t i = 0; i < features.size(); ++i) {
    block.add(static_cast<std::uint32_t>(i));
    for (const Vector3d& corner : features[i]) {
      corners.add(static_cast<std::uint32_t>(positions.size()));
      positions.push_back(corner);
    }
  }
  std::vector<std::uint32_t> all(positions.size());
  std::iota(all.begin(), all.end(), 0U);
  std::vector<kernels::Point> vertices(positions.size());
  if (!all.empty())
    kernels::position_passes().doubles.bring({positions[0].data(), all.back()}, all.data(), all.size(),
                                             frame.for_points(), vertices.data());
  block.lay_out(vertices.data(), corners.padded());
  block.prepare();
  return block;
}

PointBlock block_of(const std::vector<Corner<1>>& points, const FilterFrame& frame) {
  return block_of<1, kernels::point::count>(points, Part::vertex, frame);
}
SegmentBlock block_of(const std::vector<Corner<2>>& segments, const FilterFrame& frame) {
  return block_of<2, kernels::segment::count>(segments, Part::edge, frame);
}
TriangleBlock block_of(const std::vector<Corner<3>>& triangles, const FilterFrame& frame) {
  return block_of<3, kernels::triangle::count>(triangles, Part::face, frame);
}

/// The survivors of one call, with room for a block.
struct Found {
  explicit Found(std::size_t room) : index(room), bound(room) {}
  kernels::Survivors out() { return {index.data(), bound.data()}; }

  std::vector<std::uint32_t> index;
  std::vector<float> bound;
};

/// Compares the bounds of all pairs with the truth.
template <typename Kernel, typename Row, typename Column>
void check_bounds(Kernel kernel, const FilterFrame& frame, const std::vector<Row>& rows,
                  const std::vector<Column>& columns, Tally& tally) {
  const auto row_block = block_of(rows, frame);
  const auto column_block = block_of(columns, frame);
  constexpr std::size_t row_size = 3 * std::tuple_size_v<Row>;
  constexpr std::size_t column_size = 3 * std::tuple_size_v<Column>;
  Found found(columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t count = kernel(row_of(row_block, i), column_block.block(), infinity, found.out());
    REQUIRE(count == columns.size());
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t j = found.index[k];
      const Real sizes =
          Real(row_block.component(row_size, i)) + Real(column_block.component(column_size, j));
      const Real truth = distance(rows[i], columns[j]) * Real(frame.scale());
      if (std::isinf(static_cast<double>(sizes)))
        REQUIRE(found.bound[k] == -infinity);
      else
        tally.add(found.bound[k], truth, sizes);
    }
  }
}

Vector3d beside_of(std::uint64_t seed) {
  Random random(seed * 77 + 5);
  return {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
}

/// Whether a segment crosses a triangle strictly, in rational arithmetic.
bool crosses(const Corner<2>& segment, const Corner<3>& triangle) {
  using namespace oracle;
  const Point p = exact(segment[0]);
  const Point along = exact(segment[1]) - p;
  std::array<Point, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) corner[i] = exact(triangle[i]) - p;
  const Point normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const int side_q = sgn(dot(normal, along - corner[0]));
  if (-sgn(dot(normal, corner[0])) * side_q != -1) return false;
  for (std::size_t i = 0; i < 3; ++i)
    if (sgn(dot(along, cross(corner[i], corner[(i + 1) % 3]))) != side_q) return false;
  return true;
}

/// Everything that all kernels say of two batches, limits included.
std::vector<std::uint32_t> transcript(const Batch& a, const Batch& b) {
  const FilterFrame frame(a.box, b.box);
  const kernels::Filter& filter = kernels::filter();
  const PointBlock points = block_of(a.points, frame);
  const SegmentBlock segments = block_of(a.segments, frame);
  const PointBlock other_points = block_of(b.points, frame);
  const SegmentBlock other_segments = block_of(b.segments, frame);
  const TriangleBlock triangles = block_of(b.triangles, frame);
  Found found(a.points.size());
  std::vector<std::uint32_t> words;
  const auto take = [&](std::size_t count) {
    words.push_back(static_cast<std::uint32_t>(count));
    for (std::size_t k = 0; k < count; ++k) {
      words.push_back(found.index[k]);
      std::uint32_t bits = 0;
      std::memcpy(&bits, &found.bound[k], sizeof bits);
      words.push_back(bits);
    }
  };
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (const float limit : {infinity, 0.5F, 0.0F}) {
      take(filter.near_points(row_of(points, i), other_points.block(), limit, found.out()));
      take(filter.near_triangles(row_of(points, i), triangles.block(), limit, found.out()));
      take(filter.near_segments(row_of(segments, i), other_segments.block(), limit, found.out()));
    }
    take(filter.maybe_pierced(row_of(segments, i), triangles.block(), found.out()));
  }
  const auto take_clipped = [&](const kernels::Block& block, kernels::Filter::Clip clip, float limit) {
    std::vector<std::uint32_t> others(block.count);
    kernels::BoxInFrame box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, 0};
    const kernels::SlabInFrame slab = frame.to_local(slab_of(a.triangles.front()), a.triangles.front()[0]);
    const kernels::ClipCount count = clip(block, {frame.to_local(a.box), frame.to_local(b.box), slab, limit},
                                          {found.index.data(), others.data(), &box});
    words.push_back(static_cast<std::uint32_t>(count.touching));
    words.insert(words.end(), found.index.begin(),
                 found.index.begin() + static_cast<std::ptrdiff_t>(count.touching));
    words.insert(words.end(), others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count.others));
    std::array<std::uint32_t, sizeof box / sizeof(std::uint32_t)> bits{};
    std::memcpy(bits.data(), &box, sizeof box);
    words.insert(words.end(), bits.begin(), bits.end());
  };
  for (const float limit : {infinity, 0.5F, 0.0F}) {
    take_clipped(other_points.block(), filter.clip_points, limit);
    take_clipped(other_segments.block(), filter.clip_segments, limit);
    take_clipped(triangles.block(), filter.clip_triangles, limit);
  }
  return words;
}

constexpr std::size_t family_count = static_cast<std::size_t>(Family::count);

}  // namespace

TEST_CASE("filter: the margin is more than the analysis of docs/numerics.md needs") {
  // In units of 2^-24 and of the features' sizes: conversion 1, products 3, difference 1, norm and
  // quotient 3.5, the margin's subtraction 1, each times the root of 3.
  CHECK((1 + 3 + 1 + 3.5 + 1) * std::sqrt(3.0) < double{kernels::margin} / unit);
  // Products of axes and coordinates stay in float's range.
  CHECK(std::pow(double{kernels::largest_size}, 5) < 0x1p126);
  CHECK(double{kernels::least_size} * double{kernels::margin} *
            std::sqrt(double{kernels::least_axis_squared}) >
        0x1p24 * 0x1p-126);
}

TEST_CASE("filter: no lower bound is above the truth, and few are far below") {
  std::size_t compared = 0;
  double most_used = 0;
  for (std::size_t family = 0; family < family_count; ++family) {
    std::array<Tally, 3> tallies;
    for (std::uint64_t seed = 0; seed < 80; ++seed) {
      Generator generator(static_cast<Family>(family), seed);
      const Batch a = generator.batch(Vector3d::Zero(), 25);
      const Batch b = generator.batch(beside_of(seed), 33);
      const FilterFrame frame(a.box, b.box);
      const kernels::Filter& filter = kernels::filter();
      check_bounds(filter.near_points, frame, a.points, b.points, tallies[0]);
      check_bounds(filter.near_triangles, frame, a.points, b.triangles, tallies[1]);
      check_bounds(filter.near_segments, frame, a.segments, b.segments, tallies[2]);
    }
    for (const Tally& tally : tallies) {
      INFO("family " << family << ", compared " << tally.compared << ", loose " << tally.loose
                     << ", margin used " << tally.most_used);
      CHECK(tally.violations == 0);
      CHECK(tally.most_used < 1);
      CHECK(tally.loose * 100 < tally.compared);
      compared += tally.compared;
      most_used = std::max(most_used, tally.most_used);
    }
  }
  CHECK(compared > 1'000'000);
  CHECK(most_used > 0.02);  // the margin is no more than fifty times what is needed
  std::cout << "compared " << compared << " lower bounds with the truth; at most " << most_used
            << " of the margin was used\n";
}

TEST_CASE("filter: what a segment crosses survives, and little else") {
  std::size_t crossed = 0;
  std::size_t discarded = 0;
  std::size_t kept = 0;
  for (std::size_t family = 0; family < family_count; ++family)
    for (std::uint64_t seed = 0; seed < 45; ++seed) {
      Generator generator(static_cast<Family>(family), seed);
      const Batch a = generator.batch(Vector3d::Zero(), 20);
      const Batch b = generator.batch(Vector3d::Zero(), 20);
      const FilterFrame frame(a.box, b.box);
      const SegmentBlock segments = block_of(a.segments, frame);
      const TriangleBlock triangles = block_of(b.triangles, frame);
      Found found(b.triangles.size());
      for (std::size_t i = 0; i < a.segments.size(); ++i) {
        const std::size_t count =
            kernels::filter().maybe_pierced(row_of(segments, i), triangles.block(), found.out());
        std::vector<bool> survives(b.triangles.size(), false);
        for (std::size_t k = 0; k < count; ++k) survives[found.index[k]] = true;
        for (std::size_t j = 0; j < b.triangles.size(); ++j) {
          const bool is_crossed = crosses(a.segments[i], b.triangles[j]);
          if (is_crossed) REQUIRE(survives[j]);
          crossed += is_crossed ? 1U : 0U;
          discarded += survives[j] ? 0U : 1U;
          kept += survives[j] && !is_crossed ? 1U : 0U;
        }
      }
    }
  CHECK(crossed > 1000);
  CHECK(discarded > 20 * kept);
  std::cout << "compared " << crossed + discarded + kept << " segments and triangles: " << crossed
            << " cross, all kept; " << discarded << " discarded, " << kept << " kept without need\n";
}

TEST_CASE("filter: every instruction set gives the bits of plain code") {
  const InstructionSet before = instruction_set();
  std::size_t words = 0;
  for (std::size_t family = 0; family < family_count; ++family)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Generator generator(static_cast<Family>(family), seed);
      const Batch a = generator.batch(Vector3d::Zero(), 35);
      const Batch b = generator.batch(beside_of(seed), 35);
      use_instruction_set(InstructionSet::scalar);
      const auto expected = transcript(a, b);
      words += expected.size();
      for (const InstructionSet set : available_instruction_sets()) {
        INFO(to_string(set));
        use_instruction_set(set);
        REQUIRE(instruction_set() == set);
        REQUIRE(transcript(a, b) == expected);
      }
    }
  use_instruction_set(before);
  CHECK(words > 100'000);
  std::cout << "compared " << words << " words from " << available_instruction_sets().size()
            << " instruction sets\n";
}

TEST_CASE("filter: the best available instruction set is in use, and others are refused") {
  CHECK(available_instruction_sets().front() == InstructionSet::scalar);
  CHECK(instruction_set() == available_instruction_sets().back());
  for (const InstructionSet set :
       {InstructionSet::avx2, InstructionSet::avx512, static_cast<InstructionSet>(9)}) {
    const auto available = available_instruction_sets();
    if (std::find(available.begin(), available.end(), set) != available.end()) continue;
    CHECK_THROWS_AS(use_instruction_set(set), Error);
  }
  CHECK(instruction_set() == available_instruction_sets().back());
}

TEST_CASE("filter: a limit is never rounded down") {
  Random random(4);
  for (int i = 0; i < 10'000; ++i) {
    Box box;
    box.add(Vector3d::Zero());
    box.add(
        Vector3d::Constant(std::ldexp(random.between(0.5, 1), static_cast<int>(random.below(600)) - 300)));
    const FilterFrame frame(box, box);
    const double limit = std::ldexp(random.between(0.5, 1), static_cast<int>(random.below(700)) - 350);
    CHECK(double{frame.to_local_limit(limit)} >= limit * frame.scale());
  }
  CHECK(FilterFrame(Box{}, Box{}).to_local_limit(std::numeric_limits<double>::infinity()) == infinity);
}

namespace {

/// What clipping kept, left out, and found to touch.
struct ClipTally {
  std::size_t kept = 0;
  std::size_t left_out = 0;
  std::size_t left_out_by_slab = 0;  ///< and not by the box
  std::size_t touching = 0;
};

/// The gap of two boxes.
Real gap_of(const Box& a, const Box& b) {
  Real squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const Real gap =
        std::max<Real>({Real(a.min[axis]) - Real(b.max[axis]), Real(b.min[axis]) - Real(a.max[axis]), 0});
    squared += gap * gap;
  }
  return std::sqrt(squared);
}

/// How far corners are outside a slab, along its normal.
template <std::size_t Corners>
Real gap_of(const Corner<Corners>& corners, const LeafSlab& slab, const Vector3d& middle) {
  Real least = std::numeric_limits<Real>::infinity();
  Real most = -least;
  for (const Vector3d& corner : corners) {
    Real along = 0;
    for (int axis = 0; axis < 3; ++axis)
      along += Real(slab.normal[axis]) * (Real(corner[axis]) - Real(middle[axis]));
    least = std::min(least, along);
    most = std::max(most, along);
  }
  return std::max<Real>({least - Real(slab.high), Real(slab.low) - most, 0});
}

/// Takes the features near a box and a slab, and compares what is left out, said not to touch, or outside the
/// box that is found with the truth.
template <std::size_t Corners, std::size_t Components>
void check_clip(const FeatureBlock<Corners, Components>& block, const std::vector<Corner<Corners>>& features,
                kernels::Filter::Clip clip, const FilterFrame& frame, const Box& box, const LeafSlab& slab,
                const Vector3d& middle, float limit, ClipTally& tally) {
  kernels::BoxInFrame found{
      {infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, kernels::least_size};
  FeatureBlock<Corners, Components> taken(block.part());
  const kernels::BoxInFrame local = frame.to_local(box);
  taken.take(block, clip, {local, local, frame.to_local(slab, middle), limit}, &found);
  std::vector<bool> is_kept(features.size(), false);
  for (std::size_t i = 0; i < taken.count(); ++i) {
    const std::uint32_t feature = taken.owner(i);
    is_kept[feature] = true;
    for (std::size_t k = 0; k < 3 * Corners; ++k) {
      REQUIRE(taken.component(k, i) == block.component(k, feature));
      REQUIRE(taken.component(k, i) >= found.min[k % 3]);
      REQUIRE(taken.component(k, i) <= found.max[k % 3]);
    }
    Box own;
    for (const Vector3d& corner : features[feature]) own.add(corner);
    const bool touches = gap_of(own, box) == 0;
    if (touches) REQUIRE(i < taken.touching());
    REQUIRE(found.size >= block.component(3 * Corners, feature));
    tally.touching += touches ? 1U : 0U;
  }
  for (std::size_t i = 0; i < features.size(); ++i) {
    Box own;
    for (const Vector3d& corner : features[i]) own.add(corner);
    const bool is_near_box = gap_of(own, box) * Real(frame.scale()) <= Real(limit);
    if (is_near_box && gap_of(features[i], slab, middle) * Real(frame.scale()) <= Real(limit))
      REQUIRE(is_kept[i]);
    ++(is_kept[i] ? tally.kept : tally.left_out);
    if (is_near_box && !is_kept[i]) ++tally.left_out_by_slab;
  }
}

}  // namespace

TEST_CASE(
    "filter: clipping by a box and a slab leaves out nothing that is within the limit, and finds what "
    "touches") {
  ClipTally tally;
  for (std::size_t family = 0; family < family_count; ++family)
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Generator generator(static_cast<Family>(family), seed);
      const Batch a = generator.batch(Vector3d::Zero(), 37);
      Batch b = generator.batch(beside_of(seed), 4);
      const FilterFrame frame(a.box, b.box);
      const PointBlock points = block_of(a.points, frame);
      const SegmentBlock segments = block_of(a.segments, frame);
      const TriangleBlock triangles = block_of(a.triangles, frame);
      const kernels::Filter& filter = kernels::filter();
      for (const float limit : {0.0F, 0.01F, 0.3F, infinity})
        for (const auto& corners : b.triangles) {
          Box box;
          for (const Vector3d& corner : corners) box.add(corner);
          for (const LeafSlab& slab : {LeafSlab{}, slab_of(corners)}) {
            check_clip(points, a.points, filter.clip_points, frame, box, slab, corners[0], limit, tally);
            check_clip(segments, a.segments, filter.clip_segments, frame, box, slab, corners[0], limit,
                       tally);
            check_clip(triangles, a.triangles, filter.clip_triangles, frame, box, slab, corners[0], limit,
                       tally);
          }
        }
    }
  CHECK(tally.kept > 40'000);
  CHECK(tally.left_out > 40'000);
  CHECK(tally.left_out_by_slab > 2'000);
  CHECK(tally.touching > 4'000);
  std::cout << "clipped " << tally.kept + tally.left_out << " features: " << tally.kept << " kept, "
            << tally.left_out << " left out, " << tally.left_out_by_slab << " of them by the slab, "
            << tally.touching << " touch\n";
}

TEST_CASE("filter: a frame serves leaves of about its size near it, and no others") {
  const auto box_at = [](const Vector3d& corner, double size) {
    Box box;
    box.add(corner);
    box.add(corner + Vector3d::Constant(size));
    return box;
  };
  const Box leaf = box_at({3, 4, 5}, 1);
  const FilterFrame frame(leaf, box_at({4, 4, 5}, 1));
  CHECK(frame.serves(leaf, leaf));
  CHECK(frame.serves(box_at({100, -90, 80}, 1.5), box_at({100, -90, 80}, 1e6)));
  CHECK_FALSE(frame.serves(box_at({600, 0, 0}, 1), box_at({600, 0, 0}, 1)));
  CHECK_FALSE(frame.serves(box_at({3, 4, 5}, 0x1p-10), leaf));
  CHECK_FALSE(frame.serves(box_at({3, 4, 5}, 0x1p10), box_at({3, 4, 5}, 0x1p10)));
  CHECK_FALSE(FilterFrame().serves(leaf, leaf));
}

}  // namespace graze::tests
