#pragma once

#include <vector>

#include "accuracy/moving_surfaces.hpp"
#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// A recorded motion, for settings to be measured on.
class RecordedScene final : public MovingSurfaces {
 public:
  explicit RecordedScene(RecordedMotion motion);

  [[nodiscard]] const RecordedMotion& motion() const { return motion_; }
  [[nodiscard]] std::size_t size() const override { return motion_.objects.size(); }
  [[nodiscard]] std::uint32_t frame_count() const override {
    return static_cast<std::uint32_t>(motion_.frame_count());
  }
  [[nodiscard]] const std::shared_ptr<const Mesh>& mesh(std::size_t body) const override {
    return motion_.objects[body].mesh;
  }
  [[nodiscard]] double mean_edge_length() const override { return motion_.mean_edge_length; }
  [[nodiscard]] const std::vector<double>& level_epsilon() const override { return level_epsilon_; }
  void place(Scene& scene, ObjectId object, std::size_t body, std::uint32_t frame) const override;

 private:
  RecordedMotion motion_;
  std::vector<double> level_epsilon_;
};

}  // namespace graze::tools
