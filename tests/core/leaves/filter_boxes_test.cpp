// Features are left out by boxes and slabs only where these are further away than the limit, which is
// compared with long double.

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "core/leaves/filter_families.hpp"
#include "support/catch.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

/// Counts the features that clipping kept, those that it left out, and those that it found to touch.
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
template <std::size_t Corners>
void check_clip(const FeatureBlock<Corners>& block, const std::vector<Corner<Corners>>& features,
                const FilterFrame& frame, const Box& box, const LeafSlab& slab, const Vector3d& middle,
                float limit, ClipTally& tally) {
  kernels::BoxInFrame found = empty_box();
  SelectedFeatures<Corners> taken;
  const kernels::BoxInFrame local = frame.to_local(box);
  taken.select_near(block, {local, local, frame.to_local(slab, middle), limit}, &found);
  std::vector<bool> is_kept(features.size(), false);
  for (std::size_t i = 0; i < taken.count(); ++i) {
    const std::uint32_t feature = taken.index()[i];
    is_kept[feature] = true;
    for (std::size_t k = 0; k < 3 * Corners; ++k) {
      REQUIRE(block.component(k, feature) >= found.min[k % 3]);
      REQUIRE(block.component(k, feature) <= found.max[k % 3]);
    }
    Box own;
    for (const Vector3d& corner : features[feature]) own.add(corner);
    const bool touches = gap_of(own, box) == 0;
    if (touches) REQUIRE(i < taken.touching());
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
      for (const float limit : {0.0F, 0.01F, 0.3F, infinity})
        for (const auto& corners : b.triangles) {
          Box box;
          for (const Vector3d& corner : corners) box.add(corner);
          for (const LeafSlab& slab : {LeafSlab{}, slab_of(corners)}) {
            check_clip(points, a.points, frame, box, slab, corners[0], limit, tally);
            check_clip(segments, a.segments, frame, box, slab, corners[0], limit, tally);
            check_clip(triangles, a.triangles, frame, box, slab, corners[0], limit, tally);
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

namespace {

struct BoxTally {
  std::size_t left = 0;
  std::size_t discarded = 0;
};

/// The largest gap of two boxes along an axis, below 0 where they overlap along each.
Real gap_along_axes(const Box& a, const Box& b) {
  Real gap = -std::numeric_limits<Real>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    gap = std::max<Real>({gap, Real(a.min[axis]) - Real(b.max[axis]), Real(b.min[axis]) - Real(a.max[axis])});
  return gap;
}
template <std::size_t Corners>
Box box_of(const Corner<Corners>& corners) {
  Box box;
  for (const Vector3d& corner : corners) box.add(corner);
  return box;
}

/// Compares the pairs that are left by their boxes with the truth: those within the limit are there, and none
/// that is further than the margins.
template <std::size_t RowCorners, std::size_t Corners>
void check_near_boxes(const std::vector<Corner<RowCorners>>& rows,
                      const std::vector<Corner<Corners>>& columns, const FilterFrame& frame, float limit,
                      BoxTally& tally) {
  const FeatureBlock<RowCorners> row_block = block_of(rows, frame);
  const FeatureBlock<Corners> column_block = block_of(columns, frame);
  const auto pairs = near_boxes(row_block, column_block, limit);
  REQUIRE(std::is_sorted(pairs.begin(), pairs.end()));
  for (std::uint32_t i = 0; i < rows.size(); ++i)
    for (std::uint32_t j = 0; j < columns.size(); ++j) {
      const Real gap = gap_of(box_of(rows[i]), box_of(columns[j])) * Real(frame.scale());
      const Real sizes = Real(size_of(row_block, i)) + Real(size_of(column_block, j));
      const bool is_left = std::binary_search(pairs.begin(), pairs.end(), std::pair(i, j));
      if (gap <= Real(limit)) REQUIRE(is_left);
      if (gap > Real(limit) * (1 + 1e-6L) + 4 * Real(kernels::margin) * sizes) REQUIRE_FALSE(is_left);
      ++(is_left ? tally.left : tally.discarded);
    }
}

}  // namespace

TEST_CASE("filter: pairs are left by their boxes where these are within the limit") {
  BoxTally tally;
  for (std::size_t family = 0; family < family_count; ++family)
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      Generator generator(static_cast<Family>(family), seed);
      const std::size_t columns = 1 + seed * 5 % 37;
      const Batch a = generator.batch(Vector3d::Zero(), 19);
      const Batch b = generator.batch(beside_of(seed), columns);
      const FilterFrame frame(a.box, b.box);
      for (const float limit : {0.0F, 0.02F, 0.4F, infinity}) {
        check_near_boxes(a.points, b.triangles, frame, limit, tally);
        check_near_boxes(a.segments, b.segments, frame, limit, tally);
        check_near_boxes(a.segments, b.triangles, frame, limit, tally);
      }
    }
  CHECK(tally.left > 50'000);
  CHECK(tally.discarded > 50'000);
  std::cout << "compared " << tally.left + tally.discarded << " pairs of boxes, " << tally.left << " left\n";
}

TEST_CASE("filter: what can be beside another box is what is within the distance of it") {
  Random random(12);
  std::size_t inside = 0;
  std::size_t empty = 0;
  for (int i = 0; i < 4000; ++i) {
    const double scale = std::ldexp(1.0, static_cast<int>(random.below(60)) - 30);
    const auto point = [&](double spread) -> Vector3d { return scale * random.vector(-spread, spread); };
    Box a;
    Box b;
    const Vector3d away = point(2);
    for (int corner = 0; corner < 2; ++corner) {
      a.add(point(1));
      b.add(away + point(1));
    }
    const FilterFrame frame(a, b);
    const double distance = scale * random.between(0, 1);
    const kernels::BoxInFrame beside = frame.to_local_beside(a, b, distance);
    for (int k = 0; k < 20; ++k) {
      Vector3d p;
      Vector3d q;
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = a.min[axis] + random.between(0, 1) * (a.max[axis] - a.min[axis]);
        q[axis] = std::clamp(p[axis], b.min[axis], b.max[axis]);
      }
      if ((p - q).norm() > distance) continue;
      ++inside;
      REQUIRE_FALSE(is_empty(beside));
      for (int axis = 0; axis < 3; ++axis) {
        REQUIRE(double{beside.min[axis]} <= frame.to_local(p)[axis]);
        REQUIRE(double{beside.max[axis]} >= frame.to_local(p)[axis]);
      }
    }
    const bool is_far = gap_along_axes(a, b) > Real(distance) * (1 + 1e-3L);
    if (is_far) REQUIRE(is_empty(beside));
    empty += is_far ? 1U : 0U;
  }
  CHECK(inside > 4'000);
  CHECK(empty > 500);
}

}  // namespace graze::tests
