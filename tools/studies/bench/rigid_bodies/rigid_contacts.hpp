#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "bench/scenes/world.hpp"

/// Questions to those that find contacts of rigid bodies, and their answers. They are plain numbers, since
/// the module is compiled for other instruction sets than the rest of the program. All lengths are in m.
/// Points and vectors are x, y, z after each other.
namespace graze::bench {

/// What a rigid body is, in its own coordinates.
struct RigidShape {
  std::vector<double> points;  ///< of a closed surface
  std::vector<Triangle> triangles;
  double half[3] = {};                     ///< of a box about the origin, 0 for any other shape
  std::vector<std::vector<double>> parts;  ///< the points of convex parts that make up the body
};

struct RigidBodyView {
  const RigidShape* shape = nullptr;  ///< stays where it is as long as the finder lives
  bool is_fixed = false;
};

/// One place where two bodies may not come nearer.
struct RigidContact {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  double on_a[3] = {};
  double on_b[3] = {};
  double push[3] = {};    ///< of length 1: b moves along it to leave a
  double separation = 0;  ///< negative inside
  /// Tells the contacts of two bodies apart, and stays from call to call as long as the place does. Not 0.
  std::uint64_t key = 0;
};

/// Finds the contacts of all bodies, but for those of two fixed ones.
class RigidContactFinder {
 public:
  RigidContactFinder() = default;
  virtual ~RigidContactFinder() = default;
  RigidContactFinder(const RigidContactFinder&) = delete;
  RigidContactFinder& operator=(const RigidContactFinder&) = delete;

  /// Replaces contacts by those of the bodies at poses. A pose has 12 numbers: three columns of a rotation,
  /// then the place of the origin.
  virtual void find(std::span<const double> poses, std::vector<RigidContact>& contacts) = 0;
};

/// One way to find contacts.
struct RigidContactEntry {
  std::string_view name;
  bool takes_convex = false;      ///< whether it is measured with bodies of one part
  bool takes_non_convex = false;  ///< whether it is measured with bodies of several parts
  std::unique_ptr<RigidContactFinder> (*make)(std::span<const RigidBodyView> bodies,
                                              double contact_distance) = nullptr;
};

/// The module of peers exports this under the name `graze_bench_rigid_contacts`.
using ListRigidContactFinders = void (*)(std::span<const RigidContactEntry>& entries);

}  // namespace graze::bench
