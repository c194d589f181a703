// Bad input is one object's own affair: a diagnostic in the next report, and everything else as before.

#include <cstring>
#include <limits>
#include <string>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A needle 2 above a plate, and a rigid and a fixed plate 8 and 16 above the first.
struct Stage : NeedleOverPlate {
  Stage() : NeedleOverPlate(settings_of(0.5, 100), {}, named()) {
    rigid = scene.add(plate_mesh(), motion_of(Motion::rigid));
    fixed = scene.add(plate_mesh(), motion_of(Motion::fixed));
    scene.set_pose(rigid, lift_pose(8));
    scene.set_pose(fixed, lift_pose(16));
    before = step_at(2);
    CHECK(before->diagnostics().empty());
  }
  static ObjectSettings named() {
    ObjectSettings settings;
    settings.name = "needle";
    return settings;
  }

  /// Steps. There is one diagnostic, of `kind` about `object`, and all distances are as they were. Then there
  /// is none.
  std::string expect(DiagnosticKind kind, ObjectId object) {
    const ReportHandle report = scene.step();
    REQUIRE(kinds_of(*report) == std::vector{kind});
    CHECK(report->diagnostics()[0].object == object);
    expect_old_stand(*report);
    CHECK(scene.step()->diagnostics().empty());
    return report->diagnostics()[0].message;
  }
  void expect_old_stand(const FrameReport& report) const {
    REQUIRE(report.pairs().size() == before->pairs().size());
    for (std::size_t i = 0; i < report.pairs().size(); ++i) {
      CHECK(report.pairs()[i].distance.upper == before->pairs()[i].distance.upper);
      CHECK_FALSE(report.pairs()[i].stale);
    }
  }

  ObjectId rigid, fixed;
  ReportHandle before;
  Positions good = lifted(*needle_mesh(), 5);
};

}  // namespace

TEST_CASE("the wrong number of positions is refused") {
  Stage stage;
  for (const std::size_t count : {std::size_t{0}, std::size_t{2}, std::size_t{4}}) {
    const Positions positions(count, Eigen::Vector3d(1, 2, 3));
    stage.scene.set_positions(stage.needle, positions);
    CHECK(stage.expect(DiagnosticKind::wrong_count, stage.needle).find("needle") != std::string::npos);
    stage.scene.bind_positions(stage.needle, positions);
    stage.expect(DiagnosticKind::wrong_count, stage.needle);
  }
}

TEST_CASE("null memory is refused") {
  Stage stage;
  const double* const no_doubles = nullptr;
  const float* const no_floats = nullptr;
  stage.scene.set_positions(stage.needle, PositionView(no_doubles, 3));
  stage.expect(DiagnosticKind::null_memory, stage.needle);
  stage.scene.bind_positions(stage.needle, PositionView(no_floats, 3));
  stage.expect(DiagnosticKind::null_memory, stage.needle);
}

TEST_CASE("misaligned memory is refused") {
  Stage stage;
  std::vector<double> numbers(16, 1.0);
  const double* shifted = nullptr;
  const std::uintptr_t address = reinterpret_cast<std::uintptr_t>(numbers.data()) + 4;
  std::memcpy(&shifted, &address, sizeof shifted);
  stage.scene.set_positions(stage.needle, PositionView(shifted, 3));
  stage.expect(DiagnosticKind::misaligned_memory, stage.needle);
  stage.scene.bind_positions(stage.needle, PositionView(shifted, 3));
  stage.expect(DiagnosticKind::misaligned_memory, stage.needle);
  stage.scene.set_positions(stage.needle, PositionView(numbers.data(), 3, 28));
  stage.expect(DiagnosticKind::misaligned_memory, stage.needle);
}

TEST_CASE("positions are for deformable objects, poses for the others") {
  Stage stage;
  const Positions plate = lifted(*plate_mesh(), 50);
  for (const ObjectId object : {stage.rigid, stage.fixed}) {
    stage.scene.set_positions(object, plate);
    stage.expect(DiagnosticKind::wrong_motion, object);
    stage.scene.bind_positions(object, plate);
    stage.expect(DiagnosticKind::wrong_motion, object);
    stage.scene.unbind_positions(object);
    stage.expect(DiagnosticKind::wrong_motion, object);
    stage.scene.positions_changed(object);
    stage.expect(DiagnosticKind::wrong_motion, object);
  }
  stage.scene.set_pose(stage.needle, lift_pose(50));
  CHECK(stage.expect(DiagnosticKind::wrong_motion, stage.needle).find("needle") != std::string::npos);
}

