#pragma once

#include <cstddef>
#include <graze/graze.hpp>
#include <memory>
#include <string_view>
#include <vector>

namespace graze::scenes {

/// A scene that is the same in every run and on every machine: all positions lie on a grid of 2^-16.
class PlayedScene {
 public:
  virtual ~PlayedScene() = default;
  PlayedScene(const PlayedScene&) = delete;
  PlayedScene& operator=(const PlayedScene&) = delete;

  /// Detail, thresholds, limits and exact accuracy. Threads are for the caller to say.
  [[nodiscard]] virtual SceneSettings settings() const = 0;
  /// Brings `scene`, which was made with these settings, to where everything is in `frame`. Frames come one
  /// after the other from 0, which adds the objects. Memory that is bound lives as long as this.
  virtual void advance(Scene& scene, std::size_t frame) = 0;

 protected:
  PlayedScene() = default;
};

/// paths (the paper's first experiment), pile, pair (large ones), skinned, crowd (comes and goes). Then those
/// with the detail `nearest`: nearest, solids (through and inside each other), limits (of contacts), carrying
/// (contacts chosen to carry), and seams (groups of faces, and meshes that are replaced). Then self (surfaces
/// that are tested against themselves) and swept (impacts and jumps).
std::vector<std::string_view> played_scene_names();

/// How large the surfaces of the scene `pair` are.
enum class PairSize { small, large };  // 10,000 and 100,000 vertices each

/// The scene of a name at its start. Null where there is none.
std::unique_ptr<PlayedScene> make_played_scene(std::string_view name, PairSize pair_size = PairSize::small);

}  // namespace graze::scenes
