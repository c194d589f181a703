#include "rigid/body.hpp"

#include <cstddef>
#include <span>

namespace graze::rigid {

MassProperties mass_of(const Mesh& mesh, double density) {
  // The volume is a sum of tetrahedra from the origin to each triangle, with a sign. Each has the second
  // moments V/20 (Σ c cᵀ + s sᵀ) with its corners c other than the origin and their sum s.
  double volume = 0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  for (std::uint32_t index = 0; index < mesh.face_count(); ++index) {
    const std::span<const std::uint32_t> face = mesh.face(index);
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      Eigen::Matrix3d corners;
      corners << mesh.rest()[face[0]], mesh.rest()[face[i]], mesh.rest()[face[i + 1]];
      const double part = corners.determinant() / 6;
      const Eigen::Vector3d sum = corners.rowwise().sum();
      volume += part;
      first += part / 4 * sum;
      second += part / 20 * (corners * corners.transpose() + sum * sum.transpose());
    }
  }
  const Eigen::Vector3d centre = first / volume;
  second -= volume * centre * centre.transpose();
  return {density * volume, centre, density * (second.trace() * Eigen::Matrix3d::Identity() - second)};
}

void Body::set_mass(const MassProperties& properties) {
  inverse_mass = 1 / properties.mass;
  inverse_inertia = properties.inertia.inverse();
}

Eigen::Isometry3d Body::pose() const {
  return Eigen::Translation3d(position) * turn;
}

void Body::set_pose(const Eigen::Isometry3d& pose) {
  position = pose.translation();
  turn = Eigen::Quaterniond(pose.linear()).normalized();
}

Eigen::Vector3d Body::to_world(const Eigen::Vector3d& point) const {
  return position + turn * point;
}

Eigen::Vector3d Body::to_own(const Eigen::Vector3d& point) const {
  return turn.conjugate() * (point - position);
}

Eigen::Vector3d Body::velocity_at(const Eigen::Vector3d& arm) const {
  return velocity + spin.cross(arm);
}

Eigen::Vector3d Body::inertia_solved(const Eigen::Vector3d& torque) const {
  return turn * (inverse_inertia * (turn.conjugate() * torque));
}

double Body::yielding(const Eigen::Vector3d& arm, const Eigen::Vector3d& along) const {
  const Eigen::Vector3d torque = arm.cross(along);
  return inverse_mass + torque.dot(inertia_solved(torque));
}

void Body::shift(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm) {
  position += inverse_mass * impulse;
  rotate(inertia_solved(arm.cross(impulse)));
}

void Body::push(const Eigen::Vector3d& impulse, const Eigen::Vector3d& arm) {
  velocity += inverse_mass * impulse;
  spin += inertia_solved(arm.cross(impulse));
}

void Body::rotate(const Eigen::Vector3d& rotation) {
  const Eigen::Quaterniond change(0, rotation.x() / 2, rotation.y() / 2, rotation.z() / 2);
  turn.coeffs() += (change * turn).coeffs();
  turn.normalize();
}

}  // namespace graze::rigid
