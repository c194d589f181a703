// Patches: what they say between steps, against a scene that steps to the same positions. The tool is at
// random places, inside and outside of what the patch knows.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <graze/graze.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/error_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using oracle::Random;

Eigen::Isometry3d random_pose(Random& random, double reach) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = random.turn();
  pose.translation() = random.vector(-reach, reach);
  return pose;
}

Positions dented(Random& random, std::span<const Eigen::Vector3d> rest, const Eigen::Vector3d& place) {
  Positions now(rest.begin(), rest.end());
  const Eigen::Vector3d wave = random.vector(1, 3);
  const double depth = random.between(0, 0.2);
  for (Eigen::Vector3d& point : now)
    point += place + Eigen::Vector3d::Constant(depth * std::sin(wave.dot(point)));
  return now;
}

/// How often something was seen in all answers.
struct Seen {
  std::size_t complete = 0, incomplete = 0, cut = 0, contacts = 0, inside = 0, unknown = 0;
};

/// A scene with two tools that have patches, and one at the same positions that lists everything.
class PatchedScene {
 public:
  PatchedScene(std::uint64_t seed, ContactDetail detail, Seen& seen)
      : random_(seed),
        seen_(seen),
        scene_({.contact_distance = 0.05, .detail = detail, .threads = 1 + random_.below(3)}),
        oracle_({.detail = ContactDetail::nearest, .threads = 1}) {
    const auto ball = mesh_of(models::sphere(24, 14));
    const auto quads = mesh_of(models::sphere(20, 12, models::Faces::quads));
    const auto sheet = mesh_of(models::sheet(24, 24, 3, 3));
    const auto box = mesh_of(models::box({0.6, 0.4, 0.5}));
    const auto small = mesh_of(models::sphere(12, 6));
    // The tools are not the first objects, so that they are a or b in their pairs.
    add(sheet, {.motion = Motion::fixed});
    add(random_.chance(0.5) ? ball : quads, {.solid = random_.chance(0.5)});
    add_tool(random_.chance(0.5) ? box : small, Motion::rigid);
    add(sheet,
        {.hidden_groups = random_.chance(0.5) ? std::vector<std::uint8_t>{2} : std::vector<std::uint8_t>{}});
    add(ball, {.motion = Motion::rigid, .solid = random_.chance(0.5)});
    add_tool(small, Motion::deformable);
    add(box, {.motion = Motion::rigid, .layer = random_.chance(0.5) ? 2U : 1U});
    if (random_.chance(0.3)) ignore(ids_[2], ids_[4]);
    if (random_.chance(0.5)) ignore_groups(ids_[0], ids_[2]);
    if (random_.chance(0.5)) ignore_groups(ids_[5], ids_[3]);
  }

  /// Moves everything, and steps the scene.
  void step() {
    for (std::size_t i = 0; i < ids_.size(); ++i) place(i);
    report_ = scene_.step();
  }
  /// Asks for a tool at a random place near where it is, and compares.
  void ask(std::size_t tool) {
    const double radius = settings_[tool].patch_radius;
    const double threshold = random_.chance(0.1) ? 0 : random_.between(0, radius);
    const double reach = random_.chance(0.2) ? 2 * radius : random_.between(0, radius);
    std::optional<Eigen::Isometry3d> pose;
    Positions positions = positions_[tool];
    if (settings_[tool].motion == Motion::rigid) {
      const Eigen::Vector3d by = random_.vector(-reach, reach);
      const Eigen::AngleAxisd turn(random_.between(0, reach), Eigen::Vector3d::UnitZ());
      pose = Eigen::Isometry3d(Eigen::Translation3d(by) * turn) * poses_[tool];
    } else {
      const Eigen::Vector3d by = random_.vector(-reach, reach) / 2;
      for (Eigen::Vector3d& point : positions) point += by + random_.vector(-reach, reach) / 8;
    }
    const Patch patch = report_->patch(ids_[tool]);
    REQUIRE(patch);
    const PatchAnswer answer =
        pose ? patch.contacts(*pose, threshold, room_) : patch.contacts(positions, threshold, room_);
    check(patch, answer, threshold,
          pose ? patch.validity(*pose, threshold) : patch.validity(positions, threshold));
    compare(tool, pose, positions, answer);
  }

