// Bound memory that cannot be read: the object stands still, and its listed pairs say their last values.

#include <algorithm>
#include <limits>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A bound needle over a plate, and a second plate 3 above the first, out of the needle's way.
struct Stage : NeedleOverPlate {
  explicit Stage(const SceneSettings& settings, BindPolicy policy = BindPolicy::every_step)
      : NeedleOverPlate(settings) {
    other = scene.add(plate_mesh());
    scene.set_positions(other, moved(plate_mesh()->rest(), {5, 5, 3}));
    scene.bind_positions(needle, memory, policy);
  }
  void write(double height) {
    const Positions now = lifted(*needle_mesh(), height);
    std::copy(now.begin(), now.end(), memory.begin());
  }
  ReportHandle step_at(double height) {
    write(height);
    return scene.step();
  }
  ReportHandle step_with(double bad) {
    memory[1].y() = bad;
    return scene.step();
  }
  [[nodiscard]] const PairReport& row(const ReportHandle& report) const {
    const PairReport* const pair = find_pair(*report, plate, needle);
    REQUIRE(pair != nullptr);
    return *pair;
  }

  ObjectId other;
  Positions memory = lifted(*needle_mesh(), 4);
};

void check_same_values(const ReportHandle& now, const PairReport& row, const ReportHandle& then,
                       const PairReport& old) {
  PairReport unmarked = row;
  unmarked.stale = old.stale;
  unmarked.phase = old.phase;
  CHECK(text_of(*now, unmarked) == text_of(*then, old));
}

}  // namespace

TEST_CASE("a frozen object's pairs repeat their last values, contacts and all, until good input is read") {
  Stage stage(settings_of(0.5, 100));
  stage.step_at(0.375);
  const ReportHandle last = stage.step_at(0.25);
  CHECK(stage.row(last).phase == PairPhase::touching);
  CHECK(last->contacts(stage.row(last)).size() == 1);
  for (int i = 0; i < 3; ++i) {
    const ReportHandle report = stage.step_with(nothing);
    REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
    CHECK(report->diagnostics()[0].object == stage.needle);
    CHECK(report->diagnostics()[0].message.find("vertex 1") != std::string::npos);
    CHECK(stage.row(report).stale);
    CHECK(stage.row(report).phase == PairPhase::touching);
    check_same_values(report, stage.row(report), last, stage.row(last));
    CHECK(find_pair(*report, stage.needle, stage.other)->stale);
    CHECK_FALSE(find_pair(*report, stage.plate, stage.other)->stale);
    CHECK(report->pairs().size() == 3);
    CHECK(inconsistency_of(*report) == "");
  }
  const ReportHandle good = stage.step_at(0.125);
  CHECK(good->diagnostics().empty());
  CHECK_FALSE(stage.row(good).stale);
  CHECK(stage.row(good).phase == PairPhase::touching);
  CHECK(stage.row(good).distance.upper == 0.125);
  CHECK(stage.row(stage.step_at(3)).phase == PairPhase::ended);
}

TEST_CASE("infinity and coordinates beyond 2^120 freeze as NaN does") {
  Stage stage(settings_of(0.5, 100));
  stage.step_at(2);
  const ReportHandle infinite = stage.step_with(-std::numeric_limits<double>::infinity());
  CHECK(kinds_of(*infinite) == std::vector{DiagnosticKind::not_finite});
  const ReportHandle large = stage.step_with(0x1.8p120);
  CHECK(kinds_of(*large) == std::vector{DiagnosticKind::too_large});
  CHECK(stage.row(large).stale);
  CHECK(stage.row(large).distance.upper == 2);
}

TEST_CASE("a contact that began and then froze does not begin again") {
  Stage stage(settings_of(0.5, 100));
  stage.step_at(2);
  CHECK(stage.row(stage.step_at(0.25)).phase == PairPhase::began);
  const ReportHandle frozen = stage.step_with(nothing);
  CHECK(stage.row(frozen).phase == PairPhase::touching);
  CHECK(frozen->contacts(stage.row(frozen)).size() == 1);
  CHECK(stage.row(stage.step_at(0.25)).phase == PairPhase::touching);
}

