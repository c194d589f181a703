// This test compares every lower bound that the float kernels give with the distance in long double, and
// every instruction set with plain code. A pair that the kernels discard must truly be far.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <graze/error.hpp>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <string>

#include "core/answers/nearest_voronoi.hpp"
#include "core/leaves/filter_families.hpp"
#include "leaves/layout/float_filter.hpp"
#include "support/catch.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

constexpr double unit = 0x1p-24;  // the rounding of a float

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

/// Counts how many lower bounds of pairs were compared, and how good they were.
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

kernels::Point point_of(const PointBlock& block, std::size_t i) {
  return {{block.component(0, i), block.component(1, i), block.component(2, i)}, size_of(block, i)};
}

/// The survivors of one call, with room for a block.
struct Found {
  explicit Found(std::size_t room) : index(room), bound(room) {}
  kernels::Survivors out() { return {index.data(), bound.data()}; }

  std::vector<std::uint32_t> index;
  std::vector<float> bound;
};

/// The answers of a kernel about the pairs of feature `row` of one block and all features of another.
struct Bounds {
  std::vector<float> bound;
  std::vector<bool> is_left;
  std::vector<std::int32_t> voronoi;
};
Bounds bounds_of(const PointBlock& rows, std::size_t row, const PointBlock& columns,
                 const kernels::NearLimits& limits) {
  Bounds bounds{std::vector<float>(columns.count(), infinity), std::vector<bool>(columns.count()),
                std::vector<std::int32_t>(columns.count(), kernels::unsure_voronoi)};
  Found found(columns.count());
  const std::size_t count =
      kernels::filter().near_points(point_of(rows, row), columns.block(), limits.limit, found.out());
  for (std::size_t k = 0; k < count; ++k) {
    bounds.bound[found.index[k]] = found.bound[k];
    bounds.is_left[found.index[k]] = true;
  }
  return bounds;
}
template <std::size_t RowCorners, std::size_t Corners, typename Ask>
Bounds bounds_by(const Ask& ask, const FeatureBlock<RowCorners>& rows, std::size_t row,
                 const FeatureBlock<Corners>& columns) {
  Bounds bounds;
  for (std::size_t first = 0; first < columns.count(); first += kernels::lanes) {
    kernels::FeaturePairs<RowCorners, Corners> pairs{};
    const std::size_t count = std::min(kernels::lanes, columns.count() - first);
    for (std::size_t lane = 0; lane < count; ++lane) {
      std::copy_n(rows.corners(row), RowCorners, pairs.a[lane]);
      std::copy_n(columns.corners(first + lane), Corners, pairs.b[lane]);
    }
    const std::uint32_t left = ask(pairs);
    for (std::size_t lane = 0; lane < count; ++lane) {
      bounds.bound.push_back(pairs.bound[lane]);
      bounds.is_left.push_back((left >> lane & 1U) != 0);
      bounds.voronoi.push_back(pairs.voronoi[lane]);
    }
  }
  return bounds;
}
Bounds bounds_of(const PointBlock& rows, std::size_t row, const TriangleBlock& columns,
                 const kernels::NearLimits& limits) {
  const auto kernel = kernels::filter().bound_points_and_triangles;
  return bounds_by([&](auto& pairs) { return kernel(pairs, limits); }, rows, row, columns);
}
Bounds bounds_of(const SegmentBlock& rows, std::size_t row, const SegmentBlock& columns,
                 const kernels::NearLimits& limits) {
  const auto kernel = kernels::filter().bound_segments;
  return bounds_by([&](auto& pairs) { return kernel(pairs, limits); }, rows, row, columns);
}
Bounds passing(const SegmentBlock& rows, std::size_t row, const TriangleBlock& columns) {
  return bounds_by(kernels::filter().passing, rows, row, columns);
}

Bounds over_planes(const SegmentBlock& rows, std::size_t row, const TriangleBlock& columns, float limit) {
  const auto kernel = kernels::filter().bound_over_planes;
  return bounds_by([&](auto& pairs) { return kernel(pairs, limit); }, rows, row, columns);
}

/// How far a segment is from a triangle.
Real distance(const Corner<2>& segment, const Corner<3>& triangle) {
  if (passes(exact_corners(segment), exact_corners(triangle))) return 0;
  Real nearest =
      std::min(distance(Corner<1>{segment[0]}, triangle), distance(Corner<1>{segment[1]}, triangle));
  for (std::size_t i = 0; i < 3; ++i)
    nearest = std::min(nearest, distance(segment, Corner<2>{triangle[i], triangle[(i + 1) % 3]}));
  return nearest;
}