TEST_CASE("copied positions that are not finite are refused") {
  Stage stage;
  for (const double bad : {nothing, infinity, -infinity})
    for (std::size_t vertex = 0; vertex < 3; ++vertex)
      for (int axis = 0; axis < 3; ++axis) {
        Positions positions = stage.good;
        positions[vertex][axis] = bad;
        stage.scene.set_positions(stage.needle, positions);
        const std::string message = stage.expect(DiagnosticKind::not_finite, stage.needle);
        CHECK(message.find("needle") != std::string::npos);
        CHECK(message.find("vertex " + std::to_string(vertex) + " is at ") != std::string::npos);
      }
  std::vector<Eigen::Vector3f> floats(3, Eigen::Vector3f(0, 0, std::numeric_limits<float>::infinity()));
  stage.scene.set_positions(stage.needle, floats);
  stage.expect(DiagnosticKind::not_finite, stage.needle);
}

TEST_CASE("copied positions beyond 2^120 are refused, up to there they are taken") {
  Stage stage;
  Positions positions = stage.good;
  for (const double sign : {1.0, -1.0}) {
    positions[1].y() = sign * std::nextafter(0x1p120, infinity);
    stage.scene.set_positions(stage.needle, positions);
    stage.expect(DiagnosticKind::too_large, stage.needle);
  }
  positions[1].y() = 0x1p120;
  stage.scene.set_positions(stage.needle, positions);
  const ReportHandle report = stage.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(find_pair(*report, stage.plate, stage.needle)->distance.upper == 5);
}

TEST_CASE("good positions before bad ones in the same step are taken") {
  Stage stage;
  stage.scene.set_positions(stage.needle, stage.good);
  Positions bad = stage.good;
  bad[0].x() = nothing;
  stage.scene.set_positions(stage.needle, bad);
  const ReportHandle report = stage.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
  CHECK(find_pair(*report, stage.plate, stage.needle)->distance.upper == 5);
}

TEST_CASE("a pair of an object with itself and a bad rule are diagnostics") {
  Stage stage;
  stage.scene.ignore(stage.needle, stage.needle);
  stage.expect(DiagnosticKind::bad_pair, stage.needle);
  stage.scene.watch(stage.needle, stage.needle);
  stage.expect(DiagnosticKind::bad_pair, stage.needle);
  const std::vector<PairRule> bad = {{-1, 0, {}},      {nothing, 0, {}}, {infinity, 0, {}}, {0, -1, {}},
                                     {0, nothing, {}}, {0, 0, {1, -1}},  {0, 0, {nothing}}};
  for (const PairRule& rule : bad) {
    stage.scene.set_rule(0, 0, rule);
    stage.expect(DiagnosticKind::bad_rule, {});
  }
  stage.scene.set_rule(256, 0, {});
  stage.expect(DiagnosticKind::bad_rule, {});
  stage.scene.set_rule(0, 256, {});
  stage.expect(DiagnosticKind::bad_rule, {});
}

TEST_CASE("a bad range is told that infinity is allowed, a bad distance that it must be finite") {
  Stage stage;
  stage.scene.set_rule(0, 0, {0, -1, {}});
  CHECK(stage.expect(DiagnosticKind::bad_rule, {})
            .find("range is -1; give a distance that is not negative, or infinity") != std::string::npos);
  stage.scene.set_rule(0, 0, {-1, 0, {}});
  CHECK(stage.expect(DiagnosticKind::bad_rule, {})
            .find("contact_distance is -1; give a distance that is finite and not negative") !=
        std::string::npos);
  SceneSettings settings;
  settings.range = -1;
  CHECK_THROWS_WITH(Scene(settings), "scene: range is -1; give a distance that is not negative, or infinity");
}

