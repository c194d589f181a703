#pragma once

#include <array>
#include <graze/graze.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/shapes.hpp"
#include "scheduler/scene_support.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"

namespace graze::tests {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// A scene of deformable bodies in which every pair is listed. Object i is body i.
class BodyScene {
 public:
  BodyScene(const std::vector<Body>& bodies, const SceneSettings& settings);

  /// Everything where it is now.
  ReportHandle step(const std::vector<Body>& bodies);
  [[nodiscard]] Scene& scene() { return scene_; }
  [[nodiscard]] const std::vector<ObjectId>& ids() const { return ids_; }

 private:
  Scene scene_;
  std::vector<ObjectId> ids_;
};

/// Counts the scenes and contacts that a test has compared.
struct Tally {
  std::size_t scenes = 0;
  std::size_t contacts = 0;

  /// Compares every detail of a scene of these bodies with brute force: which pairs there are, whether they
  /// are in contact, contacts, bounds and witnesses. Everything else about the report is checked for being
  /// consistent and finite.
  void compare(const std::vector<Body>& bodies, double threshold);
  /// The one detail.
  void compare(const std::vector<Body>& bodies, double threshold, ContactDetail detail);
  void print(const char* what) const;
};

}  // namespace graze::tests