/// Compares the bounds of all pairs with the truth.
template <typename Row, typename Column>
void check_bounds(const FilterFrame& frame, const std::vector<Row>& rows, const std::vector<Column>& columns,
                  Tally& tally) {
  const auto row_block = block_of(rows, frame);
  const auto column_block = block_of(columns, frame);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Bounds bounds = bounds_of(row_block, i, column_block, {infinity});
    REQUIRE(bounds.bound.size() == columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j) {
      REQUIRE(bounds.is_left[j]);
      const Real sizes = Real(size_of(row_block, i)) + Real(size_of(column_block, j));
      const Real truth = distance(rows[i], columns[j]) * Real(frame.scale());
      if (std::isinf(static_cast<double>(sizes)))
        REQUIRE(bounds.bound[j] == -infinity);
      else
        tally.add(bounds.bound[j], truth, sizes);
    }
  }
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
  std::vector<std::uint32_t> words;
  const auto take = [&](const Bounds& bounds) {
    for (std::size_t k = 0; k < bounds.bound.size(); ++k) {
      std::uint32_t bits = 0;
      std::memcpy(&bits, &bounds.bound[k], sizeof bits);
      words.push_back(bits);
      words.push_back(bounds.is_left[k] ? 1 : 0);
      if (bounds.is_left[k]) words.push_back(static_cast<std::uint32_t>(bounds.voronoi[k]));
    }
  };
  const auto take_pairs = [&](const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs) {
    for (const auto& [row, column] : pairs) words.insert(words.end(), {row, column});
  };
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    for (const kernels::NearLimits limits :
         {kernels::NearLimits{infinity, infinity}, {infinity, 1}, {0.5F, 0.3F}, {0.5F}, {0}}) {
      take(bounds_of(points, i, other_points, limits));
      take(bounds_of(points, i, triangles, limits));
      take(bounds_of(segments, i, other_segments, limits));
    }
    take(passing(segments, i, triangles));
    for (const float limit : {infinity, 0.5F, 0.0F}) take(over_planes(segments, i, triangles, limit));
  }
  for (const float limit : {infinity, 0.5F, 0.0F}) {
    take_pairs(near_boxes(points, triangles, limit));
    take_pairs(near_boxes(segments, other_segments, limit));
    take_pairs(near_boxes(segments, triangles, limit));
  }
  const auto take_clipped = [&](const kernels::Block& block, kernels::Filter::Clip clip, float limit) {
    std::vector<std::uint32_t> touching(block.count + kernels::lanes);
    std::vector<std::uint32_t> others(block.count + kernels::lanes);
    kernels::BoxInFrame box = empty_box();
    const kernels::SlabInFrame slab = frame.to_local(slab_of(a.triangles.front()), a.triangles.front()[0]);
    const kernels::ClipCount count = clip(block, {frame.to_local(a.box), frame.to_local(b.box), slab, limit},
                                          {touching.data(), others.data(), &box});
    words.push_back(static_cast<std::uint32_t>(count.touching));
    words.insert(words.end(), touching.begin(),
                 touching.begin() + static_cast<std::ptrdiff_t>(count.touching));
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

}  // namespace