TEST_CASE("a contact that ended and then froze ended once") {
  Stage in_range(settings_of(0.5, 100));
  in_range.step_at(0.25);
  CHECK(in_range.row(in_range.step_at(2)).phase == PairPhase::ended);
  const ReportHandle frozen = in_range.step_with(nothing);
  CHECK(in_range.row(frozen).phase == PairPhase::near);
  CHECK(in_range.row(frozen).distance.upper == 2);
  CHECK(in_range.row(frozen).stale);

  Stage out_of_range(settings_of(0.5, 1));
  out_of_range.step_at(0.25);
  CHECK(out_of_range.row(out_of_range.step_at(2)).phase == PairPhase::ended);
  CHECK(find_pair(*out_of_range.step_with(nothing), out_of_range.plate, out_of_range.needle) == nullptr);
}

TEST_CASE("pairs that were not listed are not while frozen, and are found afterwards") {
  Stage stage(settings_of(0.5, 1));
  stage.step_at(2);
  // The plate comes to where the frozen needle stands.
  stage.scene.set_positions(stage.plate, lifted(*plate_mesh(), 1.75));
  CHECK(stage.step_with(nothing)->pairs().empty());
  const ReportHandle report = stage.step_at(2);
  CHECK(stage.row(report).phase == PairPhase::began);
  CHECK(stage.row(report).distance.upper == 0.25);
}

TEST_CASE("a needle that was never read stands at its rest shape and is in no pair") {
  Stage stage(settings_of(0.5, 100));
  const ReportHandle report = stage.step_with(nothing);
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
  CHECK(report->pairs().size() == 1);
  CHECK(find_pair(*report, stage.plate, stage.other) != nullptr);
  SECTION("nor is it when its memory is let go of") {
    stage.scene.unbind_positions(stage.needle);
    CHECK(kinds_of(*stage.scene.step()) == std::vector{DiagnosticKind::not_finite});
    const ReportHandle after = stage.scene.step();
    CHECK(after->diagnostics().empty());
    CHECK(after->pairs().size() == 1);
  }
  SECTION("until it has good positions") {
    stage.scene.set_positions(stage.needle, lifted(*needle_mesh(), 0));
    const ReportHandle at_rest = stage.scene.step();
    CHECK(at_rest->diagnostics().empty());
    CHECK(stage.row(at_rest).distance.upper == 0);
    CHECK(stage.row(at_rest).phase == PairPhase::began);
  }
}

TEST_CASE("memory bound when told is read again until it is good") {
  Stage stage(settings_of(0.5, 100), BindPolicy::when_told);
  stage.step_at(2);
  stage.scene.positions_changed(stage.needle);
  CHECK(kinds_of(*stage.step_with(nothing)) == std::vector{DiagnosticKind::not_finite});
  CHECK(kinds_of(*stage.scene.step()) == std::vector{DiagnosticKind::not_finite});
  const ReportHandle good = stage.step_at(3);
  CHECK(good->diagnostics().empty());
  CHECK(stage.row(good).distance.upper == 3);
  CHECK(stage.row(stage.step_at(4)).distance.upper == 3);
}

