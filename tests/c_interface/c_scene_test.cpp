#include <cmath>
#include <limits>

#include "c_interface/c_support.hpp"
#include "scenes/mesh_of.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

// One scene is stepped by C++ and by C, and the reports are compared. Both languages reach the same code, so
// these tests find calls that C passes on in another way than graze.h says.

namespace graze::tests {
namespace {

struct FloatVertex {
  float weight = 0;
  float x = 0, y = 0, z = 0;
};

constexpr std::uint64_t first_tag = 40;
constexpr double no_promise = std::numeric_limits<double>::infinity();

/// One scene in both languages: a solid ball, a floor, a bound sheet that meets itself, and a copied tube.
class TwoScenes {
 public:
  explicit TwoScenes(const SceneSettings& settings) : cpp(settings), c(c_scene(settings)) {
    add(models::sphere(12, 8), {.name = "ball",
                                .motion = Motion::rigid,
                                .solid = true,
                                .user_data = 7,
                                .swept = true,
                                .queries = true});
    add(models::box({8, 8, 0.5}),
        {.name = "floor", .motion = Motion::fixed, .kind = 3, .face_groups = {0, 1, 2, 3, 4, 5}});
    add(models::sheet(9, 9, 4, 4), {.name = "sheet", .margin = 0.01, .self = true, .queries = true});
    add(models::torus(12, 6, 1, 0.3), {.name = "tube", .layer = 3, .collides_with = 1, .hidden_groups = {9}});
    sheet_rest = models::sheet(9, 9, 4, 4).positions;
    tube_rest = models::torus(12, 6, 1, 0.3).positions;
    bound.resize(sheet_rest.size());
    bind();
    floor_at(-1);
  }

  void add(const models::MeshData& data, const ObjectSettings& settings) {
    ids.push_back(cpp.add(scenes::mesh_of(data), settings));
    const Owned<graze_mesh> mesh = c_mesh(data);
    const graze_object_settings given = c_settings(settings);
    graze_id id{};
    expect_ok(graze_scene_add(c.get(), mesh.get(), &given, &id));
    c_ids.push_back(id);
    REQUIRE(id.index == ids.back().index);
    REQUIRE(id.generation == ids.back().generation);
  }

  void bind() {
    cpp.bind_positions(ids[2], PositionView(&bound[0].x, bound.size(), sizeof(FloatVertex)),
                       BindPolicy::when_told);
    const graze_positions view{&bound[0].x, bound.size(), sizeof(FloatVertex), 0, false};
    expect_ok(graze_scene_bind_positions(c.get(), &c_ids[2], 1, &view, GRAZE_WHEN_TOLD));
  }

  void floor_at(double height) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation().z() = height;
    cpp.set_pose(ids[1], pose, teleport);
    expect_ok(graze_scene_set_poses(c.get(), &c_ids[1], 1, rows_of(pose).data(), true));
  }

  void move(int frame) {
    Eigen::Isometry3d ball(Eigen::AngleAxisd(0.2 * frame, Eigen::Vector3d(1, 2, 3).normalized()));
    ball.translation() = Eigen::Vector3d(0.1, 0.2, 1.6 - 0.3 * frame);
    cpp.set_pose(ids[0], ball);
    expect_ok(graze_scene_set_poses(c.get(), &c_ids[0], 1, rows_of(ball).data(), false));
    for (std::size_t v = 0; v < bound.size(); ++v) {
      const Eigen::Vector3d& at = sheet_rest[v];
      bound[v].x = static_cast<float>(std::abs(at.x()) < 0.2 * frame ? -at.x() : at.x());
      bound[v].y = static_cast<float>(at.y());
      bound[v].z = static_cast<float>(0.05 * frame * at.x() * at.x());
    }
    cpp.positions_changed(ids[2]);
    expect_ok(graze_scene_positions_changed(c.get(), &c_ids[2], 1, nullptr));
    std::vector<Eigen::Vector3d> tube = tube_rest;
    for (Eigen::Vector3d& at : tube) at += Eigen::Vector3d(0.1 * frame, 0, 0.7);
    const graze_positions view = doubles(tube);
    if (frame == 5) {
      cpp.set_positions(ids[3], tube, teleport);
      expect_ok(graze_scene_teleport_positions(c.get(), &c_ids[3], 1, &view));
    } else {
      cpp.set_positions(ids[3], tube, frame == 0 ? no_promise : 0.125);
      expect_ok(graze_scene_set_positions(c.get(), &c_ids[3], 1, &view, frame == 0 ? no_promise : 0.125));
    }
  }

