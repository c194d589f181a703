// What swept objects meet between two steps: which pairs are swept, what reports say of them, and when an
// object stands at its new place.

#include <algorithm>
#include <cmath>
#include <graze/graze.hpp>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;

ObjectSettings swept(Motion motion = Motion::deformable) {
  ObjectSettings settings;
  settings.motion = motion;
  settings.swept = true;
  return settings;
}

/// Whether a time of impact is this one, and not above it.
bool is_at(double time, double expected) {
  return time <= expected && time > expected - 1e-5;
}

/// Writes positions into memory that stays where it is.
void put(Positions& memory, const Positions& positions) {
  std::copy(positions.begin(), positions.end(), memory.begin());
}

/// A needle over a plate, of which the needle is swept.
NeedleOverPlate dart_over_plate(const SceneSettings& settings = settings_of(0.01, 0)) {
  return NeedleOverPlate(settings, {}, swept());
}

TEST_CASE("A swept pair that passes in one step is listed with what met") {
  for (const ContactDetail detail : all_details) {
    CAPTURE(name_of(detail));
    NeedleOverPlate scene = dart_over_plate(settings_of(0.01, 0, detail));
    CHECK(scene.step_at(1)->pairs().empty());
    const ReportHandle report = scene.step_at(-9);
    const PairReport& pair = only_pair(*report);
    const auto impacts = report->impacts(pair);
    REQUIRE(!impacts.empty());
    CHECK(impacts.size() == report->impacts().size());
    CHECK(impacts[0].kind == ContactKind::VF);
    CHECK(impacts[0].feature_a == Feature{FeatureKind::face, 0});
    CHECK(impacts[0].feature_b == Feature{FeatureKind::vertex, 0});
    CHECK(impacts[0].status == ImpactStatus::certain);
    CHECK(is_at(impacts[0].lower, 0.1));
    CHECK(impacts[0].upper >= 0.1);
    CHECK(impacts[0].upper - impacts[0].lower <= 1e-6);
    CHECK(pair.time_of_impact == impacts[0].lower);
    CHECK(pair.time_of_gap == 1);
    CHECK(pair.phase == PairPhase::near);
    CHECK(report->statistics().pairs_swept == 1);
    CHECK(report->statistics().impacts == impacts.size());
  }
}

TEST_CASE("Objects that are not swept pass each other unseen, and nothing is kept of them") {
  NeedleOverPlate scene(settings_of(0.01, 0));
  (void)scene.step_at(1);
  const ReportHandle report = scene.step_at(-9);
  CHECK(report->pairs().empty());
  CHECK(report->impacts().empty());
  CHECK(report->statistics().pairs_swept == 0);
}

