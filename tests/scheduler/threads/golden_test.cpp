// This test compares hashes of all that reports say with committed values. The bits must be the same with any
// number of threads, in every run and on every machine. `graze_studies stress --determinism` does this for
// 300 frames and 20 repeats.

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <array>
#include <graze/scene_enumerators.hpp>
#include <set>

#include "scenes/played_scene.hpp"
#include "scenes/report_hash.hpp"
#include "scheduler/threads/gathering_memory.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/golden_hashes.hpp"

namespace graze::tests {
namespace {

using scenes::PlayedScene;

constexpr std::array<unsigned, 6> thread_counts = {1, 2, 3, 4, 8, 16};
struct Played {
  std::uint64_t hash = 0;
  std::size_t contacts = 0;
  std::set<PairPhase> phases;
  std::set<Inside> insides;
  std::size_t pairs_cut = 0;
  std::size_t impacts = 0;
  std::size_t contacts_of_self = 0;
  std::size_t impacts_of_self = 0;

  /// Adds what another scene reaches.
  void add(const Played& other) {
    phases.insert(other.phases.begin(), other.phases.end());
    insides.insert(other.insides.begin(), other.insides.end());
    pairs_cut += other.pairs_cut;
    impacts += other.impacts;
    contacts_of_self += other.contacts_of_self;
    impacts_of_self += other.impacts_of_self;
  }
};

Played play(std::string_view name, unsigned threads) {
  const std::unique_ptr<PlayedScene> played = scenes::make_played_scene(name);
  SceneSettings settings = played->settings();
  settings.threads = threads;
  Scene scene(settings);
  Played result;
  scenes::ReportHash hash;
  for (std::size_t frame = 0; frame < golden_frames; ++frame) {
    played->advance(scene, frame);
    const ReportHandle report = scene.step();
    hash.add(*report);
    result.contacts += report->contacts().size();
    result.impacts += report->impacts().size();
    for (const PairReport& pair : report->pairs()) {
      result.phases.insert(pair.phase);
      result.insides.insert(pair.inside);
      result.pairs_cut += pair.contacts_cut ? 1U : 0U;
      if (pair.a != pair.b) continue;
      result.contacts_of_self += pair.contact_count;
      result.impacts_of_self += pair.impact_count;
    }
  }
  result.hash = hash.value();
  return result;
}

/// Lets oneTBB have as many threads as a scene is asked to use, on any machine. The library itself never says
/// so.
oneapi::tbb::global_control allow(unsigned threads) {
  return {oneapi::tbb::global_control::max_allowed_parallelism, threads};
}

}  // namespace

TEST_CASE("golden: a step of n threads is worked on by n threads at once") {
  const auto allowed = allow(thread_counts.back());
  for (const unsigned threads : thread_counts) {
    INFO(threads << " threads");
    SceneSettings settings;
    settings.threads = threads;
    Scene scene(settings);
    GatheringMemory memory(threads);
    for (std::size_t i = 0; i < GatheringMemory::page_count; ++i)
      scene.bind_positions(scene.add(GatheringMemory::mesh()), memory.positions(i));
    memory.close();
    const ReportHandle report = scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(memory.threads_seen_at_once() == threads);
  }
}

TEST_CASE("golden: the hash of all reports, for any number of threads and in every run") {
  const auto allowed = allow(thread_counts.back());
  REQUIRE(scenes::played_scene_names().size() == golden_hashes.size());
  Played all;
  for (const Golden& expected : golden_hashes)
    for (std::uint64_t repeat = 0; repeat < repeats(3); ++repeat)
      for (const unsigned threads : thread_counts) {
        if (!at_full_effort && threads != 4) continue;
        INFO(expected.scene << ", " << threads << " threads, repeat " << repeat);
        const Played played = play(expected.scene, threads);
        CHECK(played.hash == expected.hash);
        CHECK(played.contacts > 1000);
        if (repeat == 0 && threads == 4) all.add(played);
      }
  // The scenes reach every phase, every way to be inside, limits and impacts.
  CHECK(all.phases.size() == enumerators<PairPhase>.size());
  CHECK(all.insides.size() == enumerators<Inside>.size());
  CHECK(all.pairs_cut > 100);
  CHECK(all.contacts_of_self > 1000);
  CHECK(all.impacts_of_self > 100);
  CHECK(all.impacts > all.impacts_of_self + 100);
}

}  // namespace graze::tests
