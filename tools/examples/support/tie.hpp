#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <graze/graze.hpp>
#include <span>

#include "examples/support/body.hpp"

namespace examples {

/// Ties a point of one surface to a point of another. Vertices carry the points along by their weights.
struct Tie {
  Body* a = nullptr;
  Body* b = nullptr;
  graze::SurfaceWeights weights_a;
  graze::SurfaceWeights weights_b;

  /// Returns the way from the point of a to that of b.
  [[nodiscard]] Eigen::Vector3d apart() const;
  /// Moves vertices of both bodies so that the way from a to b is the wanted one. A vertex moves as far as
  /// its weight and its inverse mass say.
  void solve(const Eigen::Vector3d& wanted) const;
};

/// Makes a tie of the two points of a contact.
Tie tie_of(const graze::Contact& contact, Body& a, Body& b);

/// Returns whether all faces at a vertex or an edge, or the face itself, are in a group of faces.
bool all_faces_in(std::uint8_t group, std::span<const std::uint8_t> groups, const graze::Mesh& mesh,
                  const graze::Feature& feature);

}  // namespace examples
