#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

namespace graze::tools {

/// Many bodies of one mesh whose vertices all move in every frame: they drift about their places and wobble.
/// Positions are float, all in one block of memory.
class DriftingBodies {
 public:
  /// Surfaces of 258 vertices on a jittered lattice: about one pair in a hundred neighbours touches, however
  /// many there are.
  static DriftingBodies lattice(std::size_t count);
  /// Two spheres of 100,000 vertices that touch in a small patch.
  static DriftingBodies large_pair();

  [[nodiscard]] std::size_t object_count() const { return bodies_.size(); }
  [[nodiscard]] const SceneSettings& settings() const { return settings_; }
  [[nodiscard]] std::size_t position_bytes() const { return positions_.size() * sizeof(float); }

  /// Adds all bodies and binds their positions, which must outlive the scene.
  void add_to(Scene& scene) const;
  void move(std::size_t frame);
  /// Reads every position once: their sum.
  [[nodiscard]] float read() const;

 private:
  struct Body {
    Eigen::Vector3d centre;
    double phase = 0;
  };
  DriftingBodies(std::shared_ptr<const Mesh> mesh, std::vector<Body> bodies, double wobble, double drift,
                 double distance);

  std::shared_ptr<const Mesh> mesh_;
  std::vector<Body> bodies_;
  double wobble_;  ///< relative to the radius
  double drift_;
  SceneSettings settings_;
  std::vector<Eigen::Vector2f> waves_;  ///< sine and cosine of each rest vertex's height
  std::vector<float> positions_;
};

}  // namespace graze::tools
