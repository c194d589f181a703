// SceneSettings::ways_out: which rows have a way out, for how long, and that it is the same for any number of
// threads, instruction set and history.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <limits>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::shared_ptr<const Mesh> box_mesh(const Vector3d& half) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        half.cwiseProduct(Vector3d((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)));
  const std::vector<std::array<int, 4>> quads{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return std::make_shared<const Mesh>(Mesh::from_quads(corners, quads));
}

SceneSettings way_out_settings(ContactDetail detail = ContactDetail::nearest) {
  SceneSettings settings = settings_of(0.01, infinity, detail);
  settings.ways_out = true;
  return settings;
}

ObjectSettings solid_settings(Motion motion = Motion::rigid) {
  ObjectSettings settings = motion_of(motion);
  settings.solid = true;
  return settings;
}

bool is_nothing(const WayOut& way) {
  return way.direction == Vector3d::Zero() && way.point == Vector3d::Zero() && way.fullness == 0 &&
         way.thickness == 0 && way.extent == 0;
}

bool is_same(const WayOut& left, const WayOut& right) {
  return left.direction == right.direction && left.point == right.point && left.fullness == right.fullness &&
         left.thickness == right.thickness && left.extent == right.extent;
}

/// A fixed box of side 2 about the origin and one of side 1 over it, whose middle is at a height. They touch
/// at 1.5.
struct BoxOverBox {
  explicit BoxOverBox(const SceneSettings& settings, bool are_solids = true)
      : scene(settings),
        lower(scene.add(box_mesh({1, 1, 1}),
                        are_solids ? solid_settings(Motion::fixed) : motion_of(Motion::fixed))),
        upper(
            scene.add(box_mesh({0.5, 0.5, 0.5}), are_solids ? solid_settings() : motion_of(Motion::rigid))) {}

  ReportHandle step_at(double height) {
    Eigen::Isometry3d pose = lift_pose(height);
    pose.translation() += Vector3d(0.1, 0.2, 0);
    scene.set_pose(upper, pose);
    return scene.step();
  }

  Scene scene;
  ObjectId lower, upper;
};

TEST_CASE("Rows of pairs that cross have a way out in every detail about surfaces", "[way_out]") {
  for (const ContactDetail detail : all_details)
    for (const bool are_solids : {true, false}) {
      if (are_solids && !is_about_surfaces(detail)) continue;
      INFO("detail " << static_cast<int>(detail) << (are_solids ? ", solids" : ", no solids"));
      BoxOverBox boxes(way_out_settings(detail), are_solids);
      const WayOut way = only_pair(*boxes.step_at(1.4)).way_out;
      if (!is_about_surfaces(detail)) {
        CHECK(is_nothing(way));
        continue;
      }
      CHECK((way.direction - Vector3d::UnitZ()).norm() < 1e-12);
      CHECK((way.point - Vector3d(0.1, 0.2, 1)).norm() < 1e-12);
      CHECK(std::abs(way.fullness - 1) < 1e-12);
      CHECK(std::abs(way.thickness - (are_solids ? 0.1 : 0)) < 1e-12);
      CHECK(way.extent >= 0.1 - 1e-16);
      CHECK(way.extent < 0.1 + 1e-12);
    }
}

TEST_CASE("Without the setting no row has a way out", "[way_out]") {
  SceneSettings settings = way_out_settings();
  settings.ways_out = false;
  BoxOverBox boxes(settings);
  const ReportHandle report = boxes.step_at(1.4);
  CHECK(only_pair(*report).inside == Inside::crossing);
  CHECK(is_nothing(only_pair(*report).way_out));
}

TEST_CASE("A way out comes and goes with the crossing", "[way_out]") {
  BoxOverBox boxes(way_out_settings());
  CHECK(is_nothing(only_pair(*boxes.step_at(1.505)).way_out));  // in contact, apart
  const ReportHandle crossing = boxes.step_at(1.4);
  CHECK_FALSE(is_nothing(only_pair(*crossing).way_out));
  const ReportHandle repeated = boxes.step_at(1.4);
  CHECK(is_same(only_pair(*repeated).way_out, only_pair(*crossing).way_out));
  const ReportHandle resting = boxes.scene.step();
  CHECK(is_same(only_pair(*resting).way_out, only_pair(*crossing).way_out));
  CHECK(is_nothing(only_pair(*boxes.step_at(0.2)).way_out));  // wholly inside
  CHECK_FALSE(is_nothing(only_pair(*boxes.step_at(1.4)).way_out));
  const ReportHandle ended = boxes.step_at(3);
  CHECK(only_pair(*ended).phase == PairPhase::ended);
  CHECK(is_nothing(only_pair(*ended).way_out));
}