  static constexpr std::array<std::size_t, 2> tools{2, 5};

 private:
  void add(const std::shared_ptr<const Mesh>& mesh, ObjectSettings settings) {
    settings.face_groups.resize(mesh->face_count());
    for (std::size_t face = 0; face < settings.face_groups.size(); ++face)
      settings.face_groups[face] = static_cast<std::uint8_t>(face / 7 % 3);
    ids_.push_back(scene_.add(mesh, settings));
    settings_.push_back(settings);
    poses_.push_back(Eigen::Isometry3d::Identity());
    positions_.emplace_back(mesh->rest().begin(), mesh->rest().end());
    meshes_.push_back(mesh);
    settings.patch_radius = 0;
    oracle_ids_.push_back(oracle_.add(mesh, settings));
  }
  void add_tool(const std::shared_ptr<const Mesh>& mesh, Motion motion) {
    ObjectSettings settings;
    settings.motion = motion;
    settings.patch_radius = random_.between(0.1, 0.6);
    if (random_.chance(0.5)) settings.patch_faces = 1 + random_.below(600);
    settings.solid = random_.chance(0.5);
    add(mesh, settings);
  }
  void ignore(ObjectId a, ObjectId b) {
    scene_.ignore(a, b);
    oracle_.ignore(oracle_of(a), oracle_of(b));
  }
  void ignore_groups(ObjectId a, ObjectId b) {
    const auto group_a = static_cast<std::uint8_t>(random_.below(3));
    const auto group_b = static_cast<std::uint8_t>(random_.below(3));
    scene_.ignore(a, group_a, b, group_b);
    oracle_.ignore(oracle_of(a), group_a, oracle_of(b), group_b);
  }
  [[nodiscard]] ObjectId oracle_of(ObjectId id) const {
    return oracle_ids_[static_cast<std::size_t>(std::find(ids_.begin(), ids_.end(), id) - ids_.begin())];
  }

  void place(std::size_t index) {
    if (settings_[index].motion == Motion::deformable) {
      positions_[index] = dented(random_, meshes_[index]->rest(), random_.vector(-0.8, 0.8));
      scene_.set_positions(ids_[index], positions_[index]);
    } else {
      poses_[index] = random_pose(random_, 0.8);
      scene_.set_pose(ids_[index], poses_[index]);
    }
    give_to_oracle(index, poses_[index], positions_[index]);
  }
  void give_to_oracle(std::size_t index, const Eigen::Isometry3d& pose, const Positions& positions) {
    if (settings_[index].motion == Motion::deformable)
      oracle_.set_positions(oracle_ids_[index], positions);
    else
      oracle_.set_pose(oracle_ids_[index], pose);
  }

  void check(const Patch& patch, const PatchAnswer& answer, double threshold, double validity) {
    CHECK(answer.threshold <= threshold);
    CHECK(answer.complete == (answer.threshold == threshold));
    CHECK(answer.validity >= 0);
    CHECK(answer.validity == validity);
    CHECK(answer.validity <= patch.radius());
    ++(answer.complete ? seen_.complete : seen_.incomplete);
    seen_.cut += patch.is_cut();
    seen_.unknown += answer.threshold < 0;
    if (answer.threshold < 0) CHECK(room_.pairs().empty());
  }