  /// Steps both, and returns the report of C++.
  ReportHandle step(std::uint64_t tag) {
    ReportHandle expected = cpp.step(tag);
    graze_report* room = report.release();
    const graze_status ended = graze_scene_step(c.get(), tag, &room);
    report.reset(room);
    expect_ok(ended);
    return expected;
  }

  Scene cpp;
  Owned<graze_scene> c;
  std::vector<ObjectId> ids;
  std::vector<graze_id> c_ids;
  std::vector<FloatVertex> bound;
  std::vector<Eigen::Vector3d> sheet_rest, tube_rest;
  Owned<graze_report> report;
};

/// Other calls, in a frame of their own each.
void call_others(TwoScenes& scenes, int frame) {
  const auto& ids = scenes.ids;
  const auto& c_ids = scenes.c_ids;
  graze_scene* const c = scenes.c.get();
  switch (frame) {
    case 2: {
      scenes.cpp.ignore(ids[0], ids[2]);
      expect_ok(graze_scene_ignore(c, c_ids[0], c_ids[2]));
      scenes.cpp.set_rule(3, 0, {.contact_distance = 0.25, .range = 2.0, .epsilon = {}});
      graze_pair_rule rule;
      expect_ok(graze_pair_rule_init(&rule, sizeof rule));
      rule.has_contact_distance = rule.has_range = true;
      rule.contact_distance = 0.25;
      rule.range = 2;
      expect_ok(graze_scene_set_rule(c, 3, 0, &rule));
      break;
    }
    case 3:
      scenes.cpp.watch(ids[0], ids[2]);
      expect_ok(graze_scene_watch(c, c_ids[0], c_ids[2]));
      scenes.cpp.ignore(ids[1], 5, ids[2], 0);
      expect_ok(graze_scene_ignore_groups(c, c_ids[1], 5, c_ids[2], 0));
      break;
    case 4: {
      scenes.cpp.watch(ids[1], 5, ids[2], 0);
      expect_ok(graze_scene_watch_groups(c, c_ids[1], 5, c_ids[2], 0));
      scenes.cpp.set_rule(3, 0, {});
      expect_ok(graze_scene_set_rule(c, 3, 0, nullptr));
      scenes.cpp.unbind_positions(ids[2]);
      expect_ok(graze_scene_unbind_positions(c, c_ids[2]));
      break;
    }
    case 5:
      scenes.bind();
      scenes.cpp.positions_changed(std::span(&ids[2], 1), teleport);
      expect_ok(graze_scene_positions_jumped(c, &c_ids[2], 1));
      break;
    case 6: {
      const models::MeshData finer = models::sphere(16, 10);
      const std::vector<std::uint32_t> map(models::sphere(12, 8).positions.size(), Mesh::no_vertex);
      scenes.cpp.replace_mesh(ids[0], scenes::mesh_of(finer), map);
      expect_ok(
          graze_scene_replace_mesh(c, c_ids[0], c_mesh(finer).get(), map.data(), map.size(), nullptr, 0));
      break;
    }
    case 8:
      scenes.cpp.remove(ids[3]);
      expect_ok(graze_scene_remove(c, c_ids[3]));
      break;
    default:
      break;
  }
}

}  // namespace

TEST_CASE("c: a scene answers in every detail as in C++") {
  for (const ContactDetail detail : all_details) {
    CAPTURE(name_of(detail));
    SceneSettings settings;
    settings.contact_distance = 0.125;
    settings.range = 1;
    settings.detail = detail;
    settings.threads = 1;
    settings.region_distances = 6;
    settings.max_contacts = 500;
    TwoScenes scenes(settings);
    std::size_t contacts = 0;
    std::size_t impacts = 0;
    for (int frame = 0; frame < 10; ++frame) {
      CAPTURE(frame);
      call_others(scenes, frame);
      if (frame < 8) scenes.move(frame);
      const ReportHandle expected = scenes.step(first_tag + static_cast<std::uint64_t>(frame));
      REQUIRE(is_same(scenes.report.get(), *expected));
      contacts += expected->contacts().size();
      impacts += expected->impacts().size();
    }
    CHECK((contacts > 0) == (detail != ContactDetail::none));
    CHECK(impacts > 0);
  }
}

