// Plays the golden scenes with each set of kernels that this platform has, on each number of threads in the
// arguments, and compares hashes of all that their reports say. Prints a line for each.

#include "support/golden_hashes.hpp"

#include <cstdint>
#include <cstdlib>
#include <graze/instruction_set.hpp>
#include <iostream>
#include <memory>
#include <span>
#include <string_view>

#include "scenes/played_scene.hpp"
#include "scenes/report_hash.hpp"
#include "support/thread_pool.hpp"

namespace graze::tests {
namespace {

std::uint64_t play(std::string_view name, unsigned threads) {
  const std::unique_ptr<scenes::PlayedScene> played = scenes::make_played_scene(name);
  SceneSettings settings = played->settings();
  settings.threads = threads;
  Scene scene(settings, threads > 1 ? std::make_shared<examples::ThreadPool>(threads) : nullptr);
  scenes::ReportHash hash;
  for (std::size_t frame = 0; frame < golden_frames; ++frame) {
    played->advance(scene, frame);
    hash.add(*scene.step());
  }
  return hash.value();
}

/// Returns whether a scene has its hash.
bool is_as_everywhere(const Golden& expected, InstructionSet set, unsigned threads) {
  const std::uint64_t hash = play(expected.scene, threads);
  const bool is_equal = hash == expected.hash;
  std::cout << expected.scene << ", " << to_string(set) << ", " << threads << " threads: " << std::hex << hash
            << std::dec << (is_equal ? "" : ", another than everywhere else") << std::endl;
  return is_equal;
}

/// Returns how many hashes are others.
int compare_all(std::span<char* const> thread_counts) {
  int others = 0;
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    for (const Golden& expected : golden_hashes)
      for (const char* const threads : thread_counts)
        others += is_as_everywhere(expected, set, static_cast<unsigned>(std::atoi(threads))) ? 0 : 1;
  }
  return others;
}

}  // namespace
}  // namespace graze::tests

int main(int argc, char** argv) {
  const std::span<char* const> thread_counts(argv + 1, static_cast<std::size_t>(argc - 1));
  return !thread_counts.empty() && graze::tests::compare_all(thread_counts) == 0 ? 0 : 1;
}
