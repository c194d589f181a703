#include "experiment/real_motions.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "bench/scenes/scenes.hpp"
#include "mean_edge_length.hpp"

namespace graze::tools {
namespace {

RecordedMotion record(const bench::BenchScene& scene, std::uint32_t frames) {
  RecordedMotion motion;
  motion.name = scene.what;
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (const bench::Body& body : scene.bodies) {
    RecordedObject object;
    object.name = "part " + std::to_string(meshes.size() + 1);
    object.kind = object.name;
    object.mesh = body.mesh;
    std::vector<float> positions(3 * static_cast<std::size_t>(body.mesh->vertex_count()));
    for (std::uint32_t frame = 0; frame < frames; ++frame) {
      body.place(frame, positions);
      object.frames.push_back(positions);
    }
    meshes.push_back(body.mesh);
    motion.objects.push_back(std::move(object));
  }
  motion.mean_edge_length = mean_edge_length(meshes);
  return motion;
}

}  // namespace

std::vector<RecordedMotion> record_real_motions(const ExperimentOptions& options) {
  std::vector<RecordedMotion> motions;
  for (const char* name : {"S7c", "S7b", "S7a"}) {
    const bench::BenchScene scene = bench::make_scene(name, options.data.string());
    if (scene.missing.empty()) {
      motions.push_back(record(scene, options.frames_of(4)));
    } else {
      std::fprintf(stderr, "note: %s is left out: %s\n", scene.what.c_str(), scene.missing.c_str());
    }
  }
  return motions;
}

}  // namespace graze::tools
