// Accuracy::within: loose distances of pairs that are not in contact, nothing else.

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

bool in_contact(const PairReport& pair) {
  return pair.phase == PairPhase::began || pair.phase == PairPhase::touching;
}

/// Everything about pairs in contact but their rows' places.
std::vector<std::string> contact_rows_of(const FrameReport& report) {
  std::vector<std::string> rows;
  for (const PairReport& pair : report.pairs())
    if (in_contact(pair)) rows.push_back(text_of(report, pair));
  return rows;
}

/// Rounding of the bounds themselves.
constexpr double rounding = 0x1p-40;

}  // namespace

TEST_CASE("within a tolerance bounds hold, and are no wider than it") {
  std::size_t loose = 0;
  for (std::uint64_t seed = 0; seed < repeats(200); ++seed) {
    const oracle::RandomScene given = oracle::random_scene(3000 + seed);
    for (const ContactDetail detail : all_details)
      for (const double tolerance : {0.0, 0.125, 10.0}) {
        SceneSettings settings = settings_of(given.threshold, 100, detail);
        settings.accuracy = Accuracy::within(tolerance);
        Scene scene(settings);
        scene.add(mesh_of(given.a));
        scene.add(mesh_of(given.b));
        const ReportHandle report = scene.step();
        const PairReport& row = only_pair(*report);
        const bool vertices = detail == ContactDetail::regions || detail == ContactDetail::vertices;
        const oracle::Pair truth =
            vertices ? oracle::vertex_distance(given.a, given.b) : oracle::surface_distance(given.a, given.b);
        const auto& [lower, upper] = row.distance;
        INFO("seed " << 3000 + seed << ", tolerance " << tolerance << ": " << lower << ".." << upper
                     << ", truth " << truth.distance_down);
        REQUIRE(lower <= truth.distance_down);
        REQUIRE(upper >= truth.distance_up);
        REQUIRE(std::abs((row.witness.point_b - row.witness.point_a).norm() - upper) <= rounding);
        if (in_contact(row)) {
          REQUIRE(lower == truth.distance_down);
          REQUIRE(upper == truth.distance_up);
        } else {
          REQUIRE(upper - lower <= tolerance + rounding);
        }
        loose += lower < truth.distance_down || upper > truth.distance_up ? 1U : 0U;
        settings.accuracy = Accuracy::exact();
        Scene exact(settings);
        exact.add(mesh_of(given.a));
        exact.add(mesh_of(given.b));
        REQUIRE(contact_rows_of(*report) == contact_rows_of(*exact.step()));
      }
  }
  CHECK(loose > 20);
}

TEST_CASE("within a tolerance contacts and phases of a moving scene are those of exact mode") {
  const MovingScene moving;
  std::size_t loose = 0;
  for (const ContactDetail detail :
       {ContactDetail::features, ContactDetail::closest, ContactDetail::vertices, ContactDetail::nearest}) {
    SceneSettings settings = settings_of(0.05, 0.5, detail);
    const auto exact = moving.play(settings, 20);
    settings.accuracy = Accuracy::within(0.25);
    const auto found = moving.play(settings, 20);
    for (std::size_t frame = 0; frame < 20; ++frame) {
      REQUIRE(contact_rows_of(*found[frame]) == contact_rows_of(*exact[frame]));
      for (const PairReport& truth : exact[frame]->pairs()) {
        // All that is in range, and perhaps more: a loose lower bound lists a pair too.
        const PairReport* const pair = find_pair(*found[frame], truth.a, truth.b);
        REQUIRE(pair != nullptr);
        REQUIRE(pair->phase == truth.phase);
        REQUIRE(pair->distance.lower <= truth.distance.lower);
        REQUIRE(pair->distance.upper >= truth.distance.upper);
        REQUIRE(pair->distance.upper - pair->distance.lower <= 0.25 + rounding);
        loose += pair->distance.upper > truth.distance.upper ? 1U : 0U;
      }
      for (const PairReport& pair : found[frame]->pairs())
        REQUIRE((pair.phase == PairPhase::ended || in_contact(pair) || pair.distance.lower < 0.5));
    }
  }
  CHECK(loose > 20);
}

}  // namespace graze::tests
