#pragma once

#include <array>
#include <graze/contact.hpp>
#include <optional>
#include <span>
#include <tuple>

#include "closest_features/closest_features.hpp"
#include "core/surface/surface.hpp"
#include "kernels/measure.hpp"

namespace graze {

using kernels::RoughNormal;

/// Makes rough normals of features, several triangles or fans at once.
class NormalSums {
 public:
  /// Forgets what was not finished.
  void begin();
  /// `normal`, which stays where it is until finish(), becomes that of the feature.
  void add(const Surface& surface, const FeaturePiece& piece, RoughNormal& normal);
  void add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal);
  void finish();

 private:
  void add_edge(const Surface& surface, std::uint32_t edge, RoughNormal& normal);
  void add_triangle(const Surface& surface, const std::array<std::uint32_t, 3>& corner, RoughNormal& normal);
  void finish_triangles();

  using Lanes = std::array<RoughNormal*, kernels::contact_lanes>;  ///< to which each is added
  kernels::NormalBatch triangle_batch_{};
  Lanes of_triangle_{};
  std::size_t triangles_ = 0;
  std::tuple<kernels::FanBatch<float>, kernels::FanBatch<double>> fans_{};
};

/// Returns `side_of` a unit vector if a rough normal is enough to know it. Otherwise returns nothing.
std::optional<Side> certain_side(const RoughNormal& normal, const Eigen::Vector3d& direction);

}  // namespace graze
