// Poses and positions as programs keep them, ids as keys, and tags of steps.

#include <limits>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Catch::Matchers::Contains;

/// A needle that poses move, over a plate.
struct PosedNeedle : NeedleOverPlate {
  PosedNeedle() : NeedleOverPlate(settings_of(0.5, 100), {}, motion_of(Motion::rigid)) {}

  /// The position of the tip after a pose.
  template <typename Pose>
  Eigen::Vector3d tip_by(const Pose& pose) {
    scene.set_pose(needle, pose);
    const ReportHandle report = scene.step();
    CHECK(report->diagnostics().empty());
    return only_pair(*report).witness.point_b;
  }
  /// The message about a pose that is not taken.
  template <typename Pose>
  std::string refusal_of(const Pose& pose) {
    scene.set_pose(needle, pose);
    const ReportHandle report = scene.step();
    REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::bad_pose});
    CHECK(report->diagnostics()[0].object == needle);
    return report->diagnostics()[0].message;
  }
};

/// A quarter turn about z, exactly, and a translation that is another number in float than in double.
Eigen::Isometry3d quarter_turn() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  pose.translation() = Eigen::Vector3d(0.1, 0.2, 2.3);
  return pose;
}

/// The position of the tip, at rest (0.25, 0.5, 0), after the quarter turn and a translation.
Eigen::Vector3d turned_tip(const Eigen::Vector3d& translation) {
  return Eigen::Vector3d(-0.5, 0.25, 0) + translation;
}

}  // namespace

TEST_CASE("poses of either precision, as transforms and as matrices") {
  PosedNeedle pair;
  const Eigen::Isometry3d pose = quarter_turn();
  const Eigen::Isometry3f in_float = pose.cast<float>();
  const Eigen::Vector3d exact = turned_tip(pose.translation());
  // Used as it stands: 0.1F is not 0.1.
  const Eigen::Vector3d of_float = turned_tip({double(0.1F), double(0.2F), double(2.3F)});
  REQUIRE(exact != of_float);

  CHECK(pair.tip_by(pose) == exact);
  CHECK(pair.tip_by(in_float) == of_float);
  CHECK(pair.tip_by(Eigen::Affine3d(pose)) == exact);
  CHECK(pair.tip_by(Eigen::Affine3f(in_float)) == of_float);
  CHECK(pair.tip_by(Eigen::AffineCompact3f(in_float)) == of_float);
  CHECK(pair.tip_by(Eigen::Matrix4d(pose.matrix())) == exact);
  CHECK(pair.tip_by(Eigen::Matrix4f(in_float.matrix())) == of_float);
  CHECK(pair.tip_by(Eigen::Matrix<float, 4, 4, Eigen::RowMajor>(in_float.matrix())) == of_float);
  CHECK(pair.tip_by(Eigen::Map<const Eigen::Matrix4f>(in_float.matrix().data())) == of_float);
  CHECK(pair.tip_by(pose.matrix() * Eigen::Matrix4d::Identity()) == exact);
  pair.scene.set_pose_matrix(pair.needle, {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1});
  CHECK(only_pair(*pair.scene.step()).witness.point_b == turned_tip({1, 2, 3}));
}

TEST_CASE("a 4x4 matrix whose last row is not 0 0 0 1 is a bad pose") {
  PosedNeedle pair;
  const Eigen::Matrix4d good = quarter_turn().matrix();
  pair.tip_by(good);
  Eigen::Matrix4d bad = good;
  bad(3, 2) = -1;
  CHECK_THAT(pair.refusal_of(bad), Contains("the last row of the pose is (0, 0, -1, 1), not (0, 0, 0, 1)"));
  CHECK_THAT(pair.refusal_of(Eigen::Matrix4f(good.transpose().cast<float>())),
             Contains("the translation belongs into the last column"));
  bad = good;
  bad(3, 3) = 0;
  CHECK_THAT(pair.refusal_of(bad), Contains("(0, 0, 0, 0)"));
  bad(3, 3) = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(pair.refusal_of(bad), Contains("(0, 0, 0, nan)"));
  bad(3, 3) = 1 + 2e-6;
  pair.refusal_of(bad);
  // An inverse in float leaves a little.
  bad(3, 3) = 1 - 5e-7;
  bad(3, 0) = 1e-7;
  CHECK(pair.tip_by(bad) == turned_tip({0.1, 0.2, 2.3}));
}

