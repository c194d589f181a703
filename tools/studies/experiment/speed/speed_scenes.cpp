#include "experiment/speed/speed_scenes.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "experiment/paper/motion/paper_motions.hpp"
#include "experiment/real_motions.hpp"

namespace graze::tools {
namespace {

struct PaperScene {
  int number;
  const char* title;
  double contact_distance;  ///< the last ε of row 3
};
constexpr std::array<PaperScene, 3> paper_scenes = {{{1, "experiment 1: tori and pawns", 8},
                                                     {2, "experiment 2: humans and a torus", 10},
                                                     {3, "experiment 3: tooth and cylinder", 10}}};

void keep_last_frames(RecordedMotion& motion, std::size_t count) {
  for (RecordedObject& object : motion.objects) {
    const std::size_t surplus = object.frames.size() - std::min(count, object.frames.size());
    object.frames.erase(object.frames.begin(), object.frames.begin() + static_cast<std::ptrdiff_t>(surplus));
  }
}

}  // namespace

std::vector<SpeedScene> speed_scenes(const ExperimentOptions& options) {
  std::vector<SpeedScene> scenes;
  for (const PaperScene& paper : paper_scenes) {
    SpeedScene scene{"experiment" + std::to_string(paper.number), paper.title,
                     record_experiment(paper.number, options), paper.contact_distance};
    keep_last_frames(scene.motion, 25);
    scenes.push_back(std::move(scene));
  }
  for (RecordedMotion& motion : record_real_motions(options)) {
    const double edge = motion.mean_edge_length;
    scenes.push_back({"", motion.name, std::move(motion), edge});
    scenes.back().name = "real" + std::to_string(scenes.size() - paper_scenes.size());
  }
  return scenes;
}

}  // namespace graze::tools
