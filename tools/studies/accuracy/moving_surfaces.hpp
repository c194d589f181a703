#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <vector>

namespace graze::tools {

/// Surfaces whose vertices move, the same in every run: what settings are measured on.
class MovingSurfaces {
 public:
  MovingSurfaces() = default;
  virtual ~MovingSurfaces() = default;
  MovingSurfaces(const MovingSurfaces&) = delete;
  MovingSurfaces& operator=(const MovingSurfaces&) = delete;

  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual std::uint32_t frame_count() const = 0;
  [[nodiscard]] virtual const std::shared_ptr<const Mesh>& mesh(std::size_t body) const = 0;
  /// At rest, of all edges of all surfaces.
  [[nodiscard]] virtual double mean_edge_length() const = 0;
  /// See largest_level_epsilon.
  [[nodiscard]] virtual const std::vector<double>& level_epsilon() const = 0;
  /// Tells a scene where the vertices of a body are.
  virtual void place(Scene& scene, ObjectId object, std::size_t body, std::uint32_t frame) const = 0;
};

/// Twice the largest eq. 3 radius of any mesh at rest, which is what eq. 6 is at most, by level.
std::vector<double> largest_level_epsilon(std::span<const std::shared_ptr<const Mesh>> meshes);

}  // namespace graze::tools
