// Whole scenes against brute force in exact arithmetic, for every detail.

#include <iostream>
#include <limits>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/comparison.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Compares one row, or its absence, with what brute force says.
void check_pair(const FrameReport& report, const PairReport* row, const Tolerance& tolerance,
                const Expected& expected, double reach) {
  const bool listed = expected.in_contact || is_within(expected.distance, reach);
  REQUIRE((row != nullptr) == listed);
  if (row == nullptr) return;
  REQUIRE((row->phase == PairPhase::began) == expected.in_contact);
  REQUIRE(difference_of(row->distance, row->witness, expected.distance, tolerance) == "");
  REQUIRE(difference_of(report.contacts(*row), expected.contacts, tolerance) == "");
}

}  // namespace

TEST_CASE("two objects: bounds, contacts and listing are those of brute force") {
  constexpr std::uint64_t seed_count = 200;
  std::size_t contacts = 0;
  std::size_t unlisted = 0;
  for (std::uint64_t seed = 0; seed < seed_count; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(1000 + seed);
    INFO("seed " << 1000 + seed << "\na: " << text_of(given.a) << "b: " << text_of(given.b));
    for (const ContactDetail detail : all_details) {
      const double range =
          seed % 3 == 0 ? std::numeric_limits<double>::infinity() : given.threshold / 2 + 0.25;
      Scene scene(settings_of(given.threshold, range, detail));
      const ObjectId a = scene.add(mesh_of(given.a));
      const ObjectId b = scene.add(mesh_of(given.b));
      const ReportHandle report = scene.step();
      REQUIRE(inconsistency_of(*report) == "");
      const Expected expected = expected_of(given.a, given.b, given.threshold, detail);
      check_pair(*report, find_pair(*report, a, b), {given.a, given.b}, expected,
                 std::max(range, given.threshold));
      contacts += report->contacts().size();
      unlisted += report->pairs().empty() ? 1U : 0U;
    }
  }
  CHECK(contacts > 1000);
  CHECK(unlisted > 20);
  std::cout << "compared " << seed_count * all_details.size() << " scenes, " << contacts << " contacts\n";
}

TEST_CASE("six objects: each of their fifteen pairs is that of brute force") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 16; ++seed) {
    std::vector<oracle::Shape> shapes;
    double threshold = 0;
    for (std::uint64_t i = 0; i < 3; ++i) {
      const oracle::RandomScene given = oracle::random_scene(5000 + 3 * seed + i);
      shapes.push_back(given.a);
      shapes.push_back(given.b);
      threshold = std::max(threshold, given.threshold);
    }
    for (const ContactDetail detail : all_details) {
      SceneSettings settings = settings_of(threshold, 1, detail);
      settings.threads = 2;
      Scene scene(settings);
      std::vector<ObjectId> ids;
      for (const oracle::Shape& shape : shapes) ids.push_back(scene.add(mesh_of(shape)));
      const ReportHandle report = scene.step();
      REQUIRE(inconsistency_of(*report) == "");
      contacts += report->contacts().size();
      for (std::size_t a = 0; a < ids.size(); ++a)
        for (std::size_t b = a + 1; b < ids.size(); ++b) {
          INFO("seed " << seed << ", objects " << a << " and " << b);
          check_pair(*report, find_pair(*report, ids[a], ids[b]), {shapes[a], shapes[b]},
                     expected_of(shapes[a], shapes[b], threshold, detail), 1);
        }
    }
  }
  CHECK(contacts > 1000);
}

}  // namespace graze::tests