TEST_CASE("filter: the margin is more than the analysis of docs/numerics.md needs") {
  // In units of 2^-24 and of the features' sizes: conversion 1, products 3, difference 1, norm and
  // quotient 3.5, the margin's subtraction 1, each times the root of 3.
  CHECK((1 + 3 + 1 + 3.5 + 1) * std::sqrt(3.0) < double{kernels::margin} / unit);
  // Products of axes and coordinates stay in float's range.
  CHECK(std::pow(double{kernels::largest_size}, 5) < 0x1p126);
  CHECK(double{kernels::least_size} * double{kernels::margin} * double{kernels::least_axis} >
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
      check_bounds(frame, a.points, b.points, tallies[0]);
      check_bounds(frame, a.points, b.triangles, tallies[1]);
      check_bounds(frame, a.segments, b.segments, tallies[2]);
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
      std::vector<std::vector<bool>> boxes_meet(a.segments.size(), std::vector<bool>(b.triangles.size()));
      for (const auto& [row, column] : near_boxes(segments, triangles, 0)) boxes_meet[row][column] = true;
      for (std::size_t i = 0; i < a.segments.size(); ++i) {
        std::vector<bool> survives = passing(segments, i, triangles).is_left;
        for (std::size_t j = 0; j < survives.size(); ++j) survives[j] = survives[j] && boxes_meet[i][j];
        for (std::size_t j = 0; j < b.triangles.size(); ++j) {
          const bool is_crossed = passes(exact_corners(a.segments[i]), exact_corners(b.triangles[j]));
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

TEST_CASE("filter: segments are at least as far from triangles as from their planes") {
  std::size_t compared = 0;
  std::size_t tight = 0;
  for (std::size_t family = 0; family < family_count; ++family)
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Generator generator(static_cast<Family>(family), seed);
      const Batch a = generator.batch(Vector3d::Zero(), 20);
      const Batch b = generator.batch(beside_of(seed), 20);
      const FilterFrame frame(a.box, b.box);
      const SegmentBlock segments = block_of(a.segments, frame);
      const TriangleBlock triangles = block_of(b.triangles, frame);
      for (std::size_t i = 0; i < a.segments.size(); ++i) {
        const Bounds bounds = over_planes(segments, i, triangles, 0.1F);
        for (std::size_t j = 0; j < b.triangles.size(); ++j) {
          REQUIRE(bounds.is_left[j] == (bounds.bound[j] < 0.1F));
          if (bounds.bound[j] < 0) continue;
          const Real truth = distance(a.segments[i], b.triangles[j]) * Real(frame.scale());
          REQUIRE(Real(bounds.bound[j]) <= truth);
          ++compared;
          tight += Real(bounds.bound[j]) > truth / 2 ? 1U : 0U;
        }
      }
    }
  CHECK(compared > 20'000);
  CHECK(tight * 4 > compared);
  std::cout << "compared " << compared << " segments beside planes; " << tight
            << " bounds above half of the truth\n";
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
    const double size = random.between(0.5, 1);
    box.add(Vector3d::Constant(std::ldexp(size, static_cast<int>(random.below(600)) - 300)));
    const FilterFrame frame(box, box);
    const double mantissa = random.between(0.5, 1);
    const double limit = std::ldexp(mantissa, static_cast<int>(random.below(700)) - 350);
    CHECK(double{frame.to_local_limit(limit)} >= limit * frame.scale());
  }
  CHECK(FilterFrame(Box{}, Box{}).to_local_limit(std::numeric_limits<double>::infinity()) == infinity);
}

TEST_CASE("filter: a batch hands on what is left, and a quad once") {
  Box box;
  box.add(Vector3d::Zero());
  box.add(Vector3d::Ones());
  const FilterFrame frame(box, box);
  // Above both halves of a quad, nearer to one, far away, and where float does not reach.
  const PointBlock vertices = block_of<1>({{Vector3d(0.3, 0.2, 0.3)},
                                           {Vector3d(0.9, 0.2, 0.3)},
                                           {Vector3d(50, 0.2, 0.3)},
                                           {Vector3d(1e30, 0.2, 0.3)}},
                                          frame);
  const std::vector<kernels::Point> points{
      {{0, 0, 0}, kernels::least_size}, {{1, 0, 0}, 1}, {{1, 1, 0}, 1}, {{0, 1, 0}, 1}};
  const auto halves = [&](std::uint32_t first_owner, std::uint32_t second_owner) {
    TriangleBlock block(FeatureRefKind::face);
    CornerList corners;
    block.begin(2);
    block.add(first_owner);
    block.add(second_owner);
    corners.begin(6);
    for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) corners.add(corner);
    block.lay_out(points.data(), corners.padded());
    return block;
  };
  using HandedOn = std::vector<std::tuple<std::uint32_t, std::uint32_t, bool, std::int32_t>>;
  const auto run = [&](const TriangleBlock& faces, std::size_t expected_discarded) {
    FloatBatch<1, 3> batch;
    std::size_t times_full = 0;
    const auto add = [&](const std::vector<std::uint32_t>& i, const std::vector<std::uint32_t>& j) {
      batch.add(vertices.view(), i.data(), faces.view(), j.data(), i.size(), [&] {
        ++times_full;
        batch.begin();
      });
    };
    add({0, 0, 1, 1, 2, 2, 3, 3}, {0, 1, 0, 1, 0, 1, 0, 1});
    HandedOn handed_on;
    const auto visit = [&](const FeatureRef& vertex, const FeatureRef& face, const KnownInFloat& known) {
      CHECK((vertex.kind == FeatureRefKind::vertex && face.kind == FeatureRefKind::face));
      handed_on.emplace_back(vertex.index, face.index, known.is_bounded, known.voronoi);
    };
    const auto ask = [](auto& pairs) {
      return kernels::filter().bound_points_and_triangles(pairs, {0.5F, 0.5F});
    };
    CHECK(batch.empty(ask, visit) == expected_discarded);
    CHECK(batch.empty(ask, visit) == 0);
    CHECK(times_full == 0);
    const std::vector<std::uint32_t> many(2 * kernels::lanes + 3, 0);
    add(many, many);
    CHECK(times_full == 2);
    return handed_on;
  };
  constexpr auto inside = static_cast<std::int32_t>(VoronoiRegion::inside);
  constexpr auto diagonal = static_cast<std::int32_t>(VoronoiRegion::edge01);  // of the second half
  constexpr std::int32_t unsure = kernels::unsure_voronoi;
  CHECK(run(halves(5, 6), 3) == HandedOn{{0, 5, true, inside},
                                         {0, 6, true, diagonal},
                                         {1, 5, true, inside},
                                         {3, 5, false, unsure},
                                         {3, 6, false, unsure}});
  CHECK(run(halves(7, 7), 3) == HandedOn{{0, 7, true, inside}, {1, 7, true, inside}, {3, 7, false, unsure}});
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
