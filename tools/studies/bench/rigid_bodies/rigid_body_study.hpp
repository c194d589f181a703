#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "bench/peer_module.hpp"
#include "bench/rigid_bodies/bodies_through.hpp"
#include "bench/rigid_bodies/rigid_body_measures.hpp"
#include "bench/rigid_bodies/rigid_body_scenes.hpp"
#include "bench/rigid_bodies/rigid_body_sources.hpp"
#include "figures/result_table.hpp"
#include "rigid/solver.hpp"

namespace graze::bench {

/// Describes how a scene went with one source of contacts.
struct RigidBodyFigures {
  std::size_t standing = 0;      ///< bodies at the height at which they were put, at the end
  double height_error = 0;       ///< mm, the largest of these bodies, at the end
  std::size_t through = 0;       ///< pairs deep inside each other, at the end
  std::size_t most_through = 0;  ///< in a step that was looked at
  std::size_t silent = 0;        ///< pairs that cross and that no contact pushes, the most in such a step
  double speed = 0;              ///< mm/s, of bodies in the last second, median
  double jumps = 0;              ///< share of contacts of the last second that come out of nothing
  double contacts = 0;           ///< of a step, median
  double find_ms = 0;            ///< to find them, median of the steps
  double step_ms = 0;            ///< with the solver, median of the steps
};

/// One play of a scene on one thread.
class RigidBodyRun {
 public:
  RigidBodyRun(const RigidBodyScene& scene, rigid::ContactSource& source);

  void step();
  [[nodiscard]] RigidBodyFigures figures();

 private:
  /// Looks for overlaps where the bodies are, and for contacts found there that push.
  void look(std::span<const rigid::Body> bodies);

  const RigidBodyScene& scene_;
  rigid::ContactSource& source_;
  std::vector<rigid::Body> bodies_;
  rigid::Solver solver_;
  BodiesThrough referee_;
  ContactJumps jumps_;
  RigidBodyFigures figures_;
  std::size_t steps_ = 0;
  std::vector<double> speeds_;  ///< of each step, as what follows
  std::vector<double> contacts_;
  std::vector<double> find_ms_;
  std::vector<double> step_ms_;
};

/// Plays scenes with all sources of contacts, step by step in turn.
tools::ResultTable compare_rigid_bodies(const PeerModule& module, bool is_quick);

}  // namespace graze::bench
