#pragma once

#include <array>
#include <graze/contact.hpp>
#include <graze/surface.hpp>
#include <optional>

#include "kernels/measure.hpp"
#include "naming.hpp"

namespace graze {

/// A weighted normal to 2^-28 of the sum of its weights, which is 0 or infinite where plain double does not
/// give that.
struct RoughNormal {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double weights = 0;
};

/// Makes rough normals of features, several triangles at once.
class NormalSums {
 public:
  /// Forgets what was not finished.
  void begin() { count_ = 0; }
  /// `normal`, which stays where it is until finish(), becomes that of the feature.
  void add(const Surface& surface, const FeaturePiece& piece, RoughNormal& normal);
  void finish();

 private:
  void add_vertex(const Surface& surface, std::uint32_t vertex, RoughNormal& normal);
  void add_edge(const Surface& surface, std::uint32_t edge, RoughNormal& normal);
  void add_triangle(const Surface& surface, const std::array<std::uint32_t, 3>& corner, double weight,
                    RoughNormal& normal);

  kernels::NormalBatch batch_{};
  std::array<RoughNormal*, kernels::contact_lanes> normal_{};  ///< to which a triangle is added
  std::size_t count_ = 0;
};

/// What `side_of` says of a unit vector, where a rough normal is enough to know; otherwise nothing.
std::optional<Side> certain_side(const RoughNormal& normal, const Eigen::Vector3d& direction);

}  // namespace graze
