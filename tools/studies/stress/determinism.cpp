#include "stress/determinism.hpp"

#include <oneapi/tbb/global_control.h>

#include <array>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "progress.hpp"
#include "scenes/played_scene.hpp"
#include "scenes/report_hash.hpp"

namespace graze::tools {
namespace {

constexpr std::array<unsigned, 6> thread_counts = {1, 2, 3, 4, 8, 16};

struct Played {
  std::uint64_t hash = 0;
  std::uint64_t contacts = 0;
};

Played play(std::string_view name, const DeterminismOptions& options, unsigned threads) {
  const auto played =
      scenes::make_played_scene(name, options.large ? scenes::PairSize::large : scenes::PairSize::small);
  SceneSettings settings = played->settings();
  settings.threads = threads;
  Scene scene(settings);
  scenes::ReportHash hash;
  Played result;
  for (std::size_t frame = 0; frame < options.frames; ++frame) {
    played->advance(scene, frame);
    const ReportHandle report = scene.step();
    hash.add(*report);
    result.contacts += report->contacts().size();
  }
  result.hash = hash.value();
  return result;
}

}  // namespace

StressResult run_determinism_study(const DeterminismOptions& options) {
  // The program, never the library, lets oneTBB have as many threads as a scene is asked to use.
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism,
                                            thread_counts.back());
  const auto names = scenes::played_scene_names();
  Progress progress("play", names.size() * options.repeats * thread_counts.size());
  std::uint64_t done = 0;
  StressResult result;
  result.figures = {{"frames", options.frames}, {"repeats", options.repeats}, {"threads", thread_counts}};
  const TextTable table = TextTable::of_numbers({"scene", "hash", "frames", "contacts", "plays"}, 8, 16);
  print(table.head());
  for (const std::string_view name : names) {
    const Played first = play(name, options, 1);
    for (std::size_t repeat = 0; repeat < options.repeats; ++repeat)
      for (const unsigned threads : thread_counts) {
        progress.at(done++);
        const Played again = play(name, options, threads);
        if (again.hash != first.hash)
          result.violations.push_back(
              format("%s: repeat %zu with %u threads gave hash %s, the first run with 1 thread %s",
                     std::string(name).c_str(), repeat, threads, hash_text(again.hash).c_str(),
                     hash_text(first.hash).c_str()));
      }
    print(table.row({std::string(name), hash_text(first.hash), std::to_string(options.frames),
                     std::to_string(first.contacts),
                     std::to_string(1 + options.repeats * thread_counts.size())}));
    result.figures["scenes"].push_back(
        {{"name", name}, {"hash", hash_text(first.hash)}, {"contacts", first.contacts}});
  }
  return result;
}

}  // namespace graze::tools
