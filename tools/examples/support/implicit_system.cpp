#include "examples/support/implicit_system.hpp"

#include <algorithm>
#include <cmath>

namespace examples {
namespace {

/// Returns the stiffness matrix of all terms, times a step of each vertex.
void add_product(const std::vector<DistanceTerm>& terms, const Points& steps, Points& product) {
  for (const DistanceTerm& term : terms) {
    Eigen::Vector3d step = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(term.count); ++i)
      step += term.weight[i] * steps[term.vertex[i]];
    const Eigen::Vector3d force =
        term.sideways * step + (term.curvature - term.sideways) * term.direction.dot(step) * term.direction;
    for (std::size_t i = 0; i < static_cast<std::size_t>(term.count); ++i)
      product[term.vertex[i]] += term.weight[i] * force;
  }
}

double spring_energy(const std::vector<Spring>& springs, const Points& positions) {
  double sum = 0;
  for (const Spring& spring : springs) {
    const double stretch = (positions[spring.b] - positions[spring.a]).norm() - spring.rest_length;
    sum += stretch * stretch / (2 * spring.compliance);
  }
  return sum;
}

double dot(const Points& a, const Points& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

void add_scaled(Points& sum, double factor, const Points& added) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * added[i];
}

}  // namespace

void DistanceTerm::add(std::size_t carrier, double carried) {
  vertex[static_cast<std::size_t>(count)] = carrier;
  weight[static_cast<std::size_t>(count)] = carried;
  ++count;
}

void DistanceTerm::add(const graze::SurfaceWeights& point, double sign, std::size_t first) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(point.count); ++i)
    add(first + point.vertex[i], sign * point.weight[i]);
}

void ImplicitSystem::add(const Body& body) {
  const auto first = static_cast<std::uint32_t>(positions.size());
  for (const Spring& spring : body.springs)
    springs.push_back({first + spring.a, first + spring.b, spring.rest_length, spring.compliance});
  positions.insert(positions.end(), body.positions.begin(), body.positions.end());
  velocities.insert(velocities.end(), body.velocities.begin(), body.velocities.end());
  inverse_masses.insert(inverse_masses.end(), body.inverse_masses.begin(), body.inverse_masses.end());
}

void ImplicitSystem::begin_step() {
  previous = positions;
  targets = positions;
  for (std::size_t i = 0; i < positions.size(); ++i)
    targets[i] += time_step * (velocities[i] + time_step * gravity);
}

void ImplicitSystem::end_step() {
  for (std::size_t i = 0; i < positions.size(); ++i) velocities[i] = (positions[i] - previous[i]) / time_step;
}

double ImplicitSystem::potential(const Points& at) const {
  double sum = spring_energy(springs, at);
  for (std::size_t i = 0; i < at.size(); ++i)
    if (inverse_masses[i] > 0)
      sum += (at[i] - targets[i]).squaredNorm() / (2 * time_step * time_step * inverse_masses[i]);
  return sum;
}

double ImplicitSystem::energy() const {
  double sum = spring_energy(springs, positions);
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (inverse_masses[i] > 0)
      sum += (velocities[i].squaredNorm() / 2 - gravity.dot(positions[i])) / inverse_masses[i];
  return sum;
}

std::vector<DistanceTerm> ImplicitSystem::spring_terms() const {
  std::vector<DistanceTerm> terms;
  for (const Spring& spring : springs) {
    const Eigen::Vector3d apart = positions[spring.b] - positions[spring.a];
    const double length = apart.norm();
    const double slope = (length - spring.rest_length) / spring.compliance;
    DistanceTerm& term = terms.emplace_back(apart / length, slope, 1 / spring.compliance);
    term.add(spring.a, -1);
    term.add(spring.b, 1);
    term.sideways = std::max(0.0, slope / length);
  }
  return terms;
}

Points ImplicitSystem::newton_step(const std::vector<DistanceTerm>& terms) const {
  const std::size_t count = positions.size();
  std::vector<double> inertia(count, 0);   // of each vertex, in N/m
  std::vector<double> diagonal(count, 0);  // about the stiffness of each vertex
  Points residual(count, Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < count; ++i)
    if (inverse_masses[i] > 0) {
      inertia[i] = 1 / (time_step * time_step * inverse_masses[i]);
      diagonal[i] = inertia[i];
      residual[i] = inertia[i] * (targets[i] - positions[i]);
    }
  for (const DistanceTerm& term : terms)
    for (std::size_t i = 0; i < static_cast<std::size_t>(term.count); ++i) {
      residual[term.vertex[i]] -= term.weight[i] * term.slope * term.direction;
      diagonal[term.vertex[i]] += term.weight[i] * term.weight[i] * (term.curvature + 2 * term.sideways) / 3;
    }
  // Held vertices have no share in anything.
  const auto preconditioned = [&](Points forces) {
    for (std::size_t i = 0; i < count; ++i) forces[i] *= inverse_masses[i] > 0 ? 1 / diagonal[i] : 0;
    return forces;
  };

  Points step(count, Eigen::Vector3d::Zero());
  Points scaled = preconditioned(residual);
  Points way = scaled;
  Points product(count);
  double size = dot(residual, scaled);
  const double wanted = 1e-4 * size;
  for (int i = 0; i < 100 && size > wanted; ++i) {
    for (std::size_t k = 0; k < count; ++k) product[k] = inertia[k] * way[k];
    add_product(terms, way, product);
    const double length = size / dot(way, product);
    add_scaled(step, length, way);
    add_scaled(residual, -length, product);
    scaled = preconditioned(residual);
    const double before = size;
    size = dot(residual, scaled);
    for (std::size_t k = 0; k < count; ++k) way[k] = scaled[k] + size / before * way[k];
  }
  return step;
}

void hold_border(Body& body) {
  for (std::uint32_t edge = 0; edge < body.mesh->edge_count(); ++edge)
    if (body.mesh->edge_faces(edge).size() == 1)
      for (const std::uint32_t vertex : body.mesh->edge(edge)) body.inverse_masses[vertex] = 0;
}

Barrier::Barrier(double distance, double d_hat, double stiffness) {
  if (distance >= d_hat) return;
  const double over = distance - d_hat;
  const double logarithm = std::log(distance / d_hat);
  value = -stiffness * over * over * logarithm;
  slope = -stiffness * over * (2 * logarithm + over / distance);
  curvature = -stiffness * (2 * logarithm + 4 * over / distance - over * over / (distance * distance));
}

Points moved_along(const Points& positions, double factor, const Points& step) {
  Points moved = positions;
  add_scaled(moved, factor, step);
  return moved;
}

double longest(const Points& vectors) {
  double squared = 0;
  for (const Eigen::Vector3d& vector : vectors) squared = std::max(squared, vector.squaredNorm());
  return std::sqrt(squared);
}

double largest_motion(const Points& from, const Points& to) {
  return longest(moved_along(to, -1, from));
}

}  // namespace examples
