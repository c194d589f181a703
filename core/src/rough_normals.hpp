#pragma once

#include <array>
#include <graze/contact.hpp>
#include <graze/surface.hpp>
#include <optional>
#include <span>

#include "kernels/measure.hpp"
#include "naming.hpp"

namespace graze {

/// A weighted normal, of any length, and how far off it is at most: infinite where that is not known.
struct RoughNormal {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double error = 0;
};

/// Makes rough normals of features, several triangles or fans at once.
class NormalSums {
 public:
  /// Forgets what was not finished.
  void begin() { triangles_ = fans_ = 0; }
  /// `normal`, which stays where it is until finish(), becomes that of the feature.
  void add(const Surface& surface, const FeaturePiece& piece, RoughNormal& normal);
  void finish();

 private:
  void add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal);
  void add_edge(const Surface& surface, std::uint32_t edge, RoughNormal& normal);
  void add_triangle(const Surface& surface, const std::array<std::uint32_t, 3>& corner, RoughNormal& normal);
  void finish_triangles();
  void add_fan(const Surface& surface, std::uint32_t vertex, std::span<const std::uint32_t> around,
               RoughNormal& normal);
  void finish_fans();

  using Lanes = std::array<RoughNormal*, kernels::contact_lanes>;  ///< to which each is added
  kernels::NormalBatch triangle_batch_{};
  Lanes of_triangle_{};
  std::size_t triangles_ = 0;
  kernels::FanBatch fan_batch_{};
  Lanes of_fan_{};
  std::array<std::size_t, kernels::contact_lanes> fan_edges_{};
  std::size_t fans_ = 0;
};

/// What `side_of` says of a unit vector, where a rough normal is enough to know; otherwise nothing.
std::optional<Side> certain_side(const RoughNormal& normal, const Eigen::Vector3d& direction);

}  // namespace graze
