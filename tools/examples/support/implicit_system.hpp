#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <vector>

#include "examples/support/body.hpp"

namespace examples {

/// A part of a potential that depends on the distance of two points. Vertices carry both: the difference of
/// the points is the sum of weight × position, with negative weights for the first point.
struct DistanceTerm {
  DistanceTerm(const Eigen::Vector3d& unit, double first_derivative, double second_derivative)
      : direction(unit), slope(first_derivative), curvature(second_derivative) {}

  int count = 0;  ///< of vertices
  std::array<std::size_t, 8> vertex{};
  std::array<double, 8> weight{};
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< from the first point to the second, of length 1
  double slope = 0;                                     ///< of the potential by the distance, in N
  double curvature = 0;                                 ///< its second derivative, at least 0, in N/m
  double sideways = 0;  ///< stiffness across the direction, at least 0, in N/m

  /// Lets a vertex carry the difference with a weight.
  void add(std::size_t carrier, double carried);
  /// Lets the vertices of a point carry the difference with their weights, times a sign. The body's vertices
  /// begin at `first`.
  void add(const graze::SurfaceWeights& point, double sign, std::size_t first);
};

/// An object of a scene whose vertices are in a list with those of others.
struct Object {
  std::shared_ptr<const graze::Mesh> mesh;
  graze::ObjectId id;
  std::size_t first = 0;  ///< of its vertices in the list of all

  [[nodiscard]] std::span<const Eigen::Vector3d> of(const Points& all) const {
    return std::span(all).subspan(first, mesh->vertex_count());
  }
};

/// Bodies that move by implicit Euler. Each time step minimises an incremental potential: inertia and
/// springs, and what the program adds. See Li and others, Incremental Potential Contact, 2020.
struct ImplicitSystem {
  double time_step = 0;                               ///< in s
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< in m/s²
  Points positions;  ///< of the vertices of all bodies, one body after the other
  Points previous;   ///< positions at the beginning of the step
  Points targets;    ///< where vertices would go without springs and contacts
  Points velocities;
  std::vector<double> inverse_masses;  ///< 0 holds a vertex
  std::vector<Spring> springs;

  /// Appends the vertices and springs of a body.
  void add(const Body& body);
  /// Begins a time step. The program then brings `positions` to a minimum of the potential.
  void begin_step();
  /// Ends a time step: computes velocities.
  void end_step();

  /// Returns the incremental potential of inertia and springs at given positions, in J.
  [[nodiscard]] double potential(const Points& at) const;
  /// Returns the energy of motion, gravity and springs now, in J.
  [[nodiscard]] double energy() const;
  /// Returns a term for each spring, at the positions of now.
  [[nodiscard]] std::vector<DistanceTerm> spring_terms() const;
  /// Returns a step of Newton's method from the positions of now, for inertia and all terms. It is solved by
  /// conjugate gradients. The potential falls along it, at least at first.
  [[nodiscard]] Points newton_step(const std::vector<DistanceTerm>& terms) const;
};

/// Holds each vertex at the border of a body's surface: where an edge has one face.
void hold_border(Body& body);

/// The barrier of Incremental Potential Contact, with its first and second derivative by the distance. It is
/// 0 from a distance on, and infinite at distance 0.
struct Barrier {
  double value = 0;
  double slope = 0;
  double curvature = 0;

  /// Computes it for a distance above 0. It begins at the distance `d_hat`, and has a stiffness in N/m.
  Barrier(double distance, double d_hat, double stiffness);
};

/// Returns positions that have gone along a step, times a factor.
Points moved_along(const Points& positions, double factor, const Points& step);

/// Returns the largest length of any of the vectors.
double longest(const Points& vectors);

/// Returns the largest distance between two vectors of the same index.
double largest_motion(const Points& from, const Points& to);

}  // namespace examples
