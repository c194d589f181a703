// Rows of swept pairs under limits, budgets and bad input, and objects of which it counts whether they moved.

#include <cmath>
#include <graze/graze.hpp>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

ObjectSettings swept_object() {
  ObjectSettings settings;
  settings.swept = true;
  return settings;
}

/// A needle over a plate, of which the needle is swept, and the plate lies 1 below its tip. A row lists one
/// impact at most.
struct OneImpact : NeedleOverPlate {
  explicit OneImpact(SceneSettings settings) : NeedleOverPlate(limited(settings), {}, swept_object()) {
    scene.bind_positions(needle, memory);
    scene.step();
  }
  static SceneSettings limited(SceneSettings settings) {
    settings.max_contacts_per_pair = 1;
    return settings;
  }
  ReportHandle fly_to(double height) {
    const Positions now = lifted(*needle_mesh(), height);
    std::copy(now.begin(), now.end(), memory.begin());
    return scene.step();
  }

  Positions memory = lifted(*needle_mesh(), 1);
};

TEST_CASE("Equal positions in another precision do not move an object") {
  for (const BindPolicy policy : {BindPolicy::every_step, BindPolicy::when_told}) {
    NeedleOverPlate scene(settings_of(0.01, 1), {}, swept_object());
    const Positions memory = lifted(*needle_mesh(), 0);
    std::vector<Eigen::Vector3f> in_float;
    for (const Eigen::Vector3d& point : memory) in_float.push_back(point.cast<float>());
    scene.scene.bind_positions(scene.needle, memory, policy);
    (void)scene.scene.step();
    const ReportHandle before = scene.scene.step();
    CHECK(only_pair(*before).distance.upper == 0);
    scene.scene.bind_positions(scene.needle, in_float, policy);
    const ReportHandle report = scene.scene.step();
    CHECK(only_pair(*report).impact_count == 0);
    CHECK(only_pair(*report).time_of_impact == 1);
    CHECK(report->statistics().pairs_swept == 0);
    CHECK(rows_of(*report) == rows_of(*before));
  }
}

TEST_CASE("A surface is swept against itself in whatever layer it is") {
  // Two plates of one mesh, of which the upper one falls through the lower one.
  Positions start = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i) start.emplace_back(0.5 * start[i] + Eigen::Vector3d(0.1, 0.05, 1));
  const std::vector<std::array<std::uint32_t, 4>> quads = {{0, 1, 2, 3}, {4, 5, 6, 7}};
  const auto mesh = std::make_shared<const Mesh>(Mesh::from_quads(start, quads));
  ObjectSettings settings = swept_object();
  settings.self = true;
  settings.layer = settings.collides_with = 0;
  Scene scene(settings_of(0.01, 0));
  const ObjectId id = scene.add(mesh, settings);
  (void)scene.step();
  for (std::size_t i = 4; i < 8; ++i) start[i].z() -= 4;
  scene.set_positions(id, start);
  const ReportHandle report = scene.step();
  CHECK(only_pair(*report).impact_count == 4);
}

TEST_CASE("An object that could not be read at first stands where it is read first") {
  NeedleOverPlate scene(settings_of(0.01, 100), {}, swept_object());
  const auto needle = needle_mesh();
  Positions memory = lifted(*needle, -9);
  const auto step_at = [&](double height, double bad) {
    const Positions now = lifted(*needle, height);
    std::copy(now.begin(), now.end(), memory.begin());
    memory[1].y() += bad;
    return scene.scene.step();
  };
  scene.scene.bind_positions(scene.needle, memory);
  SECTION("a new one") {
    (void)step_at(-9, std::nan(""));
  }
  SECTION("one with another mesh") {
    (void)step_at(5, 0);
    scene.scene.replace_mesh(scene.needle, needle, std::vector<std::uint32_t>{0, 1, 2});
    scene.scene.bind_positions(scene.needle, memory);
    (void)step_at(-9, std::nan(""));
  }
  (void)step_at(-9, std::nan(""));
  CHECK(only_pair(*step_at(-9, 0)).impact_count == 0);
  CHECK(only_pair(*step_at(1, 0)).impact_count > 0);
  // Later it moves from where it stood.
  (void)step_at(-9, std::nan(""));
  CHECK(only_pair(*step_at(-9, 0)).impact_count > 0);
}

TEST_CASE("A posed object that could not be read at first stands where it is read first") {
  Scene scene(settings_of(0.01, 100));
  ObjectSettings settings = swept_object();
  settings.motion = Motion::rigid;
  scene.add(plate_mesh());
  const ObjectId needle = scene.add(needle_mesh(), settings);
  scene.set_pose(needle, lift_pose(std::nan("")));
  (void)scene.step();
  scene.set_pose(needle, lift_pose(-9));
  CHECK(only_pair(*scene.step()).impact_count == 0);
  scene.set_pose(needle, lift_pose(std::nan("")));
  (void)scene.step();
  scene.set_pose(needle, lift_pose(1));
  CHECK(only_pair(*scene.step()).impact_count > 0);
}

TEST_CASE("Impacts that a limit left out are not told of once the pair is frozen") {
  OneImpact scene(settings_of(0.01, 100));
  const ReportHandle report = scene.fly_to(-9);
  REQUIRE(only_pair(*report).phase == PairPhase::near);
  REQUIRE(only_pair(*report).contacts_cut);
  CHECK(only_pair(*report).impact_count == 1);
  CHECK_FALSE(only_pair(*report).complete);
  scene.memory[0].x() = std::nan("");
  const ReportHandle frozen = scene.scene.step();
  CHECK(only_pair(*frozen).stale);
  CHECK_FALSE(only_pair(*frozen).contacts_cut);
  CHECK(frozen->statistics().pairs_cut == 0);
  CHECK(inconsistency_of(*frozen) == "");
}

TEST_CASE("Where a budget cuts a search short, impacts that a limit left out do not say otherwise") {
  // The budget is used up by the sweep, or in the search after it.
  int undone = 0;
  int searched = 0;
  for (std::uint64_t budget = 0; budget < 64; ++budget) {
    CAPTURE(budget);
    SceneSettings settings = settings_of(0.01, 100);
    settings.work_budget = budget;
    OneImpact scene(settings);
    const ReportHandle report = scene.fly_to(-9);
    const PairReport& pair = only_pair(*report);
    CHECK_FALSE(pair.complete);
    CHECK(inconsistency_of(*report) == "");
    const bool is_distance_known = std::nextafter(pair.distance.lower, 100.0) >= pair.distance.upper;
    if (pair.contacts_cut) CHECK(is_distance_known);
    if (pair.impact_count == 1 && !is_distance_known) ++undone;
    if (pair.contacts_cut) ++searched;
  }
  CHECK(undone > 0);
  CHECK(searched > 0);
}

}  // namespace
}  // namespace graze::tests
