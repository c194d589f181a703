#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "springs/spring_network.hpp"

namespace graze::springs {

/// x, y, z of a vertex in each row.
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Masses joined by springs, moved by implicit Euler.
///
/// Explicit schemes blow up once a step is longer than a spring's own period allows. Implicit Euler does not
/// (Baraff and Witkin, Large Steps in Cloth Simulation, 1998). But each step solves a linear system with
/// another matrix, which has to be kept positive where springs are pressed together.
///
/// The system is solved as Liu, Bargteil, O'Brien and Kavan do (Fast Simulation of Mass-Spring Systems,
/// 2013). A step is the minimum of (1/2h²)‖x − y‖²_M + E(x), where y is where inertia and outer forces lead.
/// With a direction d for each spring, E is quadratic in x. The minima over x and over d are found in turn.
/// The best d is the spring's present direction. The best x solves M + h²L, which never changes and is
/// factorized once.
///
/// Each half lowers the same bounded sum, whatever the step and the stiffness, so nothing can blow up. Energy
/// is lost, as in implicit Euler, and not won. Springs pull both ends alike, so the rows of L sum to zero.
/// Momentum is therefore kept in every iteration, not at convergence only.
///
/// The motion is the same in every run: the number of iterations is fixed, and nothing is random.
class MassSpringBody {
 public:
  static constexpr int default_iterations = 12;

  /// Every vertex has this mass. `step` is h.
  MassSpringBody(const Points& positions, std::vector<Spring> springs, double vertex_mass, double step,
                 int iterations = default_iterations);

  [[nodiscard]] const Points& positions() const { return positions_; }
  [[nodiscard]] const Points& velocities() const { return velocities_; }
  /// Sets the velocities, which must have as many rows as positions().
  void set_velocities(const Points& velocities) { velocities_ = velocities; }
  void set_positions(const Points& positions) { positions_ = positions; }

  /// One step under a force on each vertex, none where there are no rows.
  void step(const Points& forces = {});

  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double elastic_energy() const { return elastic_energy_at(positions_); }
  [[nodiscard]] Eigen::RowVector3d momentum() const;

 private:
  [[nodiscard]] double elastic_energy_at(const Points& at) const;
  [[nodiscard]] double sum_at_start(const Points& inertia) const;
  [[nodiscard]] Points pulls(const Points& at) const;

  std::vector<Spring> springs_;
  double mass_;
  double step_;
  int iterations_;
  Points positions_;
  Points velocities_;
  std::unique_ptr<Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>> solver_;  ///< of M + h²L
};

}  // namespace graze::springs