TEST_CASE("A pair that ends while it crosses has no way out", "[way_out]") {
  SECTION("since it is ignored") {
    BoxOverBox boxes(way_out_settings());
    CHECK_FALSE(is_nothing(only_pair(*boxes.step_at(1.4)).way_out));
    boxes.scene.ignore(boxes.lower, boxes.upper);
    const ReportHandle ended = boxes.scene.step();
    CHECK(only_pair(*ended).phase == PairPhase::ended);
    CHECK(is_nothing(only_pair(*ended).way_out));
  }
  SECTION("since an object is removed") {
    BoxOverBox boxes(way_out_settings());
    CHECK_FALSE(is_nothing(only_pair(*boxes.step_at(1.4)).way_out));
    boxes.scene.remove(boxes.upper);
    const ReportHandle ended = boxes.scene.step();
    CHECK(only_pair(*ended).phase == PairPhase::ended);
    CHECK(is_nothing(only_pair(*ended).way_out));
  }
}

TEST_CASE("A stale row repeats its way out", "[way_out]") {
  BoxOverBox boxes(way_out_settings());
  const ReportHandle crossing = boxes.step_at(1.4);
  Eigen::Isometry3d bad = lift_pose(1.3);
  bad.translation().x() = std::numeric_limits<double>::quiet_NaN();
  boxes.scene.set_pose(boxes.upper, bad);
  const ReportHandle stale = boxes.scene.step();
  CHECK(only_pair(*stale).stale);
  CHECK(is_same(only_pair(*stale).way_out, only_pair(*crossing).way_out));
}

TEST_CASE("Groups that are ignored have no part in a way out", "[way_out]") {
  // The upper box stands in the lower one's upper face and passes one of its sides.
  Scene scene(way_out_settings());
  ObjectSettings lower_settings = solid_settings(Motion::fixed);
  lower_settings.face_groups = {0, 1, 0, 0, 0, 0};  // the upper face
  const ObjectId lower = scene.add(box_mesh({1, 1, 1}), lower_settings);
  const ObjectId upper = scene.add(box_mesh({0.5, 0.5, 0.5}), solid_settings());
  Eigen::Isometry3d pose = lift_pose(1.4);
  pose.translation().x() = 0.6;
  scene.set_pose(upper, pose);
  const WayOut all = only_pair(*scene.step()).way_out;
  CHECK((all.direction - Vector3d(0.1, 0, 0.9).normalized()).norm() < 1e-12);
  scene.ignore(lower, 1, upper, 0);
  // What is left is the crossing with the side: an open contour in the plane x = 1.
  const WayOut beside = only_pair(*scene.step()).way_out;
  CHECK((beside.direction - Vector3d(1, 0, 0)).norm() < 1e-12);
  CHECK(std::abs(beside.point.x() - 1) < 1e-12);
  scene.watch(lower, 1, upper, 0);
  CHECK(is_same(only_pair(*scene.step()).way_out, all));
}

// ---- The same for any number of threads, and so on

/// Balls, large ones and small ones, that fall into each other. Returns the ways out of all their rows.
std::vector<WayOut> ways_of_balls(unsigned threads, bool steps_from_the_start) {
  SceneSettings settings = way_out_settings();
  settings.threads = threads;
  Scene scene(settings);
  const auto large = mesh_of(models::sphere(90, 60));  // two of them make a pair in slices
  const auto small = mesh_of(models::sphere(12, 8, models::Faces::quads));
  std::vector<ObjectId> ids;
  for (int i = 0; i < 6; ++i) ids.push_back(scene.add(i < 3 ? large : small, solid_settings()));
  std::vector<WayOut> ways;
  constexpr int step_count = 6;
  for (int step = steps_from_the_start ? 0 : step_count - 1; step < step_count; ++step) {
    for (int i = 0; i < 6; ++i) {
      const double apart = 2.2 - 0.1 * step;
      Eigen::Isometry3d pose(Eigen::Translation3d(apart * i, 0.01 * i * step, 0.02 * step) *
                             Eigen::AngleAxisd(0.3 * i + 0.01 * step, Vector3d(1, 2, 3).normalized()));
      scene.set_pose(ids[static_cast<std::size_t>(i)], pose);
    }
    const ReportHandle report = scene.step();
    ways.clear();
    for (const PairReport& pair : report->pairs()) ways.push_back(pair.way_out);
  }
  return ways;
}

void check_same(const std::vector<WayOut>& left, const std::vector<WayOut>& right) {
  REQUIRE(left.size() == right.size());
  for (std::size_t i = 0; i < left.size(); ++i) CHECK(is_same(left[i], right[i]));
}

TEST_CASE("Ways out have the same bits for any threads, instruction set and history", "[way_out]") {
  const std::vector<WayOut> expected = ways_of_balls(1, true);
  CHECK(std::count_if(expected.begin(), expected.end(),
                      [](const WayOut& way) { return way.thickness > 0; }) == 5);
  check_same(ways_of_balls(4, true), expected);
  check_same(ways_of_balls(2, false), expected);
  const InstructionSet before = instruction_set();
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    INFO(to_string(set));
    check_same(ways_of_balls(1, false), expected);
  }
  use_instruction_set(before);
}

}  // namespace
}  // namespace graze::tests