  /// Lets the other scene step with the tool there, at the threshold that the answer is about.
  void compare(std::size_t tool, const std::optional<Eigen::Isometry3d>& pose, const Positions& positions,
               const PatchAnswer& answer) {
    if (answer.threshold < 0) return;
    oracle_.set_rule(0, 0, {.contact_distance = answer.threshold, .range = 0.0});
    give_to_oracle(tool, pose.value_or(poses_[tool]), positions);
    const ReportHandle truth = oracle_.step();
    give_to_oracle(tool, poses_[tool], positions_[tool]);
    std::size_t pairs = 0;
    for (const PairReport& row : truth->pairs()) {
      if (row.a != oracle_ids_[tool] && row.b != oracle_ids_[tool]) continue;
      if (row.phase != PairPhase::began && row.phase != PairPhase::touching) continue;
      REQUIRE(pairs < room_.pairs().size());
      const PatchPair& pair = room_.pairs()[pairs++];
      CHECK(oracle_of(pair.a) == row.a);
      CHECK(oracle_of(pair.b) == row.b);
      CHECK(pair.inside == row.inside);
      compare(room_.contacts(pair), truth->contacts(row));
    }
    CHECK(pairs == room_.pairs().size());
  }
  void compare(std::span<const Contact> found, std::span<const Contact> expected) {
    REQUIRE(found.size() == expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      Contact of_scene = expected[i];
      of_scene.since = 0;
      CHECK(is_same(found[i], of_scene));
      ++seen_.contacts;
      seen_.inside += of_scene.separation() < 0;
    }
  }
  static bool is_same(const Contact& left, const Contact& right) {
    return left.kind == right.kind && left.feature_a == right.feature_a &&
           left.feature_b == right.feature_b && left.point_a == right.point_a &&
           left.point_b == right.point_b && left.normal == right.normal && left.distance == right.distance &&
           left.side_a == right.side_a && left.side_b == right.side_b && left.push() == right.push() &&
           left.separation() == right.separation() && left.since == right.since;
  }

  Random random_;
  Seen& seen_;
  Scene scene_, oracle_;
  std::vector<ObjectId> ids_, oracle_ids_;
  std::vector<ObjectSettings> settings_;
  std::vector<std::shared_ptr<const Mesh>> meshes_;
  std::vector<Eigen::Isometry3d> poses_;
  std::vector<Positions> positions_;
  ReportHandle report_;
  PatchRoom room_;
};

}  // namespace

TEST_CASE("a patch says what a scene would say") {
  Seen seen;
  for (std::uint64_t seed = 0; seed < std::max<std::uint64_t>(4, repeats(20)); ++seed) {
    PatchedScene scene(seed, seed % 5 == 0 ? ContactDetail::vertices : ContactDetail::nearest, seen);
    for (int step = 0; step < 4; ++step) {
      scene.step();
      for (int trial = 0; trial < 25; ++trial) {
        INFO("seed " << seed << ", step " << step << ", trial " << trial);
        for (const std::size_t tool : PatchedScene::tools) scene.ask(tool);
      }
    }
  }
  CHECK(seen.complete > 100);
  CHECK(seen.incomplete > 100);
  CHECK(seen.cut > 100);
  CHECK(seen.contacts > 1000);
  CHECK(seen.inside > 100);
  CHECK(seen.unknown > 20);
}

TEST_CASE("inside its validity a patch misses nothing, whatever the tool and the tissue do") {
  // The tissue moves as well, so the positions are those of a later step. What is nearer than the threshold
  // there has its faces in the patch of the step before, as long as both together stay within the validity.
  Random random(5);
  const auto organ = mesh_of(models::sphere(40, 24));
  const auto probe = mesh_of(models::sphere(8, 4));
  constexpr double threshold = 0.02;
  Scene scene({.contact_distance = threshold, .threads = 1});
  const ObjectId tissue = scene.add(organ, {});
  const ObjectId tool = scene.add(probe, {.motion = Motion::rigid, .patch_radius = 0.15});
  RepeatedQuery whole(*organ, *probe,
                      {.contact_distance = threshold, .range = 0, .detail = ContactDetail::nearest});
  std::size_t near = 0;
  for (std::uint64_t step = 0; step < repeats(1000); ++step) {
    const Positions before = dented(random, organ->rest(), Eigen::Vector3d::Zero());
    const Eigen::Isometry3d pose(
        Eigen::Translation3d(random.vector(-1, 1).normalized() * random.between(1.9, 2.2)));
    scene.set_positions(tissue, before);
    scene.set_pose(tool, pose);
    const ReportHandle report = scene.step();
    const Patch patch = report->patch(tool);
    REQUIRE(patch.validity(pose, threshold) == patch.validity(pose));
    for (int trial = 0; trial < 10; ++trial) {
      Eigen::Isometry3d moved = pose;
      moved.translation() += random.vector(-0.05, 0.05);
      const double left = patch.validity(moved);
      Positions after = before;
      for (Eigen::Vector3d& point : after) point += random.vector(-1, 1).normalized() * (0.999 * left);
      Positions there(probe->rest().begin(), probe->rest().end());
      for (Eigen::Vector3d& point : there) point = moved * point;
      const QueryResult& truth = whole.ask(after, there);
      const auto faces = patch.faces(tissue);
      for (const Contact& contact : truth.contacts) {
        std::span<const std::uint32_t> around;
        if (contact.feature_a.kind == FeatureKind::vertex)
          around = organ->vertex_faces(contact.feature_a.index);
        if (contact.feature_a.kind == FeatureKind::edge) around = organ->edge_faces(contact.feature_a.index);
        if (contact.feature_a.kind == FeatureKind::face) around = std::span(&contact.feature_a.index, 1);
        for (const std::uint32_t face : around) {
          REQUIRE(std::binary_search(faces.begin(), faces.end(), face));
          ++near;
        }
      }
    }
  }
  CHECK(near > 100);
}

