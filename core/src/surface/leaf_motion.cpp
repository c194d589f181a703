#include "surface/leaf_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/region_tree.hpp"

namespace graze {
namespace {

/// A rotation of this kind changes no length by more than this part, and a sum of three products of
/// coordinates loses no more than this part of them.
constexpr double of_rounding = 0x1p-46;

/// An orthonormal frame along three points: its columns.
Eigen::Matrix3d frame_along(const std::array<Eigen::Vector3d, 3>& points) {
  const Eigen::Vector3d along = (points[1] - points[0]).normalized();
  const Eigen::Vector3d normal = along.cross(points[2] - points[0]).normalized();
  Eigen::Matrix3d frame;
  frame << along, normal.cross(along), normal;
  return frame;
}

/// Whether it turns and does nothing else, up to rounding. It is not where points were on one line.
bool is_rotation(const Eigen::Matrix3d& turn) {
  return ((turn.transpose() * turn - Eigen::Matrix3d::Identity()).array().abs() < 0x1p-48).all();
}

/// The greatest coordinate of a box, by its size.
double greatest(const Box& box) {
  return std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
}

/// At least how far two motions take any point of a box apart.
double parting(const LeafMotion& a, const LeafMotion& b, const Box& box) {
  const Eigen::Matrix3d turn = b.turn - a.turn;
  const Eigen::Vector3d middle = turn * ((box.min + box.max) / 2) + (b.shift - a.shift);
  const Eigen::Vector3d half = (box.max - box.min) / 2;
  double most = 0;
  for (const double x : {-half.x(), half.x()})
    for (const double y : {-half.y(), half.y()}) {
      const Eigen::Vector3d on_line = middle + turn.col(0) * x + turn.col(1) * y;
      const Eigen::Vector3d along = turn.col(2) * half.z();
      most = std::max({most, (on_line + along).squaredNorm(), (on_line - along).squaredNorm()});
    }
  const double size = greatest(box) + a.shift.cwiseAbs().maxCoeff() + b.shift.cwiseAbs().maxCoeff();
  return std::sqrt(most) * (1 + of_rounding) + size * of_rounding;
}

}  // namespace

LeafMotion motion_of_leaf(const Surface& surface, const Region& leaf, const Box& rest_box) {
  const IndexedMesh& mesh = surface.mesh();
  const auto& spread = mesh.regions().spread(leaf);
  std::array<Eigen::Vector3d, 3> rest;
  std::array<Eigen::Vector3d, 3> now;
  for (std::size_t i = 0; i < 3; ++i) {
    rest[i] = mesh.rest()[spread[i]];
    now[i] = surface.position(spread[i]);
  }
  LeafMotion motion;
  motion.turn = frame_along(now) * frame_along(rest).transpose();
  if (!is_rotation(motion.turn)) return {};
  motion.shift = now[0] - motion.turn * rest[0];
  Box off;
  const auto add = [&](std::uint32_t vertex) {
    const Eigen::Vector3d at = surface.position(vertex) - motion.turn * mesh.rest()[vertex] - motion.shift;
    off.min = off.min.cwiseMin(at);
    off.max = off.max.cwiseMax(at);
  };
  for (const std::uint32_t vertex : mesh.regions().vertices(leaf)) add(vertex);
  for (const std::uint32_t vertex : mesh.regions().border(leaf)) add(vertex);
  motion.shift += (off.min + off.max) / 2;
  const double size = 2 * greatest(rest_box) + motion.shift.cwiseAbs().maxCoeff() + greatest(off);
  motion.off = (off.max - off.min).norm() / 2 * (1 + of_rounding) + size * of_rounding;
  return motion;
}

// Let p be a point of a, and q one of b, at least `gap` apart at rest. Their images under the motion of a are
// as far apart. The image of q under the motion of b is elsewhere, by the parting of both motions at q. Both
// points are off their images by what the leaves are off.
//
// The parting is greatest at a corner of a box that holds q. Where the turns differ by no more than 1/2, only
// the part of b's box counts that is within the gap of a's box. Let q be beyond that part, and q' the point
// of the part that is closest to it. Along one axis q is at least |q − q'| / √3 further from a's box than the
// gap. So p and q are that much more than the gap apart at rest, and the parting at q is at most |q − q'| / 2
// more than that at q'.
double approach_since_rest(const LeafMotion& a, const Box& rest_box_a, const LeafMotion& b,
                           const Box& rest_box_b, double gap) {
  const double off = a.off + b.off;
  if (!(off < std::numeric_limits<double>::infinity())) return off;
  Box part = common(rest_box_b, grown(rest_box_a, gap));
  // 0.24 is the square of 1/2, with room for rounding.
  if (part.empty() || !((b.turn - a.turn).squaredNorm() <= 0.24)) part = rest_box_b;
  return off * (1 + of_rounding) + parting(a, b, part);
}

}  // namespace graze
