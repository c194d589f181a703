#include "surface/leaf_motion.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

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

}  // namespace

LeafMotion motion_of_leaf(const Surface& surface, const Region& leaf) {
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
  motion.middle = rest[0];
  motion.shift = (now[0] + now[1] + now[2]) / 3 - motion.turn * ((rest[0] + rest[1] + rest[2]) / 3);
  double off = 0;
  double radius = 0;
  double size = 0;
  const auto add = [&](std::uint32_t vertex) {
    const Eigen::Vector3d& at_rest = mesh.rest()[vertex];
    const Eigen::Vector3d at = surface.position(vertex);
    off = std::max(off, (at - motion.turn * at_rest - motion.shift).squaredNorm());
    radius = std::max(radius, (at_rest - motion.middle).squaredNorm());
    size = std::max({size, at.cwiseAbs().maxCoeff(), at_rest.cwiseAbs().maxCoeff()});
  };
  for (const std::uint32_t vertex : mesh.regions().vertices(leaf)) add(vertex);
  for (const std::uint32_t vertex : mesh.regions().border(leaf)) add(vertex);
  motion.off = std::sqrt(off) * (1 + of_rounding) + size * of_rounding;
  motion.radius = std::sqrt(radius) * (1 + of_rounding);
  return motion;
}

// Let p be a point of a, and q one of b at rest. At rest they are |p − q| apart, and so are their images
// under the motion of a. The image of q under the motion of b is elsewhere by (turn_b − turn_a) q + shift_b −
// shift_a. That is what it is at b's middle, and not more than the difference of the turns times b's radius
// beside it.
double approach_since_rest(const LeafMotion& a, const LeafMotion& b) {
  const double off = a.off + b.off;
  if (!(off < std::numeric_limits<double>::infinity())) return off;
  const Eigen::Matrix3d turn = b.turn - a.turn;
  const Eigen::Vector3d at_middle = turn * b.middle + (b.shift - a.shift);
  const double size = b.middle.cwiseAbs().maxCoeff() + b.shift.cwiseAbs().maxCoeff() +
                      a.shift.cwiseAbs().maxCoeff() + b.radius;
  return (off + at_middle.norm() + turn.norm() * b.radius) * (1 + of_rounding) + size * of_rounding;
}

}  // namespace graze
