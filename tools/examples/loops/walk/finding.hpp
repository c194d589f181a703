#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <limits>
#include <vector>

#include "examples/loops/organ_history.hpp"
#include "examples/loops/proxy.hpp"

namespace loops {

/// Keeps how deep the instrument is in a tick, and where its proxy would be, by one way to use contacts.
class Finding {
 public:
  static constexpr double skin = 0.3;  ///< mm, that the proxy keeps from the organs

  explicit Finding(const Held& held) : to_hand_(held.hand.translation() - held.proxy) {}
  void add(const Eigen::Vector3d& push, double separation) {
    deepest_ = std::min(deepest_, separation);
    planes_.push_back({push, separation - skin + push.dot(to_hand_)});
  }
  /// Returns the least separation in mm.
  [[nodiscard]] double deepest() const { return deepest_; }
  /// Returns the way from the hand to the proxy in mm.
  [[nodiscard]] Eigen::Vector3d way() const { return way_to_proxy(planes_); }

 private:
  Eigen::Vector3d to_hand_;
  double deepest_ = std::numeric_limits<double>::infinity();
  std::vector<ConstraintPlane> planes_;
};

/// Counts in how many ticks a way to use contacts is off.
struct FindingTrack {
  static constexpr double near = 1;           ///< mm. What is further away counts as if it were so far
  static constexpr double depth_error = 0.1;  ///< mm
  static constexpr double force_error = 0.1;  ///< N
  static constexpr double stiffness = 0.5;    ///< N/mm, between the hand and the proxy

  const char* name;
  int missed = 0;       ///< ticks in which the truth is deeper
  int false_depth = 0;  ///< ticks in which the truth is less deep
  int force_off = 0;    ///< ticks in which the force is another one
  int jumps = 0;        ///< of the force, from one tick to the next
  double largest_jump = 0;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();

  void take(const Finding& found, const Finding& truth) {
    const auto depth = [](const Finding& of) { return std::max(0.0, near - of.deepest()); };
    missed += depth(found) < depth(truth) - depth_error;
    false_depth += depth(found) > depth(truth) + depth_error;
    const Eigen::Vector3d force = stiffness * found.way();
    force_off += (force - stiffness * truth.way()).norm() > force_error;
    const double change = (force - last).norm();
    jumps += change > force_error;
    largest_jump = std::max(largest_jump, change);
    last = force;
  }
  void print() const {
    std::printf("  %-26s %12d %12d %14d %6d %11.2f N\n", name, missed, false_depth, force_off, jumps,
                largest_jump);
  }
  static void print_head() {
    std::printf("  %-26s %12s %12s %14s %6s %13s\n", "ticks of 1 ms with", "missed depth", "false depth",
                "another force", "jumps", "largest jump");
  }
};

}  // namespace loops
