// Very large beside very small, exploded, and very many in one place.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

/// The faces of a shape that come near a point, each with its own number of old.
struct Crop {
  Shape shape;
  std::vector<std::uint32_t> faces;
};

Crop crop(const Shape& shape, const Vector3d& centre, double radius) {
  Crop result{{shape.positions, {}}, {}};
  for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
    const auto& corners = shape.faces[face];
    const bool near = std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) {
      return (shape.positions[corner] - centre).norm() < radius;
    });
    if (!near) continue;
    result.shape.faces.push_back(corners);
    result.faces.push_back(face);
  }
  return result;
}

/// A pile of balls that touch their neighbours.
std::vector<Body> pile(std::size_t count) {
  const Shape ball = shape_of(models::sphere(20, 11));
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3d place = 1.95 * Vector3d(static_cast<double>(i % 3), static_cast<double>(i / 3), 0);
    bodies.emplace_back(ball, mapped(turned(ball, i), 1, place));
  }
  return bodies;
}

double median_step_ms(BodyScene& scene, const std::vector<Body>& bodies) {
  std::vector<double> times;
  for (int i = 0; i < 15; ++i) times.push_back(scene.step(bodies)->statistics().times.step_ms);
  std::nth_element(times.begin(), times.begin() + 7, times.end());
  return times[7];
}

/// Compares a pebble over places of the planet with the part of the planet that is near. Counts contacts, and
/// the most region pairs that a step tested.
struct PebbleOverPlanet {
  const Shape& planet;
  const std::shared_ptr<const Mesh>& mesh;
  const Shape& pebble;
  std::size_t contacts = 0;
  std::uint64_t most_work = 0;

  void compare(const Vector3d& place, double height, ContactDetail detail) {
    constexpr double threshold = 1e-6;
    const Shape stone = mapped(pebble, 1, place * (1 + height));
    Scene scene(settings_of(threshold, infinity, detail));
    scene.add(mesh);
    scene.set_positions(scene.add(mesh_of(pebble)), stone.positions);
    const ReportHandle report = scene.step();
    const Crop near = crop(planet, place, 0.1);
    const bool regions = detail == ContactDetail::regions;  // those of the part are others
    const Expected expected = expected_of(near.shape, stone, threshold,
                                          regions ? ContactDetail::vertices : detail, near.shape, pebble);
    const PairReport& row = only_pair(*report);
    CHECK(row.distance.lower == expected.distance.distance_down);
    CHECK(row.distance.upper == expected.distance.distance_up);
    CHECK((row.phase == PairPhase::began) == expected.in_contact);
    most_work = std::max(most_work, report->statistics().work.region_pairs_tested);
    if (!regions) compare(report->contacts(), expected.contacts, near);
  }

  void compare(std::span<const Contact> found, const std::vector<oracle::Named>& expected, const Crop& near) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const oracle::Named& truth = expected[i];
      CHECK(found[i].kind == truth.kind);
      CHECK(found[i].feature_b == truth.b);
      CHECK(found[i].feature_a.kind == truth.a.kind);
      if (truth.a.kind == FeatureKind::face) CHECK(found[i].feature_a.index == near.faces[truth.a.index]);
      if (truth.a.kind == FeatureKind::vertex) CHECK(found[i].feature_a.index == truth.a.index);
      CHECK(std::abs(found[i].distance - truth.distance) <= 0.1 * 0x1p-48);
      ++contacts;
    }
  }
};

}  // namespace

