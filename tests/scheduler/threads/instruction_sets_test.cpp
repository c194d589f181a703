// The report is the same bit for bit, counters included, with the kernels of every instruction set.

#include <graze/instruction_set.hpp>
#include <iostream>

#include "core/pair/pair_query.hpp"
#include "scenes/played_scene.hpp"
#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Requires that two steps counted the same. Their times may differ.
void require_same_counters(const StepStatistics& mine, const StepStatistics& theirs) {
  REQUIRE(mine.pairs_tested == theirs.pairs_tested);
  REQUIRE(mine.work.region_pairs_tested == theirs.work.region_pairs_tested);
  REQUIRE(mine.work.leaf_pairs_tested == theirs.work.leaf_pairs_tested);
  REQUIRE(mine.work.discarded_in_float == theirs.work.discarded_in_float);
  REQUIRE(mine.work.named_in_float == theirs.work.named_in_float);
  REQUIRE(mine.work.decided_in_double == theirs.work.decided_in_double);
  REQUIRE(mine.work.exact_decisions == theirs.work.exact_decisions);
  REQUIRE(mine.work.regions_expanded == theirs.work.regions_expanded);
}

/// Runs `play`, which gives reports, once for each instruction set, and compares them with plain code's.
/// Returns how many pairs float discarded.
template <typename Play>
std::uint64_t compare_instruction_sets(const Play& play) {
  const InstructionSet before = instruction_set();
  use_instruction_set(InstructionSet::scalar);
  const std::vector<ReportHandle> expected = play();
  std::uint64_t discarded = 0;
  for (const ReportHandle& report : expected) discarded += report->statistics().work.discarded_in_float;
  for (const InstructionSet set : available_instruction_sets()) {
    if (set == InstructionSet::scalar) continue;
    use_instruction_set(set);
    const std::vector<ReportHandle> found = play();
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      INFO(to_string(set) << ", report " << i);
      REQUIRE(difference_of(*found[i], *expected[i]) == "");
      require_same_counters(found[i]->statistics(), expected[i]->statistics());
    }
  }
  use_instruction_set(before);
  return discarded;
}

std::vector<Accuracy> accuracies_of(ContactDetail detail) {
  std::vector<Accuracy> accuracies{Accuracy::exact(), Accuracy::within(0.02)};
  if (is_about_vertices(detail)) {
    accuracies.push_back(Accuracy::paper());
    accuracies.push_back(Accuracy::paper({0.8, 0.4, 0.1}));
  }
  return accuracies;
}

/// The reports of a scene of each of many seeds.
std::vector<ReportHandle> step_random_scenes(ContactDetail detail, const Accuracy& accuracy) {
  std::vector<ReportHandle> reports;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const oracle::RandomScene random = oracle::random_scene(seed);
    SceneSettings settings;
    settings.contact_distance = random.threshold;
    settings.range = 2 * random.threshold + 1;
    settings.detail = detail;
    settings.accuracy = accuracy;
    settings.threads = 1;
    Scene scene(settings);
    scene.add(mesh_of(random.a));
    scene.add(mesh_of(random.b));
    reports.push_back(scene.step());
  }
  return reports;
}

}  // namespace

TEST_CASE("a moving scene's reports are the same bit for bit with every instruction set") {
  const MovingScene moving;
  std::size_t runs = 0;
  for (const ContactDetail detail : all_details)
    for (const Accuracy& accuracy : accuracies_of(detail)) {
      SceneSettings settings = settings_of(0.05, 0.25, detail);
      settings.accuracy = accuracy;
      settings.threads = 2;
      CHECK(compare_instruction_sets([&] { return moving.play(settings, 12); }) > 3'000);
      ++runs;
    }
  std::cout << "compared " << available_instruction_sets().size() << " instruction sets in " << runs
            << " runs of 12 frames\n";
}

TEST_CASE(
    "reports about solids, groups, limits, replaced meshes and sweeps are the same with every instruction "
    "set") {
  for (const std::string_view name : {"solids", "limits", "seams", "self", "swept"})
    CHECK(compare_instruction_sets([&] {
            const auto played = scenes::make_played_scene(name);
            SceneSettings settings = played->settings();
            settings.threads = 1;
            Scene scene(settings);
            std::vector<ReportHandle> reports;
            for (std::size_t frame = 0; frame < 8; ++frame) {
              played->advance(scene, frame);
              reports.push_back(scene.step());
            }
            return reports;
          }) > 1'000);
}

TEST_CASE("random scenes' reports are the same bit for bit with every instruction set") {
  std::size_t scenes = 0;
  for (const ContactDetail detail : all_details)
    for (const Accuracy& accuracy : accuracies_of(detail)) {
      CHECK(compare_instruction_sets([&] { return step_random_scenes(detail, accuracy); }) > 100);
      scenes += 200;
    }
  std::cout << "compared " << scenes << " scenes\n";
}

}  // namespace graze::tests
