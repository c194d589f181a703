// Thresholds: margins, kinds and their rules, and down to which distance a pair is listed.

#include <cmath>
#include <limits>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
ObjectSettings with_margin(double margin) {
  ObjectSettings settings;
  settings.margin = margin;
  return settings;
}

ObjectSettings with_kind(std::uint32_t kind) {
  ObjectSettings settings;
  settings.kind = kind;
  return settings;
}

bool in_contact(const ReportHandle& report) {
  const PairPhase phase = only_pair(*report).phase;
  return phase == PairPhase::began || phase == PairPhase::touching;
}

double below(double value) {
  return std::nextafter(value, -infinity);
}

}  // namespace

TEST_CASE("strictly below the threshold counts, equal does not") {
  for (const ContactDetail detail : surface_details)
    for (const double threshold : {0.5, 0.1, 1.0 / 3}) {
      NeedleOverPlate pair(settings_of(threshold, 4, detail));
      CHECK(only_pair(*pair.step_at(threshold)).phase == PairPhase::near);
      CHECK(only_pair(*pair.step_at(below(threshold))).phase == PairPhase::began);
      CHECK(only_pair(*pair.step_at(threshold)).phase == PairPhase::ended);
      CHECK(only_pair(*pair.step_at(std::nextafter(threshold, infinity))).phase == PairPhase::near);
    }
}

TEST_CASE("the threshold of a pair has both margins: contact_distance + (margin(a) + margin(b))") {
  const double threshold = 0.1 + (0.2 + 0.7);
  REQUIRE(threshold != (0.1 + 0.2) + 0.7);  // so that the order of the additions shows
  for (const ContactDetail detail : surface_details) {
    NeedleOverPlate pair(settings_of(0.1, 0, detail), with_margin(0.2), with_margin(0.7));
    CHECK(pair.step_at(threshold)->pairs().empty());
    CHECK(in_contact(pair.step_at(below(threshold))));
    CHECK(only_pair(*pair.step_at(threshold)).phase == PairPhase::ended);
  }
}

TEST_CASE("a pair is listed strictly below the larger of range and threshold") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverPlate wide(settings_of(0.1, 0.7, detail));
    CHECK(wide.step_at(0.7)->pairs().empty());
    CHECK(only_pair(*wide.step_at(below(0.7))).phase == PairPhase::near);
    CHECK(wide.step_at(std::nextafter(0.7, 1.0))->pairs().empty());
    NeedleOverPlate narrow(settings_of(0.7, 0.1, detail));
    CHECK(narrow.step_at(0.7)->pairs().empty());
    CHECK(in_contact(narrow.step_at(below(0.7))));
  }
}

TEST_CASE("margins do not widen the range") {
  NeedleOverPlate pair(settings_of(0, 1), with_margin(0.25), with_margin(0.25));
  CHECK(pair.step_at(1)->pairs().empty());
  CHECK(only_pair(*pair.step_at(below(1))).phase == PairPhase::near);
  CHECK(only_pair(*pair.step_at(0.5)).phase == PairPhase::near);
  CHECK(in_contact(pair.step_at(below(0.5))));
}

TEST_CASE("with an infinite range every pair is listed") {
  for (const ContactDetail detail : all_details) {
    Scene scene(settings_of(0.5, infinity, detail));
    std::vector<ObjectId> ids;
    for (int i = 0; i < 5; ++i) {
      ids.push_back(scene.add(plate_mesh()));
      scene.set_positions(ids.back(), lifted(*plate_mesh(), std::ldexp(1.0, 20 * i)));
    }
    const ReportHandle report = scene.step();
    CHECK(report->pairs().size() == 10);
    for (std::size_t a = 0; a < 5; ++a)
      for (std::size_t b = a + 1; b < 5; ++b) {
        const PairReport* const pair = find_pair(*report, ids[a], ids[b]);
        REQUIRE(pair != nullptr);
        const double truth =
            std::ldexp(1.0, 20 * static_cast<int>(b)) - std::ldexp(1.0, 20 * static_cast<int>(a));
        CHECK(pair->distance.lower <= truth);
        CHECK(pair->distance.upper >= truth);
        CHECK(std::nextafter(pair->distance.lower, infinity) >= pair->distance.upper);
      }
  }
}