TEST_CASE("positions that lie apart give the report of those that follow one another") {
  struct Vertex {
    float u;
    float x, y, z;
  };
  oracle::Random random(9);
  for (const ContactDetail detail : {ContactDetail::features, ContactDetail::vertices}) {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      const oracle::RandomScene shapes = oracle::random_scene(seed);
      const auto mesh = mesh_of(shapes.a);
      Scene plain(settings_of(0.5, 10, detail)), copied(plain.settings()), bound(plain.settings()),
          of_structs(plain.settings());
      for (Scene* scene : {&plain, &copied, &bound, &of_structs}) scene->add(mesh_of(shapes.b));
      const ObjectId id = plain.add(mesh);
      for (Scene* scene : {&copied, &bound, &of_structs}) REQUIRE(scene->add(mesh) == id);
      Eigen::MatrixXd matrix(mesh->vertex_count(), 3);
      std::vector<Vertex> vertices(mesh->vertex_count());
      bound.bind_positions(id, matrix);
      of_structs.bind_positions(id, PositionView(vertices, &Vertex::x));
      for (int frame = 0; frame < 3; ++frame) {
        std::vector<Eigen::Vector3f> positions;
        for (std::uint32_t i = 0; i < mesh->vertex_count(); ++i) {
          const Eigen::Vector3f p = (mesh->rest()[i] + random.vector(-0.1, 0.1)).cast<float>();
          positions.push_back(p);
          matrix.row(i) = p.transpose().cast<double>();
          vertices[i] = {-1, p.x(), p.y(), p.z()};
        }
        plain.set_positions(id, positions);
        copied.set_positions(id, matrix);
        const ReportHandle expected = plain.step();
        for (Scene* scene : {&copied, &bound, &of_structs})
          CHECK(difference_of(*scene->step(), *expected).empty());
      }
    }
  }
}

TEST_CASE("coordinates that are not aligned to their numbers are told") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  std::vector<double> memory(9);
  pair.scene.set_positions(pair.needle,
                           PositionView(memory.data(), 3, sizeof(double), 3 * sizeof(double) + 4));
  CHECK(kinds_of(*pair.scene.step()) == std::vector{DiagnosticKind::misaligned_memory});
}

TEST_CASE("ids are keys of unordered maps, and neighbours fall apart") {
  std::unordered_map<ObjectId, int> numbers;
  std::unordered_set<std::size_t> hashes, low_bits;
  for (std::uint32_t index = 0; index < 100; ++index)
    for (std::uint32_t generation = 1; generation <= 10; ++generation) {
      const ObjectId id{index, generation};
      numbers[id] = static_cast<int>(10 * index + generation);
      hashes.insert(std::hash<ObjectId>()(id));
      low_bits.insert(std::hash<ObjectId>()(id) % 4096);
    }
  CHECK(numbers.size() == 1000);
  CHECK(numbers.at(ObjectId{42, 7}) == 427);
  CHECK(hashes.size() == 1000);
  CHECK(low_bits.size() > 850);  // 887 of 4096 are to be expected by chance
}

TEST_CASE("a report carries the caller's tag") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  CHECK(pair.scene.latest_report()->tag() == 0);
  const ReportHandle first = pair.scene.step(77);
  const ReportHandle second = pair.scene.step();
  pair.scene.step_async(std::numeric_limits<std::uint64_t>::max());
  const ReportHandle third = pair.scene.wait();
  const ReportHandle fourth = pair.scene.step(77);  // shares its rows with the one before
  CHECK(first->tag() == 77);
  CHECK(second->tag() == 0);
  CHECK(third->tag() == std::numeric_limits<std::uint64_t>::max());
  CHECK(fourth->tag() == 77);
  CHECK(FrameReport(*first).tag() == 77);
  FrameReport assigned;
  assigned = *first;
  CHECK(assigned.tag() == 77);
}

TEST_CASE("more threads than max_threads count as so many") {
  CHECK(max_threads() >= 8);
  CHECK(max_threads() % 8 == 0);
  for (const ArenaPolicy arena : {ArenaPolicy::own, ArenaPolicy::callers}) {
    SceneSettings settings = settings_of(0.5, 100);
    settings.arena = arena;
    NeedleOverPlate expected(settings);
    settings.threads = 4'000'000'000U;
    NeedleOverPlate pair(settings);
    CHECK(difference_of(*pair.step_at(0.25), *expected.step_at(0.25)).empty());
  }
}

}  // namespace graze::tests
