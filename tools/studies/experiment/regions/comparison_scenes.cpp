#include "experiment/regions/comparison_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "experiment/regions/deforming_scenes.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

bench::BenchScene renamed(bench::BenchScene scene, std::string name) {
  scene.name = std::move(name);
  return scene;
}

/// Adds scenes and keeps account of those that are not there.
class Collector {
 public:
  explicit Collector(const ExperimentOptions& options) : options_(options) {}

  void add(bench::BenchScene scene) {
    if (scene.missing.empty()) {
      result_.scenes.push_back(std::move(scene));
      return;
    }
    std::fprintf(stderr, "skipped: the scene \"%s\" (%s)\n", scene.name.c_str(), scene.missing.c_str());
    missing_.push_back(scene.name);
  }
  /// One of the bench's, under a name that says what it is.
  void add_bench(const char* bench_name, const char* name) {
    add(renamed(bench::make_scene(bench_name, options_.data.string()), name));
  }
  void add_large_bench(const char* bench_name, const char* name) {
    if (options_.frames == 0) return add_bench(bench_name, name);
    large_.emplace_back(name);
  }

  ComparisonScenes take() {
    if (!missing_.empty())
      result_.left_out += "Left out, since their files are missing: " + joined(missing_) + ". ";
    if (!large_.empty()) result_.left_out += "Left out of a short run: " + joined(large_) + ". ";
    return std::move(result_);
  }

 private:
  const ExperimentOptions& options_;
  ComparisonScenes result_;
  std::vector<std::string> missing_, large_;
};

}  // namespace

ComparisonScenes partition_scenes(const ExperimentOptions& options) {
  Collector scenes(options);
  scenes.add(rigid_tori());
  scenes.add(meeting_models(options.seed));
  scenes.add(striding_humans());
  scenes.add(posing_wolves(options.data.string()));
  scenes.add_large_bench("S7a", "organs");
  scenes.add_bench("S7b", "armadillo");
  scenes.add_bench("S7c", "funnel");
  scenes.add(folding_sheets());
  scenes.add(unfolding_sheets());
  scenes.add_large_bench("S6c", "cloth");
  scenes.add_large_bench("S4", "spheres");
  return scenes.take();
}

std::size_t compared_frames(const ExperimentOptions& options) {
  return options.frames_of(6);
}

double a_frame(std::uint64_t of_all_frames, std::size_t frames) {
  return static_cast<double>(of_all_frames) / static_cast<double>(frames);
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? 1 : std::exp(sum / static_cast<double>(values.size()));
}

double beside(double mine, double other) {
  return mine / other;
}

double beside(std::uint64_t mine, std::uint64_t other) {
  return beside(static_cast<double>(std::max<std::uint64_t>(1, mine)),
                static_cast<double>(std::max<std::uint64_t>(1, other)));
}

}  // namespace graze::tools
