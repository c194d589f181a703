#include <atomic>
#include <filesystem>
#include <thread>

#include "c_interface/c_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// A file of this test, which is removed at its end.
class TestFile {
 public:
  explicit TestFile(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("graze_c_" + name + ".graze")) {}
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  ~TestFile() { std::filesystem::remove(path_); }
  [[nodiscard]] std::string name() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// A ball that falls through a fixed plate, frame by frame.
class FallingBall {
 public:
  FallingBall() {
    SceneSettings settings;
    settings.contact_distance = 0.125;
    settings.range = 1;
    settings.threads = 1;
    scene_ = c_scene(settings);
    const auto ball = c_mesh(models::sphere(12, 8));
    const auto plate = c_mesh(models::sheet(5, 5, 4, 4));
    const ObjectSettings of_ball{.name = "ball", .motion = Motion::rigid};
    const graze_object_settings rigid = c_settings(of_ball);
    expect_ok(graze_scene_add(scene_.get(), ball.get(), &rigid, &id_));
    graze_id plate_id{};
    expect_ok(graze_scene_add(scene_.get(), plate.get(), nullptr, &plate_id));
  }
  [[nodiscard]] graze_scene* scene() const { return scene_.get(); }

  void step(int frame) {
    const double rows[12] = {1, 0, 0, 0.1, 0, 1, 0, 0.1, 0, 0, 1, 2 - 0.25 * frame};
    expect_ok(graze_scene_set_poses(scene_.get(), &id_, 1, rows, false));
    expect_ok(graze_scene_step(scene_.get(), static_cast<std::uint64_t>(100 + frame), nullptr));
  }

 private:
  Owned<graze_scene> scene_;
  graze_id id_{};
};

}  // namespace

TEST_CASE("c: what a recorder records replays the same, and can be cut") {
  const TestFile file("all");
  const TestFile part("part");
  FallingBall world;
  graze_recorder* made = nullptr;
  graze_recorder_settings settings;
  expect_ok(graze_recorder_settings_init(&settings, sizeof settings));
  settings.keyframe_interval = 4;
  settings.when_behind = GRAZE_WAIT;
  expect_ok(graze_recorder_new(world.scene(), file.name().c_str(), &settings, &made));
  const Owned<graze_recorder> recorder(made);
  graze_recorder* second = nullptr;
  expect_fails(graze_recorder_new(world.scene(), part.name().c_str(), nullptr, &second), GRAZE_REFUSED,
               "record");
  for (int frame = 0; frame < 12; ++frame) world.step(frame);
  expect_ok(graze_recorder_close(recorder.get()));
  graze_recorder_statistics statistics{};
  expect_ok(graze_recorder_get_statistics(recorder.get(), &statistics));
  CHECK(statistics.frames == 12);
  CHECK(statistics.dropped == 0);

  graze_recording* opened = nullptr;
  expect_ok(graze_recording_open(file.name().c_str(), &opened));
  Owned<graze_recording> recording(opened);
  CHECK(graze_recording_frame_count(opened) == 12);
  CHECK(graze_recording_mesh_count(opened) == 2);
  CHECK(graze_recording_is_finished(opened));
  CHECK_FALSE(graze_recording_is_cut(opened));
  CHECK(graze_recording_dropped_at_end(opened) == 0);
  CHECK(graze_recording_byte_count(opened) == std::filesystem::file_size(file.name()));
  CHECK_FALSE(std::string(graze_recording_made_by(opened)).empty());
  expect_ok(graze_recording_check(opened));
  graze_scene_settings recorded;
  recorded.struct_size = sizeof recorded;
  expect_ok(graze_recording_settings(opened, &recorded));
  CHECK(recorded.contact_distance == 0.125);
  graze_recorded_frame frame{};
  expect_ok(graze_recording_frame(opened, 5, &frame));
  CHECK(frame.tag == 105);
  expect_fails(graze_recording_frame(opened, 12, &frame), GRAZE_BAD_ARGUMENT, "12");
  expect_ok(graze_recording_cut(opened, 4, 6, nullptr, 0, part.name().c_str()));

  graze_replay* replay_made = nullptr;
  expect_ok(graze_replay_new(opened, 5, UINT32_MAX, &replay_made));
  const Owned<graze_replay> replay(replay_made);
  recording.reset();  // the replay keeps what it reads
  graze_report* report = nullptr;
  std::size_t frames = 0;
  bool has_stepped = false;
  while (graze_replay_step(replay.get(), &has_stepped) == GRAZE_OK && has_stepped) {
    CHECK(graze_replay_frame_index(replay.get()) == 5 + frames);
    expect_ok(graze_replay_report(replay.get(), &report));
    CHECK(graze_report_tag(report) == 105 + frames);
    CHECK_FALSE(graze_replay_get_difference(replay.get(), nullptr));
    CHECK(graze_replay_rows_not_compared(replay.get()) == 0);
    CHECK(graze_replay_rows_compared_in_part(replay.get()) == 0);
    ++frames;
  }
  CHECK(frames == 7);
  REQUIRE(graze_replay_object_count(replay.get()) == 2);
  graze_id id{};
  std::uint64_t serial = 9;
  graze_mesh* mesh = nullptr;
  graze_object_settings object;
  object.struct_size = sizeof object;
  expect_ok(graze_replay_object(replay.get(), 0, &id, &serial, &mesh, &object));
  CHECK(serial == 0);
  CHECK(std::string(object.name) == "ball");
  double rows[12];
  expect_ok(graze_replay_pose(replay.get(), 0, rows));
  CHECK(rows[11] == 2 - 0.25 * 11);
  std::vector<double> positions(std::size_t{3} * graze_mesh_vertex_count(mesh));
  expect_ok(graze_replay_positions(replay.get(), 0, positions.data(), graze_mesh_vertex_count(mesh)));
  CHECK(positions[2] == graze_mesh_rest(mesh)[2] + rows[11]);
  expect_fails(graze_replay_positions(replay.get(), 0, positions.data(), 1), GRAZE_BAD_ARGUMENT,
               "vertex_count");
  expect_fails(graze_replay_pose(replay.get(), 2, rows), GRAZE_BAD_ARGUMENT, "index");
  graze_mesh_release(mesh);
  graze_report_release(report);

  expect_ok(graze_recording_open(part.name().c_str(), &opened));
  const Owned<graze_recording> cut(opened);
  CHECK(graze_recording_frame_count(opened) == 3);
  CHECK(graze_recording_is_cut(opened));
}

