#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/scenes/scenes.hpp"
#include "bench/scenes/slow_motion.hpp"
#include "output/text.hpp"

namespace graze::tools {

/// The options of `graze_studies bench`.
struct BenchOptions {
  std::vector<std::string> scenes = {"S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8", "S9", "S10"};
  std::vector<std::string> tasks = {"A", "B", "D"};
  std::vector<unsigned> threads = {1};
  std::size_t frames = 0;
  std::vector<std::string> peers = {"all"};
  bool evict = false;
  bool is_recorded = false;
  bool aims = false;
  bool details = false;
  bool rays = false;
  bool self = false;
  bool scaling = false;
  bool soft_bodies = false;
  bool rigid_bodies = false;
  bool is_quick = false;
  std::size_t slow = 1;
  std::vector<std::string> instruction_sets;
  std::string data = GRAZE_SHARED_DATA;
  std::optional<std::filesystem::path> csv, json;
  std::filesystem::path figures;
};

/// Whether a scene is one of those that are wanted. Parts of a scene have its name and a letter.
[[nodiscard]] inline bool is_asked_for(std::string_view scene, const std::vector<std::string>& wanted) {
  return std::any_of(wanted.begin(), wanted.end(), [&](const std::string& name) {
    return scene == name || (scene.starts_with(name) && scene.size() == name.size() + 1 &&
                             scene.back() >= 'a' && scene.back() <= 'z');
  });
}

/// Calls `use` with each scene that is asked for, and for which there is data.
template <typename Use>
void for_each_scene(const BenchOptions& options, const Use& use) {
  for (const std::string_view name : bench::scene_names()) {
    if (!is_asked_for(name, options.scenes)) continue;
    const bench::BenchScene scene =
        bench::in_slow_motion(bench::make_scene(name, options.data), options.slow);
    if (scene.missing.empty())
      use(scene);
    else
      print("\nskipped: " + scene.name + ", " + scene.missing + "\n");
  }
}

}  // namespace graze::tools