TEST_CASE("c: many objects move in one call") {
  SceneSettings settings;
  settings.range = 10;
  settings.threads = 1;
  Scene cpp(settings);
  const auto c = c_scene(settings);
  const models::MeshData box = models::box({1, 1, 1});
  const auto mesh = c_mesh(box);
  constexpr std::size_t count = 7;  // more than C has room for without memory
  std::vector<ObjectId> ids;
  std::vector<graze_id> c_ids(count);
  std::vector<double> rows;
  std::vector<double> matrices;
  std::vector<Eigen::Isometry3d> poses;
  const ObjectSettings rigid{.motion = Motion::rigid};
  const graze_object_settings given = c_settings(rigid);
  for (std::size_t i = 0; i < count; ++i) {
    ids.push_back(cpp.add(scenes::mesh_of(box), rigid));
    expect_ok(graze_scene_add(c.get(), mesh.get(), &given, &c_ids[i]));
    Eigen::Isometry3d pose(Eigen::AngleAxisd(0.3 * static_cast<double>(i), Eigen::Vector3d::UnitY()));
    pose.translation().x() = 1.25 * static_cast<double>(i);
    poses.push_back(pose);
    const auto upper = rows_of(pose);
    rows.insert(rows.end(), upper.begin(), upper.end());
    matrices.insert(matrices.end(), upper.begin(), upper.end());
    matrices.insert(matrices.end(), {0, 0, 0, 1});
  }
  graze_report* report = nullptr;
  const auto expect_same = [&](graze_status moved) {
    expect_ok(moved);
    expect_ok(graze_scene_step(c.get(), 0, &report));
    REQUIRE(is_same(report, *cpp.step()));
    CHECK(graze_report_diagnostic_count(report) == 0);
  };
  cpp.set_poses(ids, poses);
  expect_same(graze_scene_set_poses(c.get(), c_ids.data(), count, rows.data(), false));
  cpp.set_poses(ids, poses, teleport);
  expect_same(graze_scene_set_poses(c.get(), c_ids.data(), count, rows.data(), true));
  cpp.set_poses(ids, poses);
  expect_same(graze_scene_set_pose_matrices(c.get(), c_ids.data(), count, matrices.data()));
  // A matrix that is no pose is a diagnostic of its object alone.
  matrices[15] = 2;
  expect_ok(graze_scene_set_pose_matrices(c.get(), c_ids.data(), count, matrices.data()));
  expect_ok(graze_scene_step(c.get(), 0, &report));
  REQUIRE(graze_report_diagnostic_count(report) == 1);
  graze_diagnostic diagnostic{};
  expect_ok(graze_report_diagnostic(report, 0, &diagnostic));
  CHECK(diagnostic.kind == GRAZE_BAD_POSE);
  CHECK(diagnostic.object.index == c_ids[0].index);
  CHECK(std::string(diagnostic.message).size() > 10);
  graze_report_release(report);
}

