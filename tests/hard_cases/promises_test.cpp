// Broken promises of motion, and poses that are no rotations.

#include <array>
#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {

TEST_CASE("a broken promise of motion: a diagnostic, and nothing wrong where it was noticed") {
  std::size_t noticed = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    oracle::Random random(seed);
    const oracle::RandomScene given = oracle::random_scene(seed);
    for (const ContactDetail detail : all_details)
      for (const bool bound : {false, true}) {
        INFO("seed " << seed << ", detail " << static_cast<int>(detail) << (bound ? ", bound" : ", copied"));
        const SceneSettings settings = settings_of(given.threshold, infinity, detail);
        BodyScene scene({given.a, given.b}, settings);
        Scene& running = scene.scene();
        Positions memory = given.b.positions;
        if (bound) running.bind_positions(scene.ids()[1], memory, BindPolicy::when_told);
        running.step();
        const double way = random.between(0.01, 2);
        for (Eigen::Vector3d& position : memory) position.x() += way;
        if (bound)
          running.positions_changed(scene.ids()[1], way / 2);
        else
          running.set_positions(scene.ids()[1], memory, way / 2);
        const ReportHandle report = running.step();
        REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::broken_promise});
        CHECK(report->diagnostics()[0].object == scene.ids()[1]);
        BodyScene fresh({given.a, given.b}, settings);
        const ReportHandle afresh = fresh.step({given.a, Body(given.b, {memory, given.b.faces})});
        CHECK(timeless_rows_of(*report, infinity) == timeless_rows_of(*afresh, infinity));
        ++noticed;
      }
  }
  std::cout << "compared " << noticed << " scenes with a broken promise\n";
}

namespace {

Eigen::Isometry3d turned(oracle::Random& random) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() =
      Eigen::AngleAxisd(random.between(0, 6), Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  return pose;
}

}  // namespace

TEST_CASE("a pose 1e-2 off a rotation: a diagnostic, and pairs are stale until a good one comes") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    oracle::Random random(seed);
    const oracle::RandomScene given = oracle::random_scene(2 * seed);
    Scene scene(settings_of(given.threshold, infinity));
    scene.add(mesh_of(given.a));
    const ObjectId rigid = scene.add(mesh_of(given.b), motion_of(Motion::rigid));
    const Eigen::Isometry3d pose = turned(random);
    scene.set_pose(rigid, pose);
    const ReportHandle before = scene.step();
    CHECK(before->diagnostics().empty());
    Eigen::Isometry3d off = pose;
    off.linear() *= 1 + 1e-2;
    off.translation().x() += 1;
    scene.set_pose(rigid, off);
    const ReportHandle report = scene.step();
    REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
    CHECK(report->diagnostics()[0].object == rigid);
    REQUIRE(report->pairs().size() == 1);
    CHECK(report->pairs()[0].stale);
    CHECK(report->pairs()[0].distance.upper == before->pairs()[0].distance.upper);
    CHECK(report->contacts().size() == before->contacts().size());
    scene.set_pose(rigid, pose);
    CHECK(timeless_rows_of(*scene.step(), infinity) == timeless_rows_of(*before, infinity));
    ++compared;
  }
  std::cout << "compared " << compared << " scenes with a bad pose\n";
}

TEST_CASE("a pose up to 1e-3 off a rotation is taken as it stands") {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    oracle::Random random(seed);
    const oracle::RandomScene given = oracle::random_scene(2 * seed);
    for (const ContactDetail detail : all_details) {
      const SceneSettings settings = settings_of(given.threshold, infinity, detail);
      Scene posed(settings);
      posed.add(mesh_of(given.a));
      const ObjectId rigid = posed.add(mesh_of(given.b), motion_of(Motion::rigid));
      Eigen::Isometry3d pose = turned(random);
      for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) pose.matrix()(row, column) += random.between(-1e-4, 1e-4);
      posed.step();  // so that the object moves
      posed.set_pose(rigid, pose);
      Positions positions;
      for (const Eigen::Vector3d& rest : given.b.positions) {
        const auto& m = pose.matrix();
        Eigen::Vector3d& p = positions.emplace_back();
        for (int row = 0; row < 3; ++row) {
          const double xy = m(row, 0) * rest.x() + m(row, 1) * rest.y();
          p[row] = (xy + m(row, 2) * rest.z()) + m(row, 3);
        }
      }
      BodyScene deformable({given.a, given.b}, settings);
      const ReportHandle report = posed.step();
      REQUIRE(report->diagnostics().empty());
      const ReportHandle told = deformable.step({given.a, Body(given.b, {positions, given.b.faces})});
      CHECK(timeless_rows_of(*report, infinity) == timeless_rows_of(*told, infinity));
      ++compared;
    }
  }
  std::cout << "compared " << compared << " scenes with a stretched pose\n";
}

}  // namespace graze::tests
