#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "bench/rigid_bodies/rigid_body_scenes.hpp"
#include "rigid/body.hpp"
#include "rigid/contact.hpp"

// What a study reads off a play of rigid bodies, once a step.
namespace graze::bench {

/// Returns the mean over the bodies that can move of how fast the fastest point of each moves, in mm/s, from
/// where the bodies were a step ago to where they are now.
double speed_between(const RigidBodyScene& scene, std::span<const rigid::Body> before,
                     std::span<const rigid::Body> now, double time_step);

/// Returns the largest error of height, in mm, of bodies that were put where they should stay. 0 where none
/// were.
double height_error(const RigidBodyScene& scene, std::span<const rigid::Body> now);

/// Returns how many of the bodies that were put somewhere are within 2 cm of that height.
std::size_t standing(const RigidBodyScene& scene, std::span<const rigid::Body> now);

/// Follows contacts from step to step, and counts those that come out of nothing.
class ContactJumps {
 public:
  /// Looks at the contacts of a step, at the poses for which they were found.
  void see(std::span<const rigid::Body> bodies, std::span<const rigid::Contact> contacts);
  /// Forgets what was counted.
  void restart() { touching_ = jumped_ = 0; }
  /// Returns the share of contacts, of those nearer than 2 mm, that in the step before had none of the same
  /// two bodies within 5 mm, as one of both bodies carries it.
  [[nodiscard]] double share() const;

 private:
  struct Point {
    std::uint32_t a = 0, b = 0;
    Eigen::Vector3d on_b;  ///< in the coordinates of b
  };
  std::vector<Point> last_, now_;  ///< in the order of a and b
  std::size_t touching_ = 0;
  std::size_t jumped_ = 0;
};

}  // namespace graze::bench