TEST_CASE("c: a scene tells of itself, and reports of what they are about") {
  SceneSettings settings;
  settings.contact_distance = 0.125;
  settings.accuracy = Accuracy::within(0.5);
  settings.time_budget = std::chrono::microseconds(12345678);
  settings.carrying_band = 0.75;
  TwoScenes scenes(settings);
  graze_scene* const c = scenes.c.get();
  CHECK(graze_scene_object_count(c) == 4);
  CHECK(graze_scene_contains(c, scenes.c_ids[3]));
  CHECK_FALSE(graze_scene_contains(c, graze_id{99, 1}));
  graze_scene_settings read;
  read.struct_size = sizeof read;
  expect_ok(graze_scene_get_settings(c, &read));
  CHECK(read.contact_distance == 0.125);
  CHECK(read.accuracy == GRAZE_WITHIN);
  CHECK(read.tolerance == 0.5);
  CHECK(read.time_budget == 12345678);
  CHECK(read.work_budget == GRAZE_NO_LIMIT);
  CHECK(read.has_carrying_band);
  CHECK(read.carrying_band == 0.75);
  graze_object_settings object;
  object.struct_size = sizeof object;
  expect_ok(graze_scene_get_object_settings(c, scenes.c_ids[1], &object));
  CHECK(std::string(object.name) == "floor");
  CHECK(object.kind == 3);
  REQUIRE(object.face_group_count == 6);
  CHECK(object.face_groups[4] == 4);
  const char* name = nullptr;
  expect_ok(graze_scene_name(c, scenes.c_ids[2], &name));
  CHECK(std::string(name) == "sheet");

  scenes.move(0);
  const ReportHandle expected = scenes.step(5);
  graze_mesh* mesh = nullptr;
  expect_ok(graze_report_mesh(scenes.report.get(), scenes.c_ids[2], &mesh));
  CHECK(graze_mesh_vertex_count(mesh) == scenes.bound.size());
  graze_mesh_release(mesh);
  graze_positions positions{};
  expect_ok(graze_report_positions(scenes.report.get(), scenes.c_ids[2], &positions));
  const PositionView view = expected->positions(scenes.ids[2]);
  REQUIRE(positions.count == view.size());
  CHECK(positions.is_double == view.is_double());
  CHECK(static_cast<const float*>(positions.first)[0] == static_cast<float>(view[0].x()));
  expect_ok(graze_report_mesh(scenes.report.get(), scenes.c_ids[1], &mesh));
  CHECK(graze_mesh_face_count(mesh) == 6);
  graze_mesh_release(mesh);
  expect_ok(graze_report_positions(scenes.report.get(), scenes.c_ids[1], &positions));
  CHECK(positions.first == nullptr);  // it has no queries
  expect_ok(graze_report_mesh(scenes.report.get(), graze_id{99, 99}, &mesh));
  CHECK(mesh == nullptr);
  expect_ok(graze_scene_mesh(c, scenes.c_ids[1], &mesh));
  CHECK(graze_mesh_face_count(mesh) == 6);
  graze_mesh_release(mesh);

  graze_statistics statistics{};
  expect_ok(graze_report_statistics(scenes.report.get(), &statistics, sizeof statistics));
  const StepStatistics& same = expected->statistics();
  CHECK(statistics.objects == 4);
  CHECK(statistics.pairs_total == same.pairs_total);
  CHECK(statistics.impacts == same.impacts);
  CHECK(statistics.boxes_tested == same.work.boxes_tested);
  CHECK(statistics.regions_expanded[1] == same.work.regions_expanded[1]);
  CHECK(statistics.swept_exact_decisions == same.work.swept_exact_decisions);
  CHECK(statistics.report_bytes > 0);
  CHECK(statistics.step_ms > 0);
}

TEST_CASE("c: reports are shared and copied, and outlive their scene") {
  SceneSettings settings;
  settings.contact_distance = 0.25;
  settings.range = 5;
  std::unique_ptr<TwoScenes> scenes = std::make_unique<TwoScenes>(settings);
  scenes->move(3);
  const ReportHandle expected = scenes->step(11);
  graze_report* shared = nullptr;
  graze_report* copy = nullptr;
  expect_ok(graze_report_share(scenes->report.get(), &shared));
  expect_ok(graze_report_copy(shared, &copy));
  const Owned<graze_report> own_shared(shared);
  const Owned<graze_report> own_copy(copy);
  CHECK(graze_report_pairs(shared, nullptr) == graze_report_pairs(scenes->report.get(), nullptr));
  CHECK(graze_report_pairs(copy, nullptr) != graze_report_pairs(shared, nullptr));
  scenes->move(4);
  static_cast<void>(scenes->step(12));
  scenes.reset();
  CHECK(is_same(shared, *expected));
  CHECK(is_same(copy, *expected));
}

TEST_CASE("c: a step on another thread") {
  SceneSettings settings;
  settings.range = 5;
  TwoScenes scenes(settings);
  scenes.move(1);
  expect_ok(graze_scene_step_async(scenes.c.get(), 3));
  graze_report* report = nullptr;
  expect_ok(graze_scene_wait(scenes.c.get(), &report));
  CHECK_FALSE(graze_scene_is_stepping(scenes.c.get()));
  CHECK(is_same(report, *scenes.cpp.step(3)));
  graze_report* latest = nullptr;
  expect_ok(graze_scene_latest_report(scenes.c.get(), &latest));
  CHECK(graze_report_pairs(latest, nullptr) == graze_report_pairs(report, nullptr));
  graze_report_release(latest);
  graze_report_release(report);
}

}  // namespace graze::tests