TEST_CASE("a patch has the positions of its step, for as long as its report") {
  const auto sheet = mesh_of(models::sheet(30, 30, 3, 3));
  auto scene = std::make_unique<Scene>(SceneSettings{.threads = 1});
  const ObjectId floor = scene->add(sheet, {});
  const ObjectId tool = scene->add(mesh_of(models::box({0.1, 0.1, 0.1})),
                                   {.motion = Motion::rigid, .patch_radius = 0.4, .patch_faces = 100});
  const ObjectId far = scene->add(sheet, {.motion = Motion::fixed});
  scene->set_pose(far, lift_pose(3));
  scene->set_pose(tool, lift_pose(0.3));
  scene->set_positions(floor, lifted(*sheet, 0.125));
  const ReportHandle first = scene->step();
  const FrameReport copy = *first;
  scene->set_positions(floor, lifted(*sheet, -0.25));
  const ReportHandle second = scene->step();
  const ReportHandle repeated = scene->step();
  scene->remove(tool);
  const ReportHandle without = scene->step();
  scene.reset();
  CHECK(!without->patch(tool));
  CHECK(!first->patch(floor));
  for (const auto& [patch, height] :
       {std::pair{first->patch(tool), 0.125}, std::pair{copy.patch(tool), 0.125},
        std::pair{second->patch(tool), -0.25}, std::pair{repeated->patch(tool), -0.25}}) {
    REQUIRE(patch);
    CHECK(patch.tool() == tool);
    REQUIRE(patch.objects().size() == (height > 0 ? 1 : 0));
    CHECK(patch.face_count() <= 100);
    CHECK(patch.radius() <= 0.4);
    CHECK(patch.faces(far).empty());
    if (height < 0) continue;
    CHECK(patch.is_cut());
    CHECK(patch.objects()[0] == floor);
    const auto faces = patch.faces(floor);
    CHECK(faces.size() == patch.face_count());
    CHECK(std::is_sorted(faces.begin(), faces.end()));
    for (const std::uint32_t face : faces)
      for (const std::uint32_t corner : sheet->face(face))
        CHECK(patch.positions(floor)[corner] == lifted(*sheet, height)[corner]);
    PatchRoom room;
    const PatchAnswer answer = patch.contacts(lift_pose(0.2), 0.05, room);
    CHECK(answer.complete);
    CHECK(!room.contacts().empty());
  }
}

TEST_CASE("objects that promises leave unread are read where a tool is near") {
  const auto box = mesh_of(models::box({1, 1, 1}));
  Scene scene({.threads = 1});
  const ObjectId still = scene.add(box, {});
  const ObjectId tool = scene.add(box, {.motion = Motion::rigid, .patch_radius = 0.5});
  scene.set_pose(tool, lift_pose(5));
  scene.step();
  scene.set_positions(still, lifted(*box, 0.01), 0.02);
  scene.step();
  CHECK(scene.latest_report()->patch(tool).objects().empty());
  scene.set_pose(tool, lift_pose(1.375));
  scene.set_positions(still, lifted(*box, 0.02), 0.02);
  const ReportHandle report = scene.step();
  REQUIRE(report->patch(tool).objects().size() == 1);
  CHECK(report->patch(tool).positions(still)[0].z() == lifted(*box, 0.02)[0].z());
  CHECK(report->pairs().empty());
}