TEST_CASE("a rule is for its kinds in either order, and for no others") {
  for (const auto& [first, second] : {std::pair(0U, 255U), std::pair(255U, 0U)}) {
    Scene scene(settings_of(0.5, 1));
    const ObjectId plate = scene.add(plate_mesh(), with_kind(0));
    const ObjectId needle = scene.add(needle_mesh(), with_kind(255));
    const ObjectId other = scene.add(needle_mesh(), with_kind(7));
    scene.set_positions(needle, lifted(*needle_mesh(), 2));
    scene.set_positions(other, moved(needle_mesh()->rest(), {-1, -1, 2}));
    CHECK(find_pair(*scene.step(), plate, needle) == nullptr);
    scene.set_rule(first, second, {3, 3, {}});
    const ReportHandle report = scene.step();
    REQUIRE(find_pair(*report, plate, needle) != nullptr);
    CHECK(find_pair(*report, plate, needle)->phase == PairPhase::began);
    CHECK(find_pair(*report, plate, other) == nullptr);
  }
}

TEST_CASE("a rule's threshold and range take the place of the scene's, smaller or larger") {
  NeedleOverPlate pair(settings_of(0.5, 4), with_kind(3), with_kind(3));
  CHECK(in_contact(pair.step_at(0.25)));
  pair.scene.set_rule(3, 3, {0.125, 2, {}});
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::ended);
  CHECK(only_pair(*pair.step_at(below(2))).phase == PairPhase::near);
  CHECK(pair.step_at(2)->pairs().empty());
  pair.scene.set_rule(3, 3, {1, 0, {}});  // the later rule counts
  CHECK(pair.step_at(1)->pairs().empty());
  CHECK(in_contact(pair.step_at(below(1))));
  pair.scene.set_rule(3, 3, {1, infinity, {}});
  CHECK(only_pair(*pair.step_at(4096)).phase == PairPhase::ended);
  CHECK(only_pair(*pair.step_at(4096)).phase == PairPhase::near);
}

TEST_CASE("what a rule does not name is that of the scene, and an empty rule takes the last one back") {
  NeedleOverPlate pair(settings_of(0.5, 4));
  pair.scene.set_rule(0, 0, {.contact_distance = 1});
  CHECK(in_contact(pair.step_at(below(1))));
  CHECK(only_pair(*pair.step_at(below(4))).phase == PairPhase::ended);
  CHECK(only_pair(*pair.step_at(below(4))).phase == PairPhase::near);
  pair.scene.set_rule(0, 0, {.range = 2});
  CHECK(pair.step_at(below(4))->pairs().empty());
  CHECK(only_pair(*pair.step_at(1)).phase == PairPhase::near);
  CHECK(in_contact(pair.step_at(below(0.5))));
  pair.scene.set_rule(0, 0, {});
  CHECK(only_pair(*pair.step_at(below(4))).phase == PairPhase::ended);
  CHECK(only_pair(*pair.step_at(below(4))).phase == PairPhase::near);
  CHECK(pair.step_at(4)->pairs().empty());
}

TEST_CASE("a rule's threshold has the margins too") {
  ObjectSettings plate = with_margin(0.25);
  plate.kind = 1;
  NeedleOverPlate pair(settings_of(9, 9), plate, with_margin(0.5));
  pair.scene.set_rule(0, 1, {0.25, 0, {}});
  CHECK(pair.step_at(1)->pairs().empty());
  CHECK(in_contact(pair.step_at(below(1))));
}

TEST_CASE("details about vertices measure and compare distances of vertices") {
  for (const ContactDetail detail : {ContactDetail::vertices, ContactDetail::regions}) {
    Scene scene(settings_of(0.5, 0.75, detail));
    const ObjectId plate = scene.add(plate_mesh());
    const ObjectId needle = scene.add(needle_mesh());
    // The tip is in the middle of the plate: no contact of vertices, though the surfaces touch.
    CHECK(scene.step()->pairs().empty());
    scene.set_positions(needle, moved(needle_mesh()->rest(), {0.75, 0.5, 0.5}));
    const ReportHandle equal = scene.step();
    CHECK(find_pair(*equal, plate, needle)->phase == PairPhase::near);
    CHECK(find_pair(*equal, plate, needle)->distance.upper == 0.5);
    scene.set_positions(needle, moved(needle_mesh()->rest(), {0.75, 0.5, below(0.5)}));
    const ReportHandle closer = scene.step();
    CHECK(find_pair(*closer, plate, needle)->phase == PairPhase::began);
    REQUIRE(closer->contacts().size() == 1);
    CHECK(closer->contacts()[0].kind == ContactKind::VV);
    CHECK(closer->contacts()[0].feature_a == Feature{FeatureKind::vertex, 2});
    CHECK(closer->contacts()[0].feature_b == Feature{FeatureKind::vertex, 0});
  }
}

}  // namespace graze::tests
