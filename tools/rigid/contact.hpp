#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "rigid/body.hpp"

namespace graze::rigid {

/// One place where two bodies may not come nearer. It holds for the poses for which it was found.
struct Contact {
  std::uint32_t a = 0;  ///< index of a body
  std::uint32_t b = 0;  ///< index of the other body
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d push = Eigen::Vector3d::Zero();  ///< of length 1: b moves along it to leave a
  double separation = 0;                           ///< m, negative inside
  /// Tells the contacts of two bodies apart, and is the same from step to step. A contact begins with the
  /// impulse that the one of the same key had in the last step. 0 is no key.
  std::uint64_t key = 0;
};

/// Finds contacts of bodies: by graze, or by another library.
class ContactSource {
 public:
  virtual ~ContactSource() = default;
  /// Replaces the contacts by those that the bodies have where they are now. The solver takes them in their
  /// order. It works best if contacts of bodies that lie further up come later.
  virtual void find(std::span<const Body> bodies, std::vector<Contact>& contacts) = 0;
};

}  // namespace graze::rigid
