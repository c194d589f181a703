// Recordings of scenes with swept objects answer again what met on the way.

#include <algorithm>
#include <filesystem>
#include <graze/graze.hpp>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <optional>
#include <vector>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

/// A swept needle and a swept rigid ball fly about a plate, and two plates of one mesh pass each other. The
/// needle jumps now and then, and gets other meshes. Returns the impacts of each frame.
std::vector<std::vector<Impact>> record_flight(const std::filesystem::path& file) {
  SceneSettings settings = settings_of(0.05, 0.2);
  settings.swept_gap = 0.1;
  settings.threads = 1;
  ObjectSettings swept;
  swept.swept = true;
  NeedleOverPlate stage(settings, {}, swept);
  Positions two = moved(plate_mesh()->rest(), {0, 0, 20});
  for (std::size_t i = 0; i < 4; ++i) two.emplace_back(0.5 * two[i] + Eigen::Vector3d(0.1, 0.05, 11));
  ObjectSettings settings_of_two = swept;
  settings_of_two.self = true;
  const auto both =
      stage.scene.add(std::make_shared<const Mesh>(Mesh::from_quads(
                          two, std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}, {4, 5, 6, 7}})),
                      settings_of_two);
  ObjectSettings settings_of_ball = swept;
  settings_of_ball.motion = Motion::rigid;
  const auto ball = stage.scene.add(mesh_of(models::sphere(8, 6)), settings_of_ball);
  Recorder recorder(stage.scene, file, {.keyframe_interval = 8, .waiting_frames = 1000});
  oracle::Random random(7);
  std::vector<std::vector<Impact>> impacts;
  for (int frame = 0; frame < 40; ++frame) {
    if (frame % 9 == 4) {
      // The same triangle, whose vertices have other numbers.
      const Positions now = lifted(*needle_mesh(), 0);
      const std::vector<std::array<std::uint32_t, 3>> corners = {{2, 0, 1}};
      stage.scene.replace_mesh(stage.needle, std::make_shared<const Mesh>(Mesh::from_triangles(now, corners)),
                               std::vector<std::uint32_t>{0, 1, 2});
    }
    const Positions to = moved(needle_mesh()->rest(), random.vector(-1, 1));
    if (frame % 5 == 3)
      stage.scene.set_positions(stage.needle, to, teleport);
    else
      stage.scene.set_positions(stage.needle, to);
    for (std::size_t i = 4; i < 8; ++i) two[i].z() += frame % 2 == 0 ? -2 : 2;
    stage.scene.set_positions(both, two);
    stage.scene.set_pose(ball, Eigen::Isometry3d(Eigen::Translation3d(random.vector(-3, 3))));
    const ReportHandle report = stage.scene.step();
    impacts.emplace_back(report->impacts().begin(), report->impacts().end());
  }
  recorder.close();
  CHECK(recorder.statistics().dropped == 0);
  return impacts;
}

/// Swept balls fly through a plate. Now and then their poses are refused, also the first one of a ball, and
/// after a good one in the same step. Returns the impacts of each frame.
std::vector<std::vector<Impact>> record_refused_poses(const std::filesystem::path& file,
                                                      std::size_t frames_before) {
  SceneSettings settings = settings_of(0.05, 0.2);
  settings.threads = 1;
  Scene scene(settings);
  scene.add(plate_mesh());
  const auto mesh = mesh_of(models::sphere(8, 6));
  std::vector<ObjectId> balls;
  for (int ball = 0; ball < 3; ++ball)
    balls.push_back(scene.add(mesh, {.motion = Motion::rigid, .swept = true}));
  oracle::Random random(11);
  std::vector<std::vector<Impact>> impacts;
  std::optional<Recorder> recorder;
  for (std::size_t frame = 0; frame < 40 + frames_before; ++frame) {
    if (frame == frames_before)
      recorder.emplace(scene, file, RecorderSettings{.keyframe_interval = 8, .waiting_frames = 1000});
    if (frame == frames_before + 20)
      balls.push_back(scene.add(mesh, {.motion = Motion::rigid, .swept = true}));
    for (std::size_t ball = 0; ball < balls.size(); ++ball) {
      Eigen::Isometry3d pose(Eigen::Translation3d(random.vector(-2, 2)));
      const bool is_refused = ball == 3 ? frame < frames_before + 22 : random.chance(0.4);
      if (!is_refused || random.chance(0.3)) scene.set_pose(balls[ball], pose);
      pose.linear() *= 2;
      if (is_refused) scene.set_pose(balls[ball], pose);
    }
    const ReportHandle report = scene.step();
    if (recorder) impacts.emplace_back(report->impacts().begin(), report->impacts().end());
  }
  recorder->close();
  CHECK(recorder->statistics().dropped == 0);
  return impacts;
}

/// Replays from a frame on. No row may differ. Returns the impacts of each frame.
std::vector<std::vector<Impact>> replayed_impacts(const std::filesystem::path& file,
                                                  const ReplaySettings& settings) {
  const Recording recording(file);
  Replay replay(recording, settings);
  std::vector<std::vector<Impact>> impacts;
  while (replay.step()) {
    INFO("frame " << replay.frame_index());
    CHECK_FALSE(replay.difference().has_value());
    const auto now = replay.report()->impacts();
    impacts.emplace_back(now.begin(), now.end());
  }
  return impacts;
}

}  // namespace

TEST_CASE("recording: impacts of teleports, replaced meshes and one surface with itself are answered again") {
  const TemporaryFolder folder;
  const auto impacts = record_flight(folder / "run.graze");
  std::size_t with_impacts = 0;
  for (const auto& now : impacts) with_impacts += now.empty() ? 0U : 1U;
  CHECK(with_impacts > impacts.size() / 2);
  for (const unsigned threads : {1U, 3U})
    CHECK(replayed_impacts(folder / "run.graze", {.threads = threads}) == impacts);
  // From the middle, and of a part: the first step knows no way, and all others are answered alike.
  const auto later = replayed_impacts(folder / "run.graze", {.first_frame = 13});
  REQUIRE(later.size() == impacts.size() - 13);
  CHECK(std::equal(later.begin() + 1, later.end(), impacts.begin() + 14));
  cut_recording(Recording(folder / "run.graze"), {.first_frame = 10, .last_frame = 30},
                folder / "part.graze");
  const auto part = replayed_impacts(folder / "part.graze", {});
  REQUIRE(part.size() == 21);
  CHECK(std::equal(part.begin() + 1, part.end(), impacts.begin() + 11));
}

TEST_CASE("recording: balls whose poses were refused are swept from where they stood, wherever it begins") {
  for (const std::size_t frames_before : {0U, 9U, 10U, 11U}) {
    const TemporaryFolder folder;
    const auto impacts = record_refused_poses(folder / "run.graze", frames_before);
    const Recording recording(folder / "run.graze");
    for (std::size_t first = 0; first + 1 < impacts.size(); ++first) {
      INFO("recorded after " << frames_before << " frames, begun at " << first);
      cut_recording(recording, {.first_frame = first}, folder / "part.graze");
      for (const auto& replayed : {replayed_impacts(folder / "run.graze", {.first_frame = first}),
                                   replayed_impacts(folder / "part.graze", {})}) {
        REQUIRE(replayed.size() == impacts.size() - first);
        CHECK(std::equal(replayed.begin() + 1, replayed.end(),
                         impacts.begin() + static_cast<std::ptrdiff_t>(first) + 1));
      }
    }
  }
}

}  // namespace graze::tests
