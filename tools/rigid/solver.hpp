#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "rigid/contact.hpp"

namespace graze::rigid {

struct SolverSettings {
  Eigen::Vector3d gravity = {0, 0, -9.81};  ///< m/s²
  int substeps = 10;                        ///< of each step. Contacts are found once for all of them
  int passes = 2;                           ///< over the contacts in each substep
  double gap = 0.001;         ///< m, how far surfaces stay apart, less than the contact distance
  double friction = 0.5;      ///< the coefficient of Coulomb's friction
  double recovery_speed = 1;  ///< m/s, how fast what is nearer than the gap is pushed out at most
};

/// Moves rigid bodies by impulses at their contacts, in many small substeps with few passes over the contacts
/// each. The points of a contact are carried along by their bodies, so each substep knows the separation
/// without another search. See Macklin, Storey, Lu, Terdiman, Chentanez, Jeschke and Müller, Small Steps in
/// Physics Simulation, 2019, and Catto, Solver2D, 2024.
///
/// Nothing bounces, and nothing but contacts and friction slows a body down.
class Solver {
 public:
  explicit Solver(const SolverSettings& settings = {}) : settings_(settings) {}

  /// Finds contacts, and moves all bodies by a time step in seconds.
  void step(std::vector<Body>& bodies, ContactSource& source, double time_step);

  /// Returns the contacts of the last step, as they were found at its beginning.
  [[nodiscard]] const std::vector<Contact>& contacts() const { return contacts_; }

 private:
  /// The impulses on b of a contact in the last substep, in kg m/s.
  struct Impulse {
    double pressure = 0;  ///< along the push, never below 0
    Eigen::Vector3d drag = Eigen::Vector3d::Zero();
  };
  /// A contact whose two points are carried along by their bodies.
  struct Constraint {
    Body* a = nullptr;
    Body* b = nullptr;
    Eigen::Vector3d push = Eigen::Vector3d::Zero();
    Eigen::Vector3d own_a = Eigen::Vector3d::Zero();  ///< the point of a in the coordinates of a
    Eigen::Vector3d own_b = Eigen::Vector3d::Zero();  ///< the point of b in the coordinates of b
    double offset = 0;  ///< m, the separation less what the two points are apart along the push
    Impulse impulse;

    [[nodiscard]] double separation() const;
    [[nodiscard]] Eigen::Vector3d relative_velocity() const;
    /// How far an impulse along a direction of length 1 speeds the points apart, in 1/kg.
    [[nodiscard]] double yielding(const Eigen::Vector3d& along) const;
    void apply(const Eigen::Vector3d& impulse_on_b) const;
  };

  void prepare(std::vector<Body>& bodies);
  void substep(std::vector<Body>& bodies, double time_step);
  void solve(double time_step, bool pushes_out);
  void solve_pressure(Constraint& constraint, double time_step, bool pushes_out) const;
  void solve_drag(Constraint& constraint) const;

  SolverSettings settings_;
  std::vector<Contact> contacts_;
  std::vector<Contact> last_contacts_;
  std::vector<Constraint> constraints_;  ///< one for each contact
  std::vector<Impulse> last_impulses_;
};

}  // namespace graze::rigid