TEST_CASE("copying or binding other memory ends the freeze, unbinding does not") {
  Stage stage(settings_of(0.5, 100));
  stage.step_at(2);
  stage.step_with(nothing);
  SECTION("copied") {
    stage.scene.set_positions(stage.needle, lifted(*needle_mesh(), 5));
    const ReportHandle report = stage.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK_FALSE(stage.row(report).stale);
    CHECK(stage.row(report).distance.upper == 5);
  }
  SECTION("unbound, and copied later") {
    stage.scene.unbind_positions(stage.needle);
    CHECK(kinds_of(*stage.scene.step()) == std::vector{DiagnosticKind::not_finite});
    const ReportHandle frozen = stage.scene.step();
    CHECK(frozen->diagnostics().empty());
    CHECK(stage.row(frozen).stale);
    CHECK(stage.row(frozen).distance.upper == 2);
    stage.scene.set_positions(stage.needle, lifted(*needle_mesh(), 5));
    const ReportHandle report = stage.scene.step();
    CHECK_FALSE(stage.row(report).stale);
    CHECK(stage.row(report).distance.upper == 5);
  }
  SECTION("unbound when its memory has become good again") {
    stage.write(4);
    stage.scene.unbind_positions(stage.needle);
    const ReportHandle report = stage.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK_FALSE(stage.row(report).stale);
    CHECK(stage.row(report).distance.upper == 4);
  }
  SECTION("bound to other memory") {
    const Positions good = lifted(*needle_mesh(), 6);
    stage.scene.bind_positions(stage.needle, good);
    const ReportHandle report = stage.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(stage.row(report).distance.upper == 6);
  }
  SECTION("removed") {
    stage.scene.remove(stage.needle);
    const ReportHandle report = stage.scene.step();
    CHECK(report->diagnostics().empty());
    CHECK(report->pairs().size() == 1);
  }
}

TEST_CASE("a pair is frozen while either object is, and both") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  Positions plate = lifted(*plate_mesh(), 0);
  Positions needle = lifted(*needle_mesh(), 0.25);
  pair.scene.bind_positions(pair.plate, plate);
  pair.scene.bind_positions(pair.needle, needle);
  pair.scene.step();
  const auto step = [&](double plate_x, double needle_x) {
    plate[0].x() = plate_x;
    needle[0].x() = needle_x;
    ReportHandle report = pair.scene.step();
    CHECK(only_pair(*report).phase == PairPhase::touching);
    CHECK(only_pair(*report).distance.upper == 0.25);
    CHECK(report->contacts().size() == 1);
    return report;
  };
  const ReportHandle both = step(nothing, nothing);
  CHECK(both->diagnostics().size() == 2);
  CHECK(both->diagnostics()[0].object == pair.plate);
  CHECK(both->diagnostics()[1].object == pair.needle);
  CHECK(only_pair(*both).stale);
  CHECK(only_pair(*step(nothing, 0.25)).stale);
  CHECK(only_pair(*step(-1, nothing)).stale);
  CHECK_FALSE(only_pair(*step(-1, 0.25)).stale);
}

TEST_CASE("a frozen pair that is taken out ends once") {
  Stage stage(settings_of(0.5, 100));
  stage.step_at(0.25);
  stage.scene.ignore(stage.plate, stage.needle);
  const ReportHandle ended = stage.step_with(nothing);
  CHECK(stage.row(ended).phase == PairPhase::ended);
  CHECK(stage.row(ended).stale);
  CHECK(ended->contacts().empty());
  CHECK(stage.row(ended).distance.upper == 0.25);
  CHECK(find_pair(*stage.step_with(nothing), stage.plate, stage.needle) == nullptr);
  CHECK(find_pair(*stage.step_at(0.25), stage.plate, stage.needle) == nullptr);
}

TEST_CASE("a frozen pair that is taken out leaves no contacts out any more") {
  SceneSettings settings = settings_of(20, 100);
  settings.max_contacts_per_pair = 1;
  Stage stage(settings);
  stage.step_at(0.25);
  const ReportHandle last = stage.step_at(0.25);
  REQUIRE(stage.row(last).contacts_cut);
  const std::size_t cut = last->statistics().pairs_cut;
  stage.scene.ignore(stage.plate, stage.needle);
  const ReportHandle ended = stage.step_with(nothing);
  CHECK(stage.row(ended).phase == PairPhase::ended);
  CHECK(stage.row(ended).stale);
  CHECK(stage.row(ended).contact_count == 0);
  CHECK_FALSE(stage.row(ended).contacts_cut);
  CHECK(stage.row(ended).complete);
  CHECK(ended->statistics().pairs_cut == cut - 1);
  CHECK(inconsistency_of(*ended) == "");
}

}  // namespace graze::tests
