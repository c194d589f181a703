#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "rigid/contact.hpp"

namespace graze::rigid {

struct SolverSettings {
  Eigen::Vector3d gravity = {0, 0, -9.81};  ///< m/s²
  int substeps = 10;                        ///< of each step. Contacts are found once for all of them
  double gap = 0.001;         ///< m, how far surfaces stay apart; less than the contact distance
  double friction = 0.5;      ///< the coefficient of Coulomb's friction
  double recovery_speed = 1;  ///< m/s, how fast what is nearer than the gap is pushed out at most
};

/// Moves rigid bodies by constraints on their positions, with one pass over the contacts in each of many
/// small substeps. See Müller, Macklin, Chentanez, Jeschke and Kim, Detailed Rigid Body Simulation with
/// Extended Position Based Dynamics, 2020. Nothing bounces, and nothing but friction slows a body down.
class Solver {
 public:
  explicit Solver(const SolverSettings& settings = {}) : settings_(settings) {}

  /// Finds contacts, and moves all bodies by a time step in seconds.
  void step(std::vector<Body>& bodies, ContactSource& source, double time_step);

  /// Returns the contacts of the last step, as they were found at its beginning.
  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  /// A contact whose two points are carried along by their bodies.
  struct Constraint {
    Body* a = nullptr;
    Body* b = nullptr;
    Eigen::Vector3d push;
    Eigen::Vector3d own_a;         ///< the point of a in the coordinates of a
    Eigen::Vector3d own_b;         ///< the point of b in the coordinates of b
    double offset = 0;             ///< m, the separation less what the two points are apart along the push
    Eigen::Vector3d apart_before;  ///< from the point of a to that of b, before the substep
    double opening = 0;            ///< m/s along the push, before contacts are solved
    double pressure = 0;           ///< kg m, the impulse of positions along the push in the substep

    [[nodiscard]] Eigen::Vector3d arm_a() const { return a->turn * own_a; }
    [[nodiscard]] Eigen::Vector3d arm_b() const { return b->turn * own_b; }
    [[nodiscard]] Eigen::Vector3d apart() const;
    [[nodiscard]] double opening_speed() const;
    [[nodiscard]] double yielding(const Eigen::Vector3d& along) const;
    void shift(const Eigen::Vector3d& impulse) const;
  };
  struct Place {
    Eigen::Vector3d position;
    Eigen::Quaterniond turn;
  };

  void prepare(std::vector<Body>& bodies);
  void substep(std::vector<Body>& bodies, double time_step);
  void predict(std::vector<Body>& bodies, double time_step);
  void solve_separation(Constraint& constraint, double time_step) const;
  void solve_friction(const Constraint& constraint) const;
  void update_velocities(std::vector<Body>& bodies, double time_step) const;

  SolverSettings settings_;
  std::vector<Contact> contacts_;
  std::vector<Constraint> constraints_;
  std::vector<Place> places_;  ///< where the bodies were before the substep
};

}  // namespace graze::rigid