TEST_CASE("two edges that touch have the side of the whole surface, also where one of them is long") {
  // The end of the long edge has many faces, far away. They decide the direction at distance 0.
  constexpr std::uint32_t around = 60;
  models::MeshData ridge;
  ridge.positions = {{-5, 0, 0}, {0, 1, -1}, {0, -1, -1}};
  ridge.add_face({0, around + 3, 1});
  ridge.add_face({0, 2, around + 3});
  for (std::uint32_t i = 0; i < around; ++i) {
    const double angle = 2 * 3.14159265358979 * i / around;
    ridge.positions.emplace_back(5 + 0.3 * std::cos(angle), 0.3 * std::sin(angle), 0.001 * i);
    ridge.add_face({3 + i, around + 3, 3 + (i + 1) % around});
  }
  ridge.positions.emplace_back(5, 0, 0);
  models::MeshData blade;
  blade.positions = {{0, -0.5, 0}, {0, 0.5, 0}, {0, 0, 1}};
  blade.add_face({0, 1, 2});
  Scene scene({.contact_distance = 0.05, .detail = ContactDetail::nearest, .threads = 1});
  scene.add(mesh_of(ridge), {});
  const ObjectId tool = scene.add(mesh_of(blade), {.patch_radius = 1});
  const ReportHandle report = scene.step();
  const Patch patch = report->patch(tool);
  CHECK(patch.face_count() < ridge.corner_counts.size());
  PatchRoom room;
  CHECK(patch.contacts(blade.positions, 0.05, room).complete);
  const auto expected = report->contacts();
  REQUIRE(room.contacts().size() == expected.size());
  REQUIRE(!expected.empty());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(room.contacts()[i].normal == expected[i].normal);
    CHECK(room.contacts()[i].side_a == expected[i].side_a);
  }
}

TEST_CASE("a patch knows nothing of a frozen object whose place it does not have") {
  const auto sheet = mesh_of(models::sheet(150, 150, 3, 3));
  const auto box = mesh_of(models::box({0.2, 0.2, 0.2}));
  for (const ContactDetail detail : {ContactDetail::vertices, ContactDetail::nearest})
    for (const bool begins_far : {false, true}) {
      INFO("detail " << static_cast<int>(detail) << ", begins far " << begins_far);
      Scene scene({.contact_distance = 0.25, .range = 1, .detail = detail, .threads = 1});
      Positions memory = lifted(*sheet, -0.3);
      const ObjectId tissue = scene.add(sheet, {});
      const ObjectId tool = scene.add(box, {.motion = Motion::rigid, .patch_radius = 0.5});
      scene.bind_positions(tissue, memory);
      for (int step = 0; step < 4; ++step) {
        for (Eigen::Vector3d& point : memory) point.z() += 0.001;
        scene.set_pose(tool, lift_pose(begins_far ? 9 : -0.1 + 0.001 * step));
        scene.step();
      }
      const double last = memory[0].z();
      for (Eigen::Vector3d& point : memory) point = Eigen::Vector3d::Constant(std::nan(""));
      scene.set_pose(tool, lift_pose(-0.1));
      const ReportHandle report = scene.step();
      REQUIRE(report->diagnostics().size() == 1);
      const Patch patch = report->patch(tool);
      PatchRoom room;
      const PatchAnswer answer = patch.contacts(lift_pose(-0.15), 0.1, room);
      if (patch.objects().empty()) {
        CHECK(!answer.complete);
        CHECK(patch.radius() < 0.2);
      } else {
        CHECK(patch.positions(tissue)[sheet->face(patch.faces(tissue)[0])[0]].z() == last);
        CHECK(!room.contacts().empty());
      }
    }
}

TEST_CASE("patches keep nothing of objects that are gone, also where groups were ignored") {
  Scene scene({.threads = 1});
  const ObjectId tool = scene.add(mesh_of(models::sphere(12, 6)), {.patch_radius = 1});
  const auto box = mesh_of(models::box({1, 1, 1}));
  std::vector<std::uint64_t> bytes;
  for (int step = 0; step < 200; ++step) {
    ObjectSettings settings;
    for (std::uint32_t face = 0; face < box->face_count(); ++face) settings.face_groups.push_back(face % 2);
    const ObjectId guest = scene.add(box, settings);
    scene.ignore(tool, 0, guest, 1);
    const ReportHandle report = scene.step();
    CHECK(report->patch(tool).objects().size() == 1);
    bytes.push_back(report->statistics().bytes.reports);
    scene.remove(guest);
  }
  CHECK(bytes.back() <= *std::max_element(bytes.begin() + 10, bytes.begin() + 40));
}

