// set_pose: the contract's formula bit for bit, and what is not taken for a pose.

#include <cmath>
#include <limits>
#include <random>
#include <string_view>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Returns the positions of an object's vertices in a scene. Every pair of vertices has to be a contact. The
/// positions are the points of these contacts.
Positions positions_in(Scene& scene, ObjectId observer, ObjectId object) {
  const ReportHandle report = scene.step();
  CHECK(report->diagnostics().empty());
  const PairReport* const pair = find_pair(*report, observer, object);
  REQUIRE(pair != nullptr);
  Positions positions(scene.mesh(object)->vertex_count(), Eigen::Vector3d::Zero());
  for (const Contact& contact : report->contacts(*pair)) positions[contact.feature_b.index] = contact.point_b;
  return positions;
}

Eigen::Isometry3d random_pose(oracle::Random& random) {
  const auto number = [&] { return random.between(-1, 1); };
  const Eigen::Quaterniond rotation{number(), number(), number(), number()};
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation.normalized().toRotationMatrix();
  const double size = random.chance(0.5) ? 1 : 1000;
  pose.translation() = size * random.vector(-1, 1);
  return pose;
}

double coordinate(const Eigen::Isometry3d& pose, int row, const Eigen::Vector3d& p) {
  const auto& m = pose.matrix();
  const double x = m(row, 0) * p.x();
  const double y = m(row, 1) * p.y();
  const double z = m(row, 2) * p.z();
  const double xy = x + y;
  const double xyz = xy + z;
  return xyz + m(row, 3);
}

}  // namespace

TEST_CASE("a posed vertex is ((r0·x + r1·y) + r2·z) + t, bit for bit") {
  oracle::Random random(7);
  for (const Motion motion : {Motion::rigid, Motion::fixed}) {
    Scene scene(settings_of(1e6, 1e6, ContactDetail::vertices));
    const ObjectId observer = scene.add(needle_mesh());
    for (std::uint64_t seed = 0; seed < 40; seed += 2) {
      const oracle::RandomScene shapes = oracle::random_scene(seed);
      const auto mesh = mesh_of(shapes.a);
      const ObjectId object = scene.add(mesh, motion_of(motion));
      const Eigen::Isometry3d pose = random_pose(random);
      scene.set_pose(object, lift_pose(77));  // the last of several counts
      scene.set_pose(object, pose);
      const Positions found = positions_in(scene, observer, object);
      for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex) {
        if (!mesh->is_used(vertex)) continue;
        for (int axis = 0; axis < 3; ++axis)
          REQUIRE(found[vertex][axis] == coordinate(pose, axis, mesh->rest()[vertex]));
      }
      // A pose is of the rest shape, not of where the object was.
      scene.set_pose(object, pose);
      REQUIRE(positions_in(scene, observer, object) == found);
      scene.remove(object);
    }
  }
}

TEST_CASE("set_pose_rows takes the upper three rows of the matrix") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  pair.scene.set_pose_rows(pair.needle, {0, -1, 0, 0.5, 1, 0, 0, 0.125, 0, 0, 1, 3});
  const ReportHandle report = pair.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(only_pair(*report).witness.point_b == Eigen::Vector3d(0, 0.375, 3));
}

TEST_CASE("a pose that is not within 1e-3 of a rotation is not taken") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  pair.scene.set_pose(pair.needle, lift_pose(2));
  pair.scene.step();
  const auto refused = [&](const Eigen::Isometry3d& pose, std::string_view figure = {}) {
    pair.scene.set_pose(pair.needle, pose);
    const ReportHandle report = pair.scene.step();
    CHECK(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
    CHECK(report->diagnostics()[0].object == pair.needle);
    CHECK(report->diagnostics()[0].message.find(figure) != std::string::npos);
    CHECK(only_pair(*report).distance.upper == 2);
    CHECK(only_pair(*report).stale);
    const ReportHandle next = pair.scene.step();
    CHECK(next->diagnostics().empty());
    CHECK(only_pair(*next).stale);
  };
  oracle::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d good = random_pose(random);
    Eigen::Isometry3d bad = good;
    bad.linear() *= 1 + 1e-2;
    refused(bad, "0.0201");
    bad.linear() = -good.linear();
    refused(bad, "reflection");
    bad = good;
    bad.matrix()(i % 3, i % 4) = std::numeric_limits<double>::quiet_NaN();
    refused(bad, "not finite");
    bad = good;
    bad.translation()[i % 3] = std::numeric_limits<double>::infinity();
    refused(bad, "not finite");
  }
  Eigen::Isometry3d zero = Eigen::Isometry3d::Identity();
  zero.linear().setZero();
  refused(zero, "is 1,");
  Eigen::Isometry3d huge = lift_pose(1);
  huge.linear() *= 1e200;
  refused(huge);
  // RᵀR - 1 is measured: a scale of 1 + x is 2x + x² off.
  Eigen::Isometry3d scaled = lift_pose(1);
  scaled.linear() *= std::sqrt(1 + 1.001e-3);
  refused(scaled, "0.001001");
  scaled.linear() = lift_pose(1).linear() * std::sqrt(1 + 0.999e-3);
  pair.scene.set_pose(pair.needle, scaled);
  const ReportHandle report = pair.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK_FALSE(only_pair(*report).stale);
  CHECK(only_pair(*report).distance.upper == 1);
}