TEST_CASE("c: a recorder in memory") {
  const TestFile file("ring");
  FallingBall world;
  graze_recorder_settings settings;
  expect_ok(graze_recorder_settings_init(&settings, sizeof settings));
  settings.keyframe_interval = 2;
  settings.frames = 3;
  settings.when_behind = GRAZE_WAIT;
  graze_recorder* made = nullptr;
  expect_ok(graze_recorder_new_ring(world.scene(), &settings, &made));
  const Owned<graze_recorder> recorder(made);
  for (int frame = 0; frame < 20; ++frame) world.step(frame);
  graze_recorder_statistics written{};
  expect_ok(graze_recorder_write(recorder.get(), file.name().c_str(), &written));
  CHECK(written.frames >= 3);
  CHECK(written.frames < 20);
  graze_recording* opened = nullptr;
  expect_ok(graze_recording_open(file.name().c_str(), &opened));
  const Owned<graze_recording> recording(opened);
  CHECK(graze_recording_frame_count(opened) == written.frames);
  settings.when_behind = 5;
  expect_fails(graze_recorder_new_ring(world.scene(), &settings, &made), GRAZE_BAD_ARGUMENT, "when_behind");
}

TEST_CASE("c: a scheduler of the caller's") {
  struct Counts {
    std::atomic<int> runs{0};
    std::atomic<int> starts{0};
    std::atomic<int> releases{0};
    bool refuses = false;
    std::thread thread;
  } counts;
  graze_task_scheduler functions{};
  functions.struct_size = sizeof functions;
  functions.context = &counts;
  functions.run = [](void* context, std::uint32_t count, void (*task)(void*, std::uint32_t), void* data) {
    ++static_cast<Counts*>(context)->runs;
    for (std::uint32_t index = 0; index < count; ++index) task(data, index);
  };
  functions.start = [](void* context, void (*work)(void*), void* data) {
    auto& mine = *static_cast<Counts*>(context);
    ++mine.starts;
    if (mine.refuses) return false;
    mine.thread = std::thread(work, data);
    return true;
  };
  functions.release = [](void* context) { ++static_cast<Counts*>(context)->releases; };
  SceneSettings settings;
  settings.threads = 3;
  settings.range = 10;
  settings.detail = ContactDetail::none;
  const graze_scene_settings given = c_settings(settings);
  graze_scene* scene = nullptr;
  expect_ok(graze_scene_new(&given, &functions, &scene));
  const auto ball = c_mesh(models::sphere(24, 16));
  graze_id id{};
  for (int i = 0; i < 20; ++i) expect_ok(graze_scene_add(scene, ball.get(), nullptr, &id));
  expect_ok(graze_scene_step_async(scene, 1));
  graze_report* report = nullptr;
  expect_ok(graze_scene_wait(scene, &report));
  counts.thread.join();
  CHECK(graze_report_tag(report) == 1);
  CHECK(counts.runs > 0);
  CHECK(counts.starts == 1);
  counts.refuses = true;
  expect_fails(graze_scene_step_async(scene, 2), GRAZE_FAILED, "scheduler");
  graze_report_release(report);
  graze_scene_release(scene);
  CHECK(counts.releases == 1);
  graze_scene_settings bad = given;
  bad.contact_distance = -1;
  expect_fails(graze_scene_new(&bad, &functions, &scene), GRAZE_REFUSED, "contact_distance");
  CHECK(counts.releases == 1);  // a scene that was not made has taken nothing
  functions.run = nullptr;
  expect_fails(graze_scene_new(&given, &functions, &scene), GRAZE_BAD_ARGUMENT, "run");
}

}  // namespace graze::tests
