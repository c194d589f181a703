#include "experiment/speed/recorded_scene.hpp"

#include <utility>

namespace graze::tools {
namespace {

std::vector<double> level_epsilon_of(const RecordedMotion& motion) {
  std::vector<std::shared_ptr<const Mesh>> meshes;
  meshes.reserve(motion.objects.size());
  for (const RecordedObject& object : motion.objects) meshes.push_back(object.mesh);
  return largest_level_epsilon(meshes);
}

}  // namespace

RecordedScene::RecordedScene(RecordedMotion motion)
    : motion_(std::move(motion)), level_epsilon_(level_epsilon_of(motion_)) {}

void RecordedScene::place(Scene& scene, ObjectId object, std::size_t body, std::uint32_t frame) const {
  scene.set_positions(object, motion_.objects[body].positions(frame));
}

}  // namespace graze::tools