TEST_CASE("float rotations are poses") {
  std::mt19937 numbers(1);
  std::normal_distribution<float> normal;
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaternionf turn{normal(numbers), normal(numbers), normal(numbers), normal(numbers)};
    Eigen::Isometry3f pose = Eigen::Isometry3f::Identity();
    pose.linear() = turn.normalized().toRotationMatrix();
    pair.scene.set_pose(pair.needle, pose.cast<double>());
    const ReportHandle report = pair.scene.step();
    REQUIRE(report->diagnostics().empty());
    REQUIRE_FALSE(only_pair(*report).stale);
  }
}

TEST_CASE("a bad pose leaves its object's pairs as they were until a good one comes") {
  NeedleOverPlate pair(settings_of(0.5, 100), motion_of(Motion::rigid), motion_of(Motion::rigid));
  Eigen::Isometry3d bad = lift_pose(6);
  bad.matrix()(0, 0) = 2;
  pair.scene.set_pose(pair.needle, lift_pose(0.25));
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::began);
  // The good pose before a bad one in one step is not taken either.
  pair.scene.set_pose(pair.needle, lift_pose(5));
  pair.scene.set_pose(pair.needle, bad);
  const ReportHandle report = pair.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
  CHECK(only_pair(*report).stale);
  CHECK(only_pair(*report).phase == PairPhase::touching);
  CHECK(only_pair(*report).distance.upper == 0.25);
  CHECK(report->contacts().size() == 1);
  // The other object moves, and the stale row stays.
  pair.scene.set_pose(pair.plate, lift_pose(-10));
  CHECK(only_pair(*pair.scene.step()).distance.upper == 0.25);
  SECTION("another one") {
    pair.scene.set_pose(pair.needle, bad);
    pair.scene.set_pose(pair.needle, lift_pose(5));
    const ReportHandle good = pair.scene.step();
    CHECK(kinds_of(*good) == std::vector{DiagnosticKind::bad_pose});
    CHECK_FALSE(only_pair(*good).stale);
    CHECK(only_pair(*good).phase == PairPhase::ended);
    CHECK(only_pair(*good).distance.upper == 15);
  }
  SECTION("the one at which it stands") {
    pair.scene.set_pose(pair.needle, lift_pose(0.25));
    const ReportHandle good = pair.scene.step();
    CHECK(good->diagnostics().empty());
    CHECK_FALSE(only_pair(*good).stale);
    CHECK(only_pair(*good).distance.upper == 10.25);
  }
  SECTION("the object goes") {
    pair.scene.remove(pair.needle);
    CHECK(only_pair(*pair.scene.step()).phase == PairPhase::ended);
    CHECK(pair.scene.step()->pairs().empty());
  }
}

TEST_CASE("a bad pose of an object that no step has read") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  Eigen::Isometry3d bad = lift_pose(6);
  bad.matrix()(0, 0) = 2;
  pair.scene.set_pose(pair.needle, bad);
  const ReportHandle report = pair.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
  CHECK(report->pairs().empty());
  pair.scene.set_pose(pair.needle, lift_pose(0));
  CHECK(only_pair(*pair.scene.step()).phase == PairPhase::began);
}

TEST_CASE("a pose that takes a vertex beyond 2^120 is not taken") {
  for (const bool is_near : {true, false})
    for (const std::uint32_t side : {1U, 120U}) {  // read whole, and in parts
      const auto mesh = mesh_of(models::sheet(side, side, 2, 2));
      Scene scene(settings_of(0.5, 100));
      const ObjectId fixed = scene.add(mesh, motion_of(Motion::fixed));
      const ObjectId rigid = scene.add(mesh, motion_of(Motion::rigid));
      const double height = is_near ? 2 : 200;
      const auto rows = [&] {
        const ReportHandle report = scene.step();
        const PairReport* const row = find_pair(*report, fixed, rigid);
        CHECK((row != nullptr) == is_near);
        return std::pair{kinds_of(*report), row != nullptr && row->stale};
      };
      scene.set_pose(rigid, lift_pose(height));
      CHECK(rows() == std::pair{std::vector<DiagnosticKind>{}, false});
      scene.set_pose(rigid, lift_pose(0x1p121));
      CHECK(rows() == std::pair{std::vector{DiagnosticKind::too_large}, is_near});
      CHECK(rows() == std::pair{std::vector<DiagnosticKind>{}, is_near});
      scene.set_pose(rigid, lift_pose(height));
      CHECK(rows() == std::pair{std::vector<DiagnosticKind>{}, false});
    }
}

}  // namespace graze::tests