TEST_CASE("a broken promise is told with the caller's number") {
  Stage stage;
  stage.scene.set_positions(stage.needle, stage.good);
  stage.scene.step();
  Positions moved = stage.good;
  for (Eigen::Vector3d& position : moved) position.z() += 0.5;
  stage.scene.set_positions(stage.needle, moved, 0.1);
  const ReportHandle report = stage.scene.step();
  REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::broken_promise});
  CHECK(report->diagnostics()[0].message.find("further than the 0.1 promised") != std::string::npos);
}

TEST_CASE("several diagnostics come in the order of the calls, those of bound memory after them") {
  Stage stage;
  Positions bound = stage.good;
  bound[2].z() = nothing;
  stage.scene.bind_positions(stage.needle, bound);
  stage.scene.set_pose(stage.needle, lift_pose(1));
  stage.scene.ignore(stage.plate, stage.plate);
  stage.scene.set_positions(stage.plate, Positions(3, Eigen::Vector3d(0, 0, 0)));
  stage.scene.remove(ObjectId{9, 9});
  stage.scene.set_rule(300, 0, {});
  stage.scene.set_positions(stage.plate, PositionView(bound[0].data(), 4, 7));
  stage.scene.set_positions(stage.rigid, stage.good);
  const ReportHandle report = stage.scene.step();
  CHECK(kinds_of(*report) == std::vector{DiagnosticKind::wrong_motion, DiagnosticKind::bad_pair,
                                         DiagnosticKind::wrong_count, DiagnosticKind::stale_id,
                                         DiagnosticKind::bad_rule, DiagnosticKind::misaligned_memory,
                                         DiagnosticKind::wrong_motion, DiagnosticKind::not_finite});
}

TEST_CASE("every kind of diagnostic has its name") {
  CHECK(to_string(DiagnosticKind::stale_id) == "stale_id");
  CHECK(to_string(DiagnosticKind::wrong_count) == "wrong_count");
  CHECK(to_string(DiagnosticKind::null_memory) == "null_memory");
  CHECK(to_string(DiagnosticKind::misaligned_memory) == "misaligned_memory");
  CHECK(to_string(DiagnosticKind::wrong_motion) == "wrong_motion");
  CHECK(to_string(DiagnosticKind::bad_pose) == "bad_pose");
  CHECK(to_string(DiagnosticKind::not_finite) == "not_finite");
  CHECK(to_string(DiagnosticKind::too_large) == "too_large");
  CHECK(to_string(DiagnosticKind::broken_promise) == "broken_promise");
  CHECK(to_string(DiagnosticKind::bad_pair) == "bad_pair");
  CHECK(to_string(DiagnosticKind::bad_rule) == "bad_rule");
}

TEST_CASE("a bad vertex anywhere in a large surface, which several tasks read, is the one that is named") {
  const models::MeshData sheet = models::sheet(200, 200, 4, 4);
  const std::shared_ptr<const Mesh> mesh = mesh_of(sheet);
  for (const unsigned threads : {1U, 4U}) {
    SceneSettings settings = settings_of(0.5, 100);
    settings.threads = threads;
    Scene scene(settings);
    const ObjectId large = scene.add(mesh);
    scene.add(plate_mesh(), motion_of(Motion::fixed));
    const Positions good = lifted(*mesh, 2);
    Positions positions = good;
    scene.bind_positions(large, positions);
    const double distance = scene.step()->pairs()[0].distance.upper;
    for (const std::size_t bad : {std::size_t{3}, positions.size() / 2, positions.size() - 1}) {
      positions[bad].y() = nothing;
      positions.back().z() = bad == 3 ? infinity : positions.back().z();
      const ReportHandle report = scene.step();
      REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::not_finite});
      CHECK(report->diagnostics()[0].message.find("vertex " + std::to_string(bad) + " ") !=
            std::string::npos);
      CHECK(report->pairs()[0].distance.upper == distance);
      CHECK(report->pairs()[0].stale);
      positions = good;  // in the memory that is bound
      const ReportHandle after = scene.step();
      CHECK(after->diagnostics().empty());
      CHECK_FALSE(after->pairs()[0].stale);
    }
  }
}

}  // namespace graze::tests
