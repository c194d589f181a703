#include "bench/comparisons.hpp"

#include <algorithm>

#include "bench/peer_module.hpp"
#include "bench/rays/ray_study.hpp"
#include "bench/rigid_bodies/rigid_body_study.hpp"
#include "bench/scaling/scaling_study.hpp"
#include "bench/self/self_study.hpp"
#include "bench/soft_bodies/soft_body_study.hpp"
#include "bench/surface_details.hpp"
#include "figures/result_table.hpp"
#include "output/text_file.hpp"

namespace graze::tools {
namespace {

/// Prints a table, and writes it where it is asked for.
void show(const ResultTable& table, const BenchOptions& options) {
  print(markdown_of(table));
  if (options.csv) write_text_file(*options.csv, csv_of(table));
}

void compare_details(const BenchOptions& options) {
  std::vector<bench::BenchScene> scenes;
  for_each_scene(options, [&](const bench::BenchScene& scene) { scenes.push_back(scene); });
  show(bench::compare_surface_details(scenes, options.frames), options);
}

/// The number of frames of scenes that a solver plays.
std::size_t frames_or_usual(const BenchOptions& options) {
  constexpr std::size_t usual_frames = 300;
  return options.frames == 0 ? usual_frames : options.frames;
}

void compare_self_contacts(const BenchOptions& options) {
  show(bench::compare_self_contacts(bench::PeerModule(), frames_or_usual(options)), options);
}

void compare_rays(const BenchOptions& options) {
  const bench::PeerModule module;
  bench::RayStudy study;
  for_each_scene(options, [&](const bench::BenchScene& scene) {
    for (const unsigned threads : options.threads) study.add(module, scene, options.frames, threads);
  });
  show(study.table(), options);
}

#if GRAZE_BENCH_KERNELS
void compare_threads(const BenchOptions& options) {
  bench::ScalingStudy study(options.threads);
  for_each_scene(options, [&](const bench::BenchScene& scene) {
    for (const std::string& task : options.tasks)
      study.add(scene, static_cast<bench::Task>(task.front()), options.frames);
  });
  print(markdown_of(study.stages()));
  show(study.table(), options);
  if (options.json) write_text_file(*options.json, study.figures().dump(2) + "\n");
}
#endif

void compare_soft_bodies(const BenchOptions& options) {
  const bench::PeerModule module;
  if (!module.has_soft_contact_finder())
    print("No rows of Bullet: its soft bodies were not there when this program was built.\n\n");
  show(bench::compare_soft_bodies(module, frames_or_usual(options)), options);
}

void compare_rigid_bodies(const BenchOptions& options) {
  const bench::PeerModule module;
  const auto has_name_of_bullet = [](const bench::RigidContactEntry& entry) {
    return entry.name.starts_with("Bullet");
  };
  if (std::ranges::none_of(module.rigid_contact_finders(), has_name_of_bullet))
    print("No rows of Bullet: it was not there when this program was built.\n\n");
  show(bench::compare_rigid_bodies(module, options.is_quick), options);
}

/// The function that makes the comparison asked for, or none.
void (*comparison_of(const BenchOptions& options))(const BenchOptions&) {
  if (options.details) return compare_details;
  if (options.rays) return compare_rays;
#if GRAZE_BENCH_KERNELS
  if (options.scaling) return compare_threads;
#endif
  if (options.self) return compare_self_contacts;
  if (options.soft_bodies) return compare_soft_bodies;
  if (options.rigid_bodies) return compare_rigid_bodies;
  return nullptr;
}

}  // namespace

bool compare_instead(const BenchOptions& options) {
  const auto compare = comparison_of(options);
  if (compare == nullptr) return false;
  compare(options);
  return true;
}

}  // namespace graze::tools
