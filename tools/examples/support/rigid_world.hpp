#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <graze/graze.hpp>
#include <vector>

#include "examples/support/convex_overlap.hpp"
#include "examples/support/shapes.hpp"
#include "rigid/graze_contacts.hpp"
#include "rigid/solver.hpp"

namespace examples {

struct RigidWorldSettings {
  double contact_distance = 0.02;  ///< m: the gap, and how far surfaces come nearer in one step
  std::size_t carrying = 8;        ///< contacts of each pair. 0 is all of them
  bool ways_out = true;
  graze::rigid::SolverSettings solver;
};

/// Convex rigid bodies that move by contacts of graze, and measures of how they stand.
class RigidWorld {
 public:
  explicit RigidWorld(const RigidWorldSettings& settings = {});

  /// Adds a body, and returns its index. The centre of mass of the shape is its origin. A density of 0, in
  /// kg/m³, is that of the ground.
  std::uint32_t add(const Shape& shape, const Eigen::Isometry3d& pose, double density,
                    const graze::ObjectSettings& object = {});

  /// Moves the bodies by a time step in seconds.
  void step(double time_step = 1.0 / 60);

  [[nodiscard]] std::vector<graze::rigid::Body>& bodies() { return bodies_; }
  [[nodiscard]] graze::Scene& scene() { return source_.scene(); }
  /// Returns what graze saw at the beginning of the last step.
  [[nodiscard]] const graze::FrameReport& report() const { return *source_.report(); }

  /// Returns how deep the two bodies are in each other that are so most, in m. It is at least 0.
  [[nodiscard]] double deepest_overlap() const;
  /// Returns a bound of the speed of the fastest point of all bodies, in m/s.
  [[nodiscard]] double largest_speed() const;
  /// Counts the pairs in the last report whose surfaces pass through each other, and of which nothing says
  /// so: no contact has a negative separation, and there is no way out.
  [[nodiscard]] std::size_t silent_crossings() const;

 private:
  graze::rigid::GrazeContacts source_;
  graze::rigid::Solver solver_;
  std::vector<graze::rigid::Body> bodies_;
  std::vector<ConvexBody> shapes_;
};

}  // namespace examples
