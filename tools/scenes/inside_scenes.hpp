#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/graze.hpp>
#include <memory>
#include <string_view>
#include <vector>

#include "scenes/played_scene.hpp"

namespace graze::scenes {

/// A body wholly inside a solid, both spheres of as many vertices. Both swell and shift in every frame. They
/// are the same on every machine, since motion is made by sums and products alone.
class InsideScene : public PlayedScene {
 public:
  /// The name says where the body is: `inside_middle` is half as large and shares the solid's middle,
  /// `inside_aside` is half as large and nearer to one side, and `inside_near` lies just beneath the surface.
  /// Throws std::out_of_range for another name. Each sphere has `rings` circles of 2 · `rings` vertices.
  InsideScene(std::string_view name, std::uint32_t rings);

  [[nodiscard]] SceneSettings settings() const override;
  void advance(Scene& scene, std::size_t frame) override;

  /// The corners of the triangles of both.
  [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
  /// The positions of now.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& solid() const { return positions_[0]; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& body() const { return positions_[1]; }

 private:
  double size_;
  Eigen::Vector3d middle_;
  std::shared_ptr<const Mesh> mesh_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::array<ObjectId, 2> ids_{};
  std::array<std::vector<Eigen::Vector3d>, 2> positions_;
};

std::vector<std::string_view> inside_scene_names();

/// The scene of a name with spheres of 8,194 vertices, or of 1,154 where they are small. Null where there is
/// none.
std::unique_ptr<InsideScene> make_inside_scene(std::string_view name, bool are_small = false);

}  // namespace graze::scenes