TEST_CASE("a pebble beside a planet of 100,000 faces, sizes 1 to 10^6") {
  const Shape planet = shape_of(models::sphere(250, 201));
  REQUIRE(planet.faces.size() > 100'000);
  const auto mesh = mesh_of(planet);
  const std::vector<Vector3d> places{
      (planet.positions[20000] + planet.positions[20001] + planet.positions[20251]) / 3,  // a face
      (planet.positions[30000] + planet.positions[30001]) / 2,                            // an edge
      planet.positions[40000]};
  for (const std::uint32_t rings : {3U, 5U}) {  // a pebble of one region, and one of eight
    const Shape pebble = mapped(shape_of(models::sphere(8, rings)), 1e-6, Vector3d::Zero());
    PebbleOverPlanet pair{planet, mesh, pebble};
    for (const Vector3d& place : places)
      for (const double height : {0.5e-6, 1.5e-6, 4e-6}) {
        if (!at_full_effort && height == 1.5e-6) continue;
        for (const ContactDetail detail : all_details) {
          INFO("at " << place.transpose() << ", height " << height << ", detail "
                     << static_cast<int>(detail));
          pair.compare(place, height, detail);
        }
      }
    CHECK(pair.contacts > 100);
    CHECK(pair.most_work < 500);
    std::cout << "compared " << pair.contacts << " contacts of a pebble and a planet, at most "
              << pair.most_work << " region pairs a step\n";
  }
}

TEST_CASE("one exploded but finite vertex: the rest exact and at most 1.5 times slower") {
  for (const ContactDetail detail : all_details) {
    INFO("detail " << static_cast<int>(detail));
    const std::vector<Body> whole = pile(18);
    std::vector<Body> exploded = whole;
    exploded[4].now.positions[57] = Vector3d(1e30, -1e29, 1e30);
    const SceneSettings settings = settings_of(0.05, 0.5, detail);
    BodyScene before(whole, settings);
    BodyScene after(whole, settings);
    const ReportHandle expected = before.step(whole);
    const ReportHandle report = after.step(exploded);
    CHECK(report->diagnostics().empty());
    CHECK(inconsistency_of(*report) == "");
    std::size_t compared = 0;
    for (const PairReport& row : expected->pairs()) {
      if (row.a == before.ids()[4] || row.b == before.ids()[4]) continue;
      const PairReport* const now = find_pair(*report, row.a, row.b);
      REQUIRE(now != nullptr);
      CHECK(text_of(*report, *now) == text_of(*expected, row));
      ++compared;
    }
    CHECK(compared > 10);
    // Bounds of the exploded object itself hold: those with the truth that nearby objects give.
    const Expected truth =
        expected_of(exploded[4].now, exploded[5].now, 0.05, detail, exploded[4].rest, exploded[5].rest);
    const PairReport* const own = find_pair(*report, after.ids()[4], after.ids()[5]);
    REQUIRE(own != nullptr);
    CHECK(own->distance.lower == truth.distance.distance_down);
    CHECK(own->distance.upper == truth.distance.distance_up);
    CHECK(difference_of(report->contacts(*own), truth.contacts,
                        Tolerance(exploded[4].now, exploded[5].now)) == "");

    CHECK(report->statistics().work.region_pairs_tested <=
          expected->statistics().work.region_pairs_tested * 3 / 2);
    double slower = infinity;
    for (int attempt = 0; attempt < 5 && slower > 1.5; ++attempt) {
      BodyScene fresh_whole(whole, settings);
      BodyScene fresh_exploded(whole, settings);
      slower = median_step_ms(fresh_exploded, exploded) / median_step_ms(fresh_whole, whole);
    }
    CHECK(slower <= 1.5);
    std::cout << "compared " << compared << " pairs beside an exploded one, region pairs "
              << report->statistics().work.region_pairs_tested << " against "
              << expected->statistics().work.region_pairs_tested << ", time " << slower << " times\n";
  }
}

TEST_CASE("2,000 objects in one place: memory bounded, degradation reported") {
  constexpr std::size_t count = repeats(2'000);
  SceneSettings settings = settings_of(0.01, 0, ContactDetail::features);
  // Too small a budget for the crowd: about 2 million pairs at full size.
  constexpr std::uint64_t budget = 10 * count;
  settings.work_budget = budget;
  Scene scene(settings);
  oracle::Random random(3);
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (int i = 0; i < 20; ++i) {
    const std::array corners{random.vector(0, 1), random.vector(0, 1), random.vector(0, 1)};
    meshes.push_back(mesh_of(triangle(corners[0], corners[1], corners[2])));
  }
  for (std::size_t i = 0; i < count; ++i) scene.add(meshes[i % meshes.size()]);
  std::uint64_t first_bytes = 0;
  for (int frame = 0; frame < 3; ++frame) {
    const ReportHandle report = scene.step();
    const StepStatistics& statistics = report->statistics();
    CHECK(statistics.pairs_total == count * (count - 1) / 2);
    CHECK(statistics.work.region_pairs_tested <= budget);
    CHECK_FALSE(report->complete());
    CHECK(report->diagnostics().empty());
    std::size_t incomplete = 0;
    for (const PairReport& row : report->pairs()) {
      incomplete += row.complete ? 0U : 1U;
      if (!row.complete && row.contact_count != 0) FAIL("contacts of a pair that is not complete");
    }
    CHECK(incomplete > 0);
    // Some 1,350 bytes for every pair that is listed, and a few thousand for every object. A pair has a row
    // in each of two reports, a job, a memory and an answer. A row and an answer have a way out, of 80 bytes.
    // All of these may have grown to more than is used.
    CHECK(statistics.bytes.total() <= report->pairs().size() * 1370 + count * 4500 + 20'000'000);
    if (frame == 1) first_bytes = statistics.bytes.total();
    if (frame == 2) CHECK(statistics.bytes.total() <= first_bytes * 3 / 2);
    if (frame == 0)
      std::cout << "compared " << report->pairs().size() << " pairs of " << count << " objects in one place, "
                << incomplete << " of them said to be incomplete, " << statistics.bytes.total() / 1'000'000
                << " MB\n";
  }
}

}  // namespace graze::tests
