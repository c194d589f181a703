#include "examples/support/projectile.hpp"

#include <algorithm>

namespace examples {
namespace {

constexpr double bounce = 0.3;  // of the speed that is left after an impact
constexpr int passes = 8;       // over all contacts

/// Returns a vector whose entries are at most so large.
Eigen::Vector3d random_vector(double most, std::mt19937& random) {
  Eigen::Vector3d vector;
  for (double& entry : vector) entry = most * (static_cast<double>(random()) / 2147483648.0 - 1);
  return vector;
}

}  // namespace

Eigen::Isometry3d Projectile::after(double time) const {
  const Eigen::AngleAxisd turn(spin.norm() * time, spin.normalized());
  Eigen::Isometry3d moved(turn * pose.linear());
  moved.translation() = pose.translation() + time * velocity;
  return moved;
}

std::shared_ptr<const graze::Mesh> mesh_of(const Shape& shape) {
  return std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
}

void respond(Projectile& body, const graze::FrameReport& report, double skin, double time) {
  for (int pass = 0; pass < passes; ++pass)
    for (const graze::Contact& contact : report.contacts()) {
      if (contact.kind == graze::ContactKind::EF) continue;
      const Eigen::Vector3d push = contact.push();
      const Eigen::Vector3d lever = (contact.point_b - body.pose.translation()).cross(push);
      const double closing = -push.dot(body.velocity) - lever.dot(body.spin);
      if (closing * time <= std::max(0.0, contact.separation() - skin)) continue;
      const double impulse = (1 + bounce) * closing / (1 + lever.squaredNorm() / body.inertia);
      body.velocity += impulse * push;
      body.spin += impulse / body.inertia * lever;
    }
}

Projectile random_shot(double speed, double radius, double inertia, std::mt19937& random) {
  Projectile body;
  const Eigen::Vector3d start = Eigen::Vector3d(0, 0, 1) + random_vector(0.3, random);
  const Eigen::Vector3d turn = random_vector(3, random);
  body.pose = Eigen::Translation3d(start) * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  body.velocity = speed * (random_vector(0.3, random) - Eigen::Vector3d(0, 0, 1)).normalized();
  body.spin = random_vector(10, random);
  body.radius = radius;
  body.inertia = inertia;
  return body;
}

}  // namespace examples
