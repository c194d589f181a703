#pragma once

#include <span>
#include <vector>

#include "examples/loops/props.hpp"

namespace loops {

/// One of the two surfaces at a contact. Without a prop, nothing moves it: it has a velocity of its own.
struct ContactSide {
  Prop* prop = nullptr;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();     ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s, of a surface without a prop
};

/// Holds b off a at one contact, with friction.
class PushConstraint {
 public:
  /// `time` is that of a frame, in seconds.
  PushConstraint(const graze::Contact& contact, const ContactSide& a, const ContactSide& b, double time);
  /// Pushes both props, once. Pushes of all contacts are repeated until they agree.
  void solve();
  /// Returns the sum of the impulses so far, in N s.
  [[nodiscard]] double impulse() const { return impulse_; }

 private:
  void push(const Eigen::Vector3d& impulse) const;

  ContactSide a_, b_;
  Eigen::Vector3d arm_a_ = Eigen::Vector3d::Zero(), arm_b_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction_;  ///< of the push on b
  double speed_ = 0;           ///< m/s, with which b shall leave a at least, negative if it may come closer
  double mass_ = 0;            ///< kg, against a push
  double sliding_mass_ = 0;    ///< kg, not more than that against any push across it
  double impulse_ = 0;
  Eigen::Vector3d friction_ = Eigen::Vector3d::Zero();
};

}  // namespace loops
