#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "leaves/layout/feature_block.hpp"
#include "leaves/layout/filter_frame.hpp"
#include "leaves/layout/leaf_vertices.hpp"
#include "support/random/random_scenes.hpp"
#include "surface/leaf_slab.hpp"

/// Features that are hard for float, and blocks of them as the kernels read them.
namespace graze::tests {

using Eigen::Vector3d;
using oracle::Random;

inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// The shape of the features in a generated batch.
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
inline LeafSlab slab_of(const Corner<3>& corner) {
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

inline constexpr std::size_t family_count = static_cast<std::size_t>(Family::count);

/// Returns the offset of the second of two batches from the first.
inline Vector3d beside_of(std::uint64_t seed) {
  Random random(seed * 77 + 5);
  return {random.between(-2, 2), random.between(-2, 2), random.between(-2, 2)};
}

template <std::size_t Corners>
FeatureBlock<Corners> block_of(const std::vector<Corner<Corners>>& features, const FilterFrame& frame) {
  FeatureBlock<Corners> block(Corners == 1   ? FeatureRefKind::vertex
                              : Corners == 2 ? FeatureRefKind::edge
                                             : FeatureRefKind::face);
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
    kernels::position_passes().doubles.to_frame({positions[0].data(), all.back()}, all.data(), all.size(),
                                                frame.for_points(), vertices.data());
  block.lay_out(vertices.data(), corners.padded());
  return block;
}

template <std::size_t Corners>
float size_of(const FeatureBlock<Corners>& block, std::size_t i) {
  return block.component(kernels::size_at<Corners>, i);
}
/// Pairs of features whose boxes a kernel leaves.
template <std::size_t RowCorners, std::size_t Corners>
std::vector<std::pair<std::uint32_t, std::uint32_t>> near_boxes(const FeatureBlock<RowCorners>& rows,
                                                                const FeatureBlock<Corners>& columns,
                                                                float limit) {
  std::vector<std::uint32_t> index(rows.count());
  std::iota(index.begin(), index.end(), 0U);
  const std::size_t room = rows.count() * columns.count() + kernels::lanes;
  std::vector<std::uint32_t> row(room);
  std::vector<std::uint32_t> column(room);
  const kernels::Block all = columns.block();
  const kernels::Block boxes{all.data + kernels::box_at<Corners> * all.stride, all.stride, all.count};
  const std::size_t count =
      kernels::filter().near_boxes({rows.block(), kernels::box_at<RowCorners>, index.data(), index.size()},
                                   boxes, limit, {row.data(), column.data()});
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::size_t k = 0; k < count; ++k) pairs.emplace_back(row[k], column[k]);
  return pairs;
}

}  // namespace graze::tests
