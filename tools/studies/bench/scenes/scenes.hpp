#pragma once

#include <cstddef>
#include <functional>
#include <graze/mesh.hpp>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenes/world.hpp"

namespace graze::bench {

/// One surface of a scene.
struct Body {
  /// Writes x, y, z of every vertex in `frame`: a function of the frame alone. False: nothing has changed
  /// since the frame before, and nothing was written. Frame 0 is always written.
  using Place = std::function<bool(std::size_t frame, std::span<float> out)>;

  std::shared_ptr<const Mesh> mesh;  ///< of triangles
  Place place;
  bool is_fixed = false;
};

/// A scene that is the same in every run.
struct BenchScene {
  std::string name;
  std::string what;
  double distance = 0;  ///< threshold and range
  std::size_t frames = 0;
  std::vector<Body> bodies;
  /// Most bodies rest or hardly move, and graze is told so.
  bool is_told = false;
  /// Graze takes part a second time, told of what moves how far.
  bool tries_telling = false;
  /// Some bodies move in every frame and the others never.
  bool has_sleepers = false;
  std::string missing = {};  ///< why there is none, where it needs data that is not there
};

/// All scenes' names. S1 to S10 are those of the specification, some in parts. G… are more and more objects
/// at the density of S5, V… the two spheres of S4 with more and more vertices.
std::vector<std::string_view> scene_names();

/// The scene of one of these names. `data` is the folder of real meshes.
BenchScene make_scene(std::string_view name, const std::string& data);

/// A scene's bodies in motion.
class MovingWorld {
 public:
  explicit MovingWorld(BenchScene scene);

  [[nodiscard]] const BenchScene& scene() const { return scene_; }
  [[nodiscard]] const World& world() const { return world_; }
  /// Frames come one after the other from 0.
  void place(std::size_t frame);

 private:
  BenchScene scene_;
  World world_;
  std::vector<std::vector<Triangle>> triangles_;  ///< of each mesh
  std::vector<float> before_;                     ///< an object's positions in the frame before
};

}  // namespace graze::bench
