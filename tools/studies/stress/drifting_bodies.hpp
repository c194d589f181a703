#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <graze/graze.hpp>
#include <memory>
#include <span>
#include <vector>

namespace graze::tools {

/// Many bodies of one mesh whose vertices all move in every frame: they drift about their places and wobble.
/// Positions are float, all in one block of memory.
class DriftingBodies {
 public:
  /// Surfaces of 258 vertices on a jittered lattice: about one pair in a hundred neighbours touches, however
  /// many there are.
  static DriftingBodies lattice(std::size_t count);
  /// As lattice(), but so far apart that no surface is near another.
  static DriftingBodies sparse_lattice(std::size_t count);
  /// Two spheres of 100,000 vertices that touch in a small patch.
  static DriftingBodies large_pair();
  /// Balls of 802 vertices in a cube, each in contact with its neighbours.
  static DriftingBodies heap(std::size_t count);
  /// Two spheres of 10,002 vertices at nearly the same position, in contact everywhere.
  static DriftingBodies entangled_pair();

  /// How near others must be for a step to look at them, in the unit of positions.
  void set_range(double range) { settings_.range = range; }
  void set_detail(ContactDetail detail) { settings_.detail = detail; }

  [[nodiscard]] std::size_t object_count() const { return bodies_.size(); }
  [[nodiscard]] const SceneSettings& settings() const { return settings_; }
  /// The settings for so many threads.
  [[nodiscard]] SceneSettings settings_with(unsigned threads) const {
    SceneSettings settings = settings_;
    settings.threads = threads;
    return settings;
  }
  [[nodiscard]] std::size_t position_bytes() const { return positions_.size() * sizeof(float); }

  /// The positions of all bodies, x, y and z of each vertex, body by body.
  [[nodiscard]] std::span<const float> positions() const { return positions_; }
  [[nodiscard]] std::size_t vertices_each() const { return mesh_->vertex_count(); }
  /// Adds all bodies, and returns their ids.
  [[nodiscard]] std::vector<ObjectId> add_unbound_to(Scene& scene) const;
  /// Adds all bodies and binds their positions, which must outlive the scene.
  void add_to(Scene& scene) const;
  [[nodiscard]] PositionView positions_of(std::size_t body) const {
    const std::size_t count = vertices_each();
    return {positions_.data() + 3 * count * body, count};
  }
  void move(std::size_t frame);
  /// Reads every position once: their sum.
  [[nodiscard]] float read() const;

 private:
  struct Body {
    Eigen::Vector3d centre;
    double phase = 0;
  };
  static DriftingBodies lattice(std::size_t count, double spacing);
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