TEST_CASE("a patch refuses what a scene refuses, and an empty one knows nothing") {
  Scene scene({.threads = 1});
  const auto plate = plate_mesh();
  const ObjectId tool = scene.add(plate, {.patch_radius = 1});
  scene.add(needle_mesh(), {});
  const ReportHandle report = scene.step();
  const Patch patch = report->patch(tool);
  PatchRoom room;
  const Positions few(2, Eigen::Vector3d::Zero());
  Positions bad = lifted(*plate, 0);
  bad[1].x() = std::nan("");
  CHECK(error_of([&] { (void)patch.contacts(few, 0.1, room); }).find("positions") != std::string::npos);
  CHECK(error_of([&] { (void)patch.contacts(bad, 0.1, room); }).find("vertex 1") != std::string::npos);
  CHECK(error_of([&] { (void)patch.validity(bad); }).find("vertex 1") != std::string::npos);
  CHECK(error_of([&] { (void)patch.contacts(lift_pose(0), -1, room); }).find("threshold") !=
        std::string::npos);
  CHECK(!error_of([&] {
           Eigen::Isometry3d mirrored = lift_pose(0);
           mirrored.linear()(0, 0) = -1;
           (void)patch.contacts(mirrored, 0.1, room);
         }).empty());
  CHECK(room.pairs().empty());
  CHECK(!error_of([&] { scene.add(plate, {.patch_radius = -1}); }).empty());
  CHECK(!error_of([&] { scene.add(plate, {.patch_radius = 1, .patch_faces = 0}); }).empty());
  const Patch empty;
  CHECK((!empty && empty.face_count() == 0 && empty.objects().empty() && empty.validity(lift_pose(0)) == 0));
  const PatchAnswer nothing = empty.contacts(lift_pose(0), 0.1, room);
  CHECK((!nothing.complete && nothing.threshold < 0 && room.contacts().empty()));
}

TEST_CASE("threads ask patches while the scene steps") {
  Random random(7);
  const auto organ = mesh_of(models::sphere(24, 14));
  Scene scene({.contact_distance = 0.05, .threads = 2});
  const ObjectId tissue = scene.add(organ, {.solid = true});
  const ObjectId sheet = scene.add(mesh_of(models::sheet(20, 20, 3, 3)), {.motion = Motion::rigid});
  const ObjectId tool =
      scene.add(mesh_of(models::sphere(8, 4)), {.motion = Motion::rigid, .patch_radius = 0.5});
  scene.set_pose(tool, lift_pose(1.5));
  scene.set_pose(sheet, lift_pose(1));
  scene.step();
  std::atomic<bool> is_done = false;
  std::atomic<std::size_t> different = 0;
  std::vector<std::thread> threads;
  for (int number = 0; number < 2; ++number)
    threads.emplace_back([&, number] {
      PatchRoom room, again;
      while (!is_done) {
        const ReportHandle report = scene.latest_report();
        const Eigen::Isometry3d pose = lift_pose(1.9 + 0.01 * number);
        const PatchAnswer answer = report->patch(tool).contacts(pose, 0.1, room);
        report->patch(tool).contacts(pose, 0.1, again);
        if (answer.threshold > 0.1 || room.contacts().size() != again.contacts().size()) ++different;
      }
    });
  for (std::uint64_t step = 0; step < std::max<std::uint64_t>(20, repeats(200)); ++step) {
    scene.set_positions(tissue, dented(random, organ->rest(), Eigen::Vector3d::Zero()));
    scene.set_pose(tool, lift_pose(random.between(1.8, 2.2)));
    scene.step();
  }
  is_done = true;
  for (std::thread& thread : threads) thread.join();
  CHECK(different == 0);
}

}  // namespace graze::tests
