#include "experiment/library_leaf_cost.hpp"

#include <algorithm>
#include <graze/graze.hpp>
#include <limits>
#include <vector>

namespace graze::tools {

double library_leaf_us(const PlacedFrames& scene, std::uint32_t runs) {
  std::vector<double> fastest(scene.frames.size(), std::numeric_limits<double>::infinity());
  std::uint64_t leaf_pairs = 0;
  for (std::uint32_t run = 0; run < std::max(1U, runs); ++run) {
    SceneSettings settings;
    settings.contact_distance = settings.range = scene.distance;
    settings.detail = ContactDetail::features;
    settings.threads = 1;
    Scene played(settings);
    std::vector<ObjectId> ids;
    for (const auto& mesh : scene.meshes) ids.push_back(played.add(mesh));
    leaf_pairs = 0;
    for (std::size_t frame = 0; frame < scene.frames.size(); ++frame) {
      for (std::size_t i = 0; i < ids.size(); ++i)
        played.set_positions(ids[i], scene.frames[frame].positions[i]);
      const auto report = played.step();
      fastest[frame] = std::min(fastest[frame], report->statistics().jobs_ms);
      leaf_pairs += report->statistics().leaf_pairs_tested;
    }
  }
  double ms = 0;
  for (const double each : fastest) ms += each;
  return leaf_pairs == 0 ? 0 : 1000 * ms / static_cast<double>(leaf_pairs);
}

}  // namespace graze::tools
