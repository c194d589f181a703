#include <algorithm>
#include <cmath>

#include "models/models.hpp"
#include "models/surface_net.hpp"

namespace graze::models {

namespace {

using Eigen::Vector3d;

/// A block with rounded edges about `centre`. `half` is its half size, edges included.
double block(const Vector3d& p, const Vector3d& centre, const Vector3d& half, double edge_radius) {
  const Vector3d outside = (p - centre).cwiseAbs() - (half - Vector3d::Constant(edge_radius));
  return outside.cwiseMax(0).norm() + std::min(outside.maxCoeff(), 0.0) - edge_radius;
}

/// The crown bulges above a narrower neck and carries a cusp at each corner, a pit in the middle and grooves
/// between.
double crown(const Vector3d& p) {
  const double squeeze = 1 - 0.22 * std::clamp((0.15 - p.z()) / 0.4, 0.0, 1.0);
  const Vector3d widened(p.x() / squeeze, p.y() / squeeze, p.z());
  double body = block(widened, {0, 0, 0.28}, {0.60, 0.53, 0.42}, 0.30);
  body = blended(body, ellipsoid(p, {0.30, 0.25, 0.62}, {0.25, 0.23, 0.30}), 0.10);
  body = carved(body, limb(p, {-0.8, 0, 0.92}, 0.17, {0.8, 0, 0.92}, 0.17), 0.14);
  body = carved(body, limb(p, {0, -0.8, 0.90}, 0.13, {0, 0.8, 0.90}, 0.13), 0.14);
  return carved(body, ellipsoid(p, {0, 0, 0.80}, {0.26, 0.20, 0.20}), 0.12);
}

/// Two flat roots, each with a furrow along its side.
double root(const Vector3d& p) {
  const double first = limb(p, {0.24, 0.16, -0.05}, 0.21, {0.36, 0.06, -0.90}, 0.09);
  const double bow = limb(p, {0.22, 0.0, -0.10}, 0.24, {0.36, 0.0, -0.85}, 0.12);
  return blended(first, bow, 0.10);
}

double molar(const Vector3d& point) {
  const Vector3d p(std::abs(point.x()), std::abs(point.y()), point.z());
  return blended(crown(p), root(p), 0.16);
}

double molar_edge_length(const Vector3d& p) {
  return p.z() > 0.35 ? 0.8 : 1.0;
}

}  // namespace

MeshData tooth() {
  const TriangleMesh fine = surface_net(molar, {0.8, 0.8, 1.1}, 0.05);
  const TriangleMesh mesh = thinned(fine, molar, molar_edge_length, 1202);
  MeshData result;
  result.positions = mesh.positions;
  for (const auto& triangle : mesh.triangles) result.add_face({triangle[0], triangle[1], triangle[2]});
  return result;
}

}  // namespace graze::models
