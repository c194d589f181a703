#include "walk/last_witness.hpp"

#include <algorithm>
#include <limits>

#include "closest_features/closest_features.hpp"
#include "pair/bounds.hpp"

namespace graze {
namespace {

/// From 0 to 1, and 0 for NaN.
double clamped_share(double share) {
  return share > 0 ? std::min(share, 1.0) : 0;
}

SurfacePoint surface_point(const Surface& surface, const FeaturePiece& piece, const Eigen::Vector3d& point) {
  const Simplex simplex = simplex_of(surface, piece);
  SurfacePoint on;
  on.size = simplex.size;
  on.corner = simplex.vertex;
  if (simplex.size == 1) return on;
  const Eigen::Vector3d way = point - simplex.point[0];
  const Eigen::Vector3d u = simplex.point[1] - simplex.point[0];
  const double uu = u.squaredNorm();
  const double along_u = way.dot(u);
  double share_u = along_u / uu;
  double share_v = 0;
  if (simplex.size == 3) {
    const Eigen::Vector3d v = simplex.point[2] - simplex.point[0];
    const double vv = v.squaredNorm();
    const double uv = u.dot(v);
    const double along_v = way.dot(v);
    const double area = uu * vv - uv * uv;
    share_u = (vv * along_u - uv * along_v) / area;
    share_v = (uu * along_v - uv * along_u) / area;
  }
  share_u = clamped_share(share_u);
  share_v = std::min(clamped_share(share_v), 1 - share_u);
  on.share = {static_cast<float>(share_u), static_cast<float>(share_v)};
  return on;
}

/// The way from a point's first corner to it now, and how far the other corners are. Its rounding and that of
/// the shares are relative to the latter.
struct Offset {
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  double size = 0;
};

Offset offset_now(const Surface& surface, const SurfacePoint& on) {
  Offset offset;
  for (std::uint32_t i = 1; i < on.size; ++i) {
    const Eigen::Vector3d side = surface.position(on.corner[i]) - surface.position(on.corner[0]);
    offset.way += side * static_cast<double>(on.share[i - 1]);
    offset.size += side.cwiseAbs().sum();
  }
  return offset;
}

}  // namespace

LastWitness last_witness_of(const SurfacePair& pair, const FeaturePairKey& nearest,
                            const Eigen::Vector3d& point_a, const Eigen::Vector3d& point_b) {
  return {surface_point(pair.a, nearest.a(), point_a), surface_point(pair.b, nearest.b(), point_b)};
}

double upper_distance(const SurfacePair& pair, const LastWitness& witness, bool vertices_only) {
  const bool are_vertices = witness.on_a.size == 1 && witness.on_b.size == 1;
  if (!witness.is_known() || (vertices_only && !are_vertices)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d between =
      pair.b.position(witness.on_b.corner[0]) - pair.a.position(witness.on_a.corner[0]);
  const Offset offset_a = offset_now(pair.a, witness.on_a);
  const Offset offset_b = offset_now(pair.b, witness.on_b);
  // The shares of a triangle may be 2^-23 more than 1 in all.
  const double slack = between.cwiseAbs().sum() * 0x1p-50 + (offset_a.size + offset_b.size) * 0x1p-22;
  return upper_distance(offset_a.way, between + offset_b.way) + slack;
}

}  // namespace graze
