// set_pose: the contract's formula bit for bit, and what is not taken for a pose.

#include <limits>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

/// Where a scene has an object's vertices: every pair of vertices is a contact, and their points are theirs.
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

TEST_CASE("what is not a rotation is not taken") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  pair.scene.set_pose(pair.needle, lift_pose(2));
  pair.scene.step();
  const auto refused = [&](const Eigen::Isometry3d& pose) {
    pair.scene.set_pose(pair.needle, pose);
    const ReportHandle report = pair.scene.step();
    CHECK(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
    CHECK(report->diagnostics()[0].object == pair.needle);
    CHECK(only_pair(*report).distance.upper == 2);
    CHECK(pair.scene.step()->diagnostics().empty());
  };
  oracle::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d good = random_pose(random);
    Eigen::Isometry3d bad = good;
    bad.linear() *= 1 + 1e-4;
    refused(bad);
    bad.linear() = good.linear();
    bad.matrix()(i % 3, (i / 3) % 3) += 1e-4;
    refused(bad);
    bad.linear() = -good.linear();  // a reflection
    refused(bad);
    bad = good;
    bad.matrix()(i % 3, i % 4) = std::numeric_limits<double>::quiet_NaN();
    refused(bad);
    bad = good;
    bad.translation()[i % 3] = std::numeric_limits<double>::infinity();
    refused(bad);
  }
  Eigen::Isometry3d zero = Eigen::Isometry3d::Identity();
  zero.linear().setZero();
  refused(zero);
  Eigen::Isometry3d huge = lift_pose(1);
  huge.linear() *= 1e200;
  refused(huge);
  Eigen::Isometry3d little_off = lift_pose(1);
  little_off.linear() *= 1 + 1e-8;
  refused(little_off);
}

TEST_CASE("a matrix that is a rotation up to rounding is taken") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  Eigen::Isometry3d pose = lift_pose(3);
  pose.linear() *= 1 + 1e-10;
  pair.scene.set_pose(pair.needle, pose);
  const ReportHandle report = pair.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(only_pair(*report).distance.upper == 3);
}

TEST_CASE("a bad pose leaves the good one before it") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  pair.scene.set_pose(pair.needle, lift_pose(5));
  Eigen::Isometry3d bad = lift_pose(6);
  bad.matrix()(0, 0) = 2;
  pair.scene.set_pose(pair.needle, bad);
  const ReportHandle report = pair.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
  CHECK(only_pair(*report).distance.upper == 5);
}

TEST_CASE("a pose that takes a vertex beyond 2^120 is not taken") {
  NeedleOverPlate pair(settings_of(0.5, 100), {}, motion_of(Motion::rigid));
  pair.scene.set_pose(pair.needle, lift_pose(2));
  pair.scene.step();
  pair.scene.set_pose(pair.needle, lift_pose(0x1p121));
  const ReportHandle report = pair.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::too_large});
  CHECK(only_pair(*report).distance.upper == 2);
  CHECK(pair.scene.step()->diagnostics().empty());
}

}  // namespace graze::tests
