// near, began, touching, ended: what a pair says on its way.

#include <cmath>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {}  // namespace

TEST_CASE("a pair goes through its phases") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverPlate pair(settings_of(0.5, 4, detail));
    const auto expect = [&](double height, PairPhase phase) {
      const ReportHandle report = pair.step_at(height);
      const PairReport& row = only_pair(*report);
      CHECK(row.phase == phase);
      CHECK(row.a == pair.plate);
      CHECK(row.b == pair.needle);
      CHECK(row.distance.lower == height);
      CHECK(row.distance.upper == height);
      CHECK(row.witness.point_a == Eigen::Vector3d(0.25, 0.5, 0));
      CHECK(row.witness.point_b == Eigen::Vector3d(0.25, 0.5, height));
      CHECK(row.witness.feature_a == Feature{FeatureKind::face, 0});
      CHECK(row.witness.feature_b == Feature{FeatureKind::vertex, 0});
      CHECK(row.complete);
      CHECK_FALSE(row.stale);
      const bool in_contact = phase == PairPhase::began || phase == PairPhase::touching;
      const std::size_t expected = in_contact && detail != ContactDetail::none ? 1 : 0;
      REQUIRE(report->contacts(row).size() == expected);
      if (expected == 1) CHECK(report->contacts(row)[0].distance == height);
      CHECK(inconsistency_of(*report) == "");
      CHECK(report->statistics().pairs_in_contact == (in_contact ? 1 : 0));
      CHECK(report->statistics().contacts == expected);
    };
    CHECK(pair.step_at(4)->pairs().empty());
    expect(3, PairPhase::near);
    expect(3, PairPhase::near);
    expect(0.25, PairPhase::began);
    expect(0.25, PairPhase::touching);
    expect(0, PairPhase::touching);
    expect(0.5, PairPhase::ended);
    expect(0.5, PairPhase::near);
    expect(0.375, PairPhase::began);
    expect(1024, PairPhase::ended);  // once, even beyond range
    CHECK(pair.step_at(1024)->pairs().empty());
    CHECK(pair.step_at(1024)->pairs().empty());
    expect(0.25, PairPhase::began);
    expect(0x1p60, PairPhase::ended);
    CHECK(pair.scene.step()->pairs().empty());
  }
}

TEST_CASE("a pair that begins and ends between two steps is not seen") {
  NeedleOverPlate pair(settings_of(0.5, 4));
  CHECK(only_pair(*pair.step_at(2)).phase == PairPhase::near);
  pair.lift(0.25);
  CHECK(only_pair(*pair.step_at(2)).phase == PairPhase::near);
}

TEST_CASE("an edge that pierces a face is a contact at every threshold, 0 included") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverPlate pair(settings_of(0, 0, detail));
    CHECK(pair.step_at(1)->pairs().empty());
    const ReportHandle report = pair.step_at(-1);
    const PairReport& row = only_pair(*report);
    CHECK(row.phase == PairPhase::began);
    CHECK(row.distance.lower == 0);
    CHECK(row.distance.upper == 0);
    if (detail == ContactDetail::features) {
      REQUIRE(report->contacts(row).size() == 2);  // both long edges of the needle
      for (const Contact& contact : report->contacts(row)) {
        CHECK(contact.kind == ContactKind::EF);
        CHECK(contact.distance == 0);
        CHECK(contact.feature_a == Feature{FeatureKind::face, 0});
        CHECK(contact.point_a.z() == 0);
        CHECK(contact.point_b.z() == 0);
      }
    }
    if (detail == ContactDetail::closest) {
      REQUIRE(report->contacts(row).size() == 1);
      CHECK(report->contacts(row)[0].kind == ContactKind::EF);
    }
    CHECK(only_pair(*pair.step_at(-1)).phase == PairPhase::touching);
    CHECK(only_pair(*pair.step_at(5)).phase == PairPhase::ended);
  }
}

TEST_CASE("surfaces that touch and do not pierce are no contact at threshold 0") {
  for (const ContactDetail detail : surface_details) {
    NeedleOverPlate listed(settings_of(0, 0.5, detail));
    const ReportHandle report = listed.step_at(0);
    CHECK(only_pair(*report).phase == PairPhase::near);
    CHECK(only_pair(*report).distance.upper == 0);
    NeedleOverPlate alone(settings_of(0, 0, detail));
    CHECK(alone.step_at(0)->pairs().empty());
  }
}

TEST_CASE("a body wholly inside another without touching is not in contact") {
  for (const ContactDetail detail : surface_details) {
    Scene scene(settings_of(0.5, 2, detail));
    scene.add(mesh_of(models::box({4, 4, 4})));
    scene.add(mesh_of(models::box({2, 2, 2})));
    const ReportHandle report = scene.step();
    CHECK(only_pair(*report).phase == PairPhase::near);
    CHECK(only_pair(*report).distance.upper == 1);
    CHECK(report->contacts().empty());
  }
}

TEST_CASE("two objects in one place are at distance 0, with finite normals") {
  for (const ContactDetail detail : all_details) {
    Scene scene(settings_of(0.125, 1, detail));
    const auto mesh = mesh_of(models::torus(8, 6, 1, 0.25));
    scene.add(mesh);
    scene.add(mesh);
    const ReportHandle report = scene.step();
    CHECK(only_pair(*report).phase == PairPhase::began);
    CHECK(only_pair(*report).distance.upper == 0);
    CHECK(report->contacts().empty() == (detail == ContactDetail::none));
    CHECK(inconsistency_of(*report) == "");
  }
}

TEST_CASE("phases are a pair's own") {
  Scene scene(settings_of(0.5, 4));
  const ObjectId plate = scene.add(plate_mesh());
  std::array<ObjectId, 3> needles;
  for (ObjectId& needle : needles) needle = scene.add(needle_mesh());
  const auto step_at = [&](double first, double second, double third) {
    const std::array<double, 3> heights = {first, second, third};
    for (std::size_t i = 0; i < 3; ++i)
      scene.set_positions(needles[i],
                          moved(needle_mesh()->rest(), {0.5 * static_cast<double>(i) - 1,
                                                        -1.0 * static_cast<double>(i % 2), heights[i]}));
    const ReportHandle report = scene.step();
    std::array<PairPhase, 3> phases{};
    for (std::size_t i = 0; i < 3; ++i) {
      const PairReport* const row = find_pair(*report, plate, needles[i]);
      REQUIRE(row != nullptr);
      CHECK(row->distance.upper == heights[i]);
      phases[i] = row->phase;
    }
    return phases;
  };
  using Phases = std::array<PairPhase, 3>;
  CHECK(step_at(0.25, 1, 2) == Phases{PairPhase::began, PairPhase::near, PairPhase::near});
  CHECK(step_at(0.25, 0.25, 2) == Phases{PairPhase::touching, PairPhase::began, PairPhase::near});
  CHECK(step_at(1, 0.25, 0.25) == Phases{PairPhase::ended, PairPhase::touching, PairPhase::began});
  CHECK(step_at(1, 0.25, 3) == Phases{PairPhase::near, PairPhase::touching, PairPhase::ended});
}

}  // namespace graze::tests
