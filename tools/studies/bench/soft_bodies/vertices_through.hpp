#pragma once

#include <cstddef>
#include <graze/graze.hpp>
#include <vector>

#include "examples/support/body.hpp"
#include "examples/support/world.hpp"

namespace graze::bench {

/// Counts vertices where none should be: inside a solid of another body, by its exact winding number, or out
/// of the scene. It has a scene of its own, so that what it does changes no time of another one.
class VerticesThrough {
 public:
  /// The world must be filled already, and must stay where it is.
  VerticesThrough(const examples::World& world, bool (*is_out)(const Eigen::Vector3d& point));

  /// Returns how many vertices are through now, each counted once.
  std::size_t count();

 private:
  const examples::World& world_;
  bool (*is_out_)(const Eigen::Vector3d& point);
  Scene scene_;
  std::vector<std::vector<bool>> is_through_;  ///< of each body, of each vertex
};

}  // namespace graze::bench