TEST_CASE("What a sweep keeps of an object is counted, of a fixed one too") {
  Scene scene(settings_of(0.01, 0));
  ObjectSettings fixed;
  fixed.motion = Motion::fixed;
  scene.add(mesh_of(models::sphere(60, 40)), fixed);
  const auto box = mesh_of(models::box({0.1, 0.1, 0.1}));
  const ObjectId dart = scene.add(box, swept());
  const auto bytes_at = [&](double height) {
    scene.set_positions(dart, lifted(*box, height));
    const ReportHandle report = scene.step();
    CHECK(report->statistics().pairs_swept == (height < 0 ? 1U : 0U));
    return report->statistics().bytes.objects;
  };
  bytes_at(4);
  const std::size_t before = bytes_at(3);
  CHECK(bytes_at(-3) > before + 5'000);
}

TEST_CASE("The motion of the other object counts") {
  Scene scene(settings_of(0.01, 0));
  const auto plate = plate_mesh();
  const auto needle = needle_mesh();
  scene.add(needle, swept());
  const ObjectId moving = scene.add(plate);
  scene.set_positions(moving, moved(plate->rest(), {0, 0, -1}));
  CHECK(scene.step()->pairs().empty());
  scene.set_positions(moving, moved(plate->rest(), {0, 0, 9}));
  const ReportHandle report = scene.step();
  CHECK(is_at(only_pair(*report).time_of_impact, 0.1));
}

TEST_CASE("Impacts are those of one step only, and a pair at rest has none") {
  NeedleOverPlate scene = dart_over_plate(settings_of(0.01, 10));
  (void)scene.step_at(1);
  CHECK(only_pair(*scene.step_at(-9)).impact_count > 0);
  for (int step = 0; step < 3; ++step) {
    const ReportHandle report = scene.scene.step();
    const PairReport& pair = only_pair(*report);
    CHECK(pair.impact_count == 0);
    CHECK(pair.time_of_impact == 1);
    CHECK(report->impacts(pair).empty());
  }
  CHECK(only_pair(*scene.step_at(1)).impact_count > 0);
}

TEST_CASE("An object sweeps nothing in its first step, by a teleport, and when its mesh is replaced") {
  NeedleOverPlate scene = dart_over_plate();
  CHECK(scene.step_at(-9)->pairs().empty());
  const auto needle = needle_mesh();
  SECTION("teleport") {
    scene.scene.set_positions(scene.needle, lifted(*needle, 1), teleport);
    CHECK(scene.scene.step()->pairs().empty());
    // The next step sweeps from there.
    CHECK(is_at(only_pair(*scene.step_at(-9)).time_of_impact, 0.1));
  }
  SECTION("a teleport of several, followed by another call") {
    const Positions above = lifted(*needle, 2);
    scene.scene.set_positions(std::vector{scene.needle}, std::vector{PositionView(above)}, teleport);
    CHECK(scene.step_at(1)->pairs().empty());
    CHECK(is_at(only_pair(*scene.step_at(-9)).time_of_impact, 0.1));
  }
  SECTION("another mesh") {
    scene.scene.replace_mesh(scene.needle, needle, std::vector<std::uint32_t>{0, 1, 2});
    CHECK(scene.step_at(1)->pairs().empty());
    CHECK(is_at(only_pair(*scene.step_at(-9)).time_of_impact, 0.1));
  }
}

TEST_CASE("An object that jumps stands at its new place while others move") {
  Scene scene(settings_of(0.01, 0));
  const auto plate = plate_mesh();
  const auto needle = needle_mesh();
  const ObjectId wall = scene.add(plate);
  const ObjectId dart = scene.add(needle, swept());
  scene.set_positions(wall, moved(plate->rest(), {0, 0, 50}));
  scene.set_positions(dart, lifted(*needle, 1));
  CHECK(scene.step()->pairs().empty());
  scene.set_positions(wall, Positions(plate->rest().begin(), plate->rest().end()), teleport);
  scene.set_positions(dart, lifted(*needle, -9));
  CHECK(is_at(only_pair(*scene.step()).time_of_impact, 0.1));
}

TEST_CASE("Bound memory is swept, and may jump") {
  for (const BindPolicy policy : {BindPolicy::every_step, BindPolicy::when_told}) {
    Scene scene(settings_of(0.01, 0));
    const auto needle = needle_mesh();
    scene.add(plate_mesh());
    const ObjectId dart = scene.add(needle, swept());
    Positions memory = lifted(*needle, 1);
    scene.bind_positions(dart, memory, policy);
    CHECK(scene.step()->pairs().empty());
    put(memory, lifted(*needle, -9));
    scene.positions_changed(dart);
    CHECK(is_at(only_pair(*scene.step()).time_of_impact, 0.1));
    put(memory, lifted(*needle, 1));
    scene.positions_changed(dart, teleport);
    CHECK(scene.step()->pairs().empty());
    put(memory, lifted(*needle, -9));
    scene.positions_changed(dart);
    CHECK(is_at(only_pair(*scene.step()).time_of_impact, 0.1));
  }
}

TEST_CASE("Vertices of rigid objects move straight from pose to pose, and fixed ones stand") {
  Scene scene(settings_of(0.01, 0));
  const ObjectId floor = scene.add(plate_mesh(), motion_of(Motion::fixed));
  const ObjectId dart = scene.add(needle_mesh(), swept(Motion::rigid));
  scene.set_pose(dart, lift_pose(1));
  CHECK(scene.step()->pairs().empty());
  scene.set_pose(dart, lift_pose(-9));
  CHECK(is_at(only_pair(*scene.step()).time_of_impact, 0.1));
  scene.set_pose(dart, lift_pose(1), teleport);
  CHECK(scene.step()->pairs().empty());
  // A fixed object that is placed anew does not pass what lies between.
  scene.set_pose(floor, lift_pose(10));
  CHECK(scene.step()->pairs().empty());
}

TEST_CASE("A frozen object stands still, and its pairs have no impacts") {
  NeedleOverPlate scene = dart_over_plate(settings_of(0.01, 10));
  const auto needle = needle_mesh();
  Positions memory = lifted(*needle, 1);
  scene.scene.bind_positions(scene.needle, memory);
  (void)scene.scene.step();
  memory[0].x() = std::nan("");
  const ReportHandle frozen = scene.scene.step();
  CHECK(only_pair(*frozen).stale);
  CHECK(only_pair(*frozen).impact_count == 0);
  put(memory, lifted(*needle, -9));
  CHECK(is_at(only_pair(*scene.scene.step()).time_of_impact, 0.1));
}

TEST_CASE("Filters and ignored groups hold on the way") {
  SECTION("layers") {
    ObjectSettings other = swept();
    other.layer = 2;
    ObjectSettings wall;
    wall.collides_with = 1;
    NeedleOverPlate scene(settings_of(0.01, 0), wall, other);
    (void)scene.step_at(1);
    CHECK(scene.step_at(-9)->pairs().empty());
  }
  SECTION("pairs") {
    NeedleOverPlate scene = dart_over_plate();
    scene.scene.ignore(scene.plate, scene.needle);
    (void)scene.step_at(1);
    CHECK(scene.step_at(-9)->pairs().empty());
    scene.scene.watch(scene.needle, scene.plate);
    CHECK(scene.step_at(1)->pairs().size() == 1);
  }
  SECTION("hidden faces") {
    ObjectSettings wall;
    wall.hidden_groups = {0};
    NeedleOverPlate scene(settings_of(0.01, 0), wall, swept());
    (void)scene.step_at(1);
    CHECK(scene.step_at(-9)->pairs().empty());
  }
  SECTION("groups") {
    NeedleOverPlate scene = dart_over_plate();
    scene.scene.ignore(scene.plate, 0, scene.needle, 0);
    (void)scene.step_at(1);
    CHECK(scene.step_at(-9)->pairs().empty());
  }
}

TEST_CASE("A swept gap lists pairs that come near on the way") {
  SceneSettings settings = settings_of(0.01, 0);
  settings.swept_gap = 0.5;
  NeedleOverPlate scene = dart_over_plate(settings);
  (void)scene.step_at(2);
  const ReportHandle report = scene.step_at(0.4);
  const PairReport& pair = only_pair(*report);
  CHECK(pair.impact_count == 0);
  CHECK(pair.time_of_impact == 1);
  CHECK(pair.time_of_gap <= 0.9375);
  CHECK(pair.time_of_gap > 0.93);
}

TEST_CASE("Objects that were only surveyed are read when one that is swept may meet them") {
  Scene scene(settings_of(0.01, 0));
  const auto plate = plate_mesh();
  const ObjectId wall = scene.add(plate);
  Positions memory = moved(plate->rest(), {0, 0, 50});
  scene.bind_positions(wall, memory);
  for (int step = 0; step < 4; ++step) {
    for (Vector3d& point : memory) point.z() += 1;
    (void)scene.step();
  }
  CHECK(scene.latest_report()->statistics().objects_surveyed == 1);
  const ObjectId dart = scene.add(needle_mesh(), swept());
  (void)scene.step();
  CHECK(scene.latest_report()->statistics().objects_surveyed == 0);
  for (Vector3d& point : memory) point.z() = -50;
  const ReportHandle report = scene.step();
  CHECK(only_pair(*report).b == dart);
  CHECK(only_pair(*report).time_of_impact < 1);
}

TEST_CASE("A budget that runs out leaves a sweep undone, and says so") {
  SceneSettings settings = settings_of(0.01, 0);
  settings.work_budget = 0;
  NeedleOverPlate scene = dart_over_plate(settings);
  (void)scene.step_at(1);
  const ReportHandle report = scene.step_at(-9);
  CHECK_FALSE(only_pair(*report).complete);
  CHECK(only_pair(*report).time_of_impact == 0);
  CHECK_FALSE(report->complete());
}

/// Balls that fly through each other in all directions.
std::vector<std::vector<Impact>> impacts_of_flight(unsigned threads) {
  SceneSettings settings = settings_of(0.01, 0);
  settings.threads = threads;
  Scene scene(settings);
  const auto ball = mesh_of(models::sphere(8, 6));
  Random random(3);
  std::vector<ObjectId> balls;
  for (int i = 0; i < 40; ++i) balls.push_back(scene.add(ball, i % 2 == 0 ? swept() : ObjectSettings()));
  std::vector<std::vector<Impact>> all;
  for (int step = 0; step < 6; ++step) {
    for (const ObjectId id : balls) scene.set_positions(id, moved(ball->rest(), random.vector(-6, 6)));
    const ReportHandle report = scene.step();
    all.emplace_back(report->impacts().begin(), report->impacts().end());
    for (const PairReport& pair : report->pairs()) {
      const auto impacts = report->impacts(pair);
      const auto is_before = [](const Impact& left, const Impact& right) { return left.lower < right.lower; };
      CHECK(std::is_sorted(impacts.begin(), impacts.end(), is_before));
    }
  }
  return all;
}

TEST_CASE("Impacts are the same for any number of threads") {
  const auto one = impacts_of_flight(1);
  CHECK(one.front().empty());
  CHECK(one.back().size() > 100);
  CHECK(impacts_of_flight(4) == one);
}

TEST_CASE("One surface that passes itself is found, and each pair of features is named once") {
  // Two plates of one mesh, of which the upper one falls through the lower one.
  Positions start = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i) start.emplace_back(0.5 * start[i] + Vector3d(0.1, 0.05, 1));
  const std::vector<std::array<std::uint32_t, 4>> quads = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const auto mesh = std::make_shared<const Mesh>(Mesh::from_quads(start, quads));
  ObjectSettings settings = swept();
  settings.self = true;
  Scene scene(settings_of(0.01, 0));
  const ObjectId id = scene.add(mesh, settings);
  CHECK(scene.step()->pairs().empty());
  Positions end = start;
  for (std::size_t i = 4; i < 8; ++i) end[i].z() -= 4;
  scene.set_positions(id, end);
  const ReportHandle report = scene.step();
  const PairReport& pair = only_pair(*report);
  CHECK(pair.a == id);
  CHECK(pair.b == id);
  REQUIRE(report->impacts(pair).size() == 4);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const Impact& impact = report->impacts(pair)[i];
    CHECK(impact.feature_a == Feature{FeatureKind::vertex, 4 + i});
    CHECK(impact.feature_b == Feature{FeatureKind::face, 0});
    CHECK(is_at(impact.lower, 0.25));
  }
}

TEST_CASE("Settings of sweeps that make no sense are refused") {
  for (const double bad : {0.0, -1.0, 2.0, std::nan("")}) {
    SceneSettings settings;
    settings.sweep_tolerance = bad;
    CHECK_THROWS_AS(Scene(settings), Error);
  }
  for (const double bad : {-1.0, std::nan("")}) {
    SceneSettings settings;
    settings.swept_gap = bad;
    CHECK_THROWS_AS(Scene(settings), Error);
  }
}

}  // namespace
}  // namespace graze::tests
