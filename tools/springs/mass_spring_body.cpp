#include "springs/mass_spring_body.hpp"

#include <stdexcept>
#include <utility>

namespace graze::springs {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// M + h²L, where L has a spring's stiffness on the diagonal of both ends, and its negative between them.
Matrix system_matrix(const std::vector<Spring>& springs, Eigen::Index count, double mass, double step) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < count; ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), mass);
  for (const Spring& spring : springs) {
    const double entry = step * step * spring.stiffness;
    const int a = static_cast<int>(spring.a);
    const int b = static_cast<int>(spring.b);
    entries.emplace_back(a, a, entry);
    entries.emplace_back(b, b, entry);
    entries.emplace_back(a, b, -entry);
    entries.emplace_back(b, a, -entry);
  }
  Matrix matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace

MassSpringBody::MassSpringBody(const Points& positions, std::vector<Spring> springs, double vertex_mass,
                               double step, int iterations)
    : springs_(std::move(springs)),
      mass_(vertex_mass),
      step_(step),
      iterations_(iterations),
      positions_(positions),
      velocities_(Points::Zero(positions.rows(), 3)) {
  if (!(vertex_mass > 0) || !(step > 0))
    throw std::invalid_argument("a mass-spring body needs a mass and a step above 0");
  solver_ = std::make_unique<Eigen::SimplicialLDLT<Matrix>>(
      system_matrix(springs_, positions.rows(), mass_, step_));
}

/// h²Jd: each spring at its rest length in its present direction, times its stiffness. Where both ends are
/// in one place there is no direction, and no pull.
Points MassSpringBody::pulls(const Points& at) const {
  Points sum = Points::Zero(at.rows(), 3);
  for (const Spring& spring : springs_) {
    const Eigen::RowVector3d along = at.row(spring.a) - at.row(spring.b);
    const double length = along.norm();
    if (!(length > 0)) continue;
    const Eigen::RowVector3d pull = (step_ * step_ * spring.stiffness * spring.rest_length / length) * along;
    sum.row(spring.a) += pull;
    sum.row(spring.b) -= pull;
  }
  return sum;
}

void MassSpringBody::step(const Points& forces) {
  Points inertia = positions_ + step_ * velocities_;
  if (forces.rows() > 0) inertia += (step_ * step_ / mass_) * forces;
  Points next = elastic_energy_at(inertia) <= sum_at_start(inertia) ? inertia : positions_;
  for (int i = 0; i < iterations_; ++i) next = solver_->solve(mass_ * inertia + pulls(next));
  velocities_ = (next - positions_) / step_;
  positions_ = std::move(next);
}

/// Returns the sum that a step minimizes, at the body's present positions. At the positions to which inertia
/// leads, this sum is the elastic energy alone.
double MassSpringBody::sum_at_start(const Points& inertia) const {
  return 0.5 * mass_ / (step_ * step_) * (positions_ - inertia).squaredNorm() + elastic_energy_at(positions_);
}

double MassSpringBody::kinetic_energy() const {
  return 0.5 * mass_ * velocities_.squaredNorm();
}

double MassSpringBody::elastic_energy_at(const Points& at) const {
  double sum = 0;
  for (const Spring& spring : springs_) {
    const double stretch = (at.row(spring.a) - at.row(spring.b)).norm() - spring.rest_length;
    sum += 0.5 * spring.stiffness * stretch * stretch;
  }
  return sum;
}

Eigen::RowVector3d MassSpringBody::momentum() const {
  return mass_ * velocities_.colwise().sum();
}

}  // namespace graze::springs
