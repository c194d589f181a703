#include <algorithm>
#include <cmath>

#include "models/models.hpp"
#include "models/surface_net.hpp"

namespace graze::models {

namespace {

using Eigen::Vector3d;

double torso(const Vector3d& p) {
  double body = ellipsoid(p, {0, 0.01, 0.48}, {0.19, 0.12, 0.20});
  body = blended(body, ellipsoid(p, {0, 0.005, 0.27}, {0.135, 0.097, 0.19}), 0.09);
  body = blended(body, ellipsoid(p, {0, 0.01, 0.06}, {0.175, 0.12, 0.14}), 0.09);
  body = blended(body, limb(p, {0.07, -0.05, 0.51}, 0.07, {0.11, -0.04, 0.55}, 0.06), 0.06);
  body = blended(body, limb(p, {0.02, 0.03, 0.69}, 0.055, {0.19, 0.015, 0.59}, 0.062), 0.07);
  return blended(body, limb(p, {0.07, 0.065, 0.05}, 0.08, {0.075, 0.055, 0.0}, 0.08), 0.06);
}

double head(const Vector3d& p) {
  double body = ellipsoid(p, {0, 0.005, 0.885}, {0.090, 0.108, 0.118});
  body = blended(body, limb(p, {0, -0.062, 0.805}, 0.038, {0, -0.03, 0.84}, 0.062), 0.05);
  body = blended(body, limb(p, {0, -0.106, 0.895}, 0.013, {0, -0.122, 0.862}, 0.021), 0.03);
  const double neck = limb(p, {0, 0.025, 0.66}, 0.066, {0, 0.015, 0.79}, 0.052);
  return blended(body, neck, 0.04);
}

double arm(const Vector3d& p) {
  double body = limb(p, {0.205, 0.012, 0.585}, 0.070, {0.26, 0.015, 0.47}, 0.062);
  body = blended(body, limb(p, {0.26, 0.015, 0.47}, 0.060, {0.35, 0.025, 0.29}, 0.050), 0.05);
  body = blended(body, limb(p, {0.355, 0.02, 0.27}, 0.054, {0.385, 0.006, 0.20}, 0.052), 0.05);
  body = blended(body, limb(p, {0.38, 0.01, 0.22}, 0.050, {0.455, -0.045, 0.03}, 0.037), 0.04);
  body = blended(body, ellipsoid(p, {0.480, -0.065, -0.055}, {0.038, 0.052, 0.10}), 0.04);
  return blended(body, limb(p, {0.468, -0.095, -0.01}, 0.026, {0.455, -0.145, -0.075}, 0.021), 0.025);
}

double leg(const Vector3d& p) {
  double body = limb(p, {0.095, 0.005, 0.0}, 0.105, {0.118, -0.012, -0.43}, 0.058);
  body = blended(body, limb(p, {0.118, -0.012, -0.44}, 0.060, {0.138, 0.02, -0.88}, 0.042), 0.05);
  body = blended(body, ellipsoid(p, {0.126, 0.026, -0.60}, {0.066, 0.068, 0.15}), 0.06);
  double foot = limb(p, {0.138, 0.035, -0.945}, 0.052, {0.154, -0.085, -0.965}, 0.052);
  foot = blended(foot, limb(p, {0.152, -0.08, -0.97}, 0.050, {0.164, -0.155, -0.975}, 0.040), 0.03);
  body = blended(body, foot, 0.05);
  return carved(body, p.z() + 1.0, 0.015);
}

/// Standing with the arms a little out, 2 high. Left and right are the same.
double figure(const Vector3d& point) {
  const Vector3d p(std::abs(point.x()), point.y(), point.z());
  double body = blended(torso(p), head(p), 0.05);
  body = blended(body, arm(p), 0.035);
  return blended(body, leg(p), 0.03);
}

/// Finer at head, hands and feet, coarser on the trunk.
double edge_length(const Vector3d& point) {
  const Vector3d p(std::abs(point.x()), point.y(), point.z());
  const double from_trunk = limb(p, {0, 0, 0.55}, 0.1, {0, 0, 0.1}, 0.1);
  const double from_head = (p - Vector3d(0, -0.03, 0.87)).norm();
  const double from_hand = (p - Vector3d(0.47, -0.08, -0.04)).norm();
  const double from_foot = (p - Vector3d(0.15, -0.06, -0.96)).norm();
  const double detail = std::min({from_head / 0.28, from_hand / 0.25, from_foot / 0.25});
  return std::clamp(detail, 0.65, 1.0) * (from_trunk < 0.05 ? 1.25 : 1.0);
}

}  // namespace

MeshData human() {
  const TriangleMesh fine = surface_net(figure, {0.62, 0.32, 1.07}, 0.016);
  const TriangleMesh mesh = thinned(fine, figure, edge_length, 946);
  MeshData result;
  result.positions = mesh.positions;
  for (const auto& triangle : mesh.triangles) result.add_face({triangle[0], triangle[1], triangle[2]});
  return result;
}

}  // namespace graze::models
