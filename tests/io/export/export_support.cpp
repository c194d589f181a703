#include "io/export/export_support.hpp"

#include <Eigen/Geometry>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <limits>

#include "io/marked_report.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

/// A sheet of 3 by 3 cells, every other one cut into two triangles, and a vertex that no face uses.
Mesh mixed_sheet() {
  std::vector<Vector3d> rest;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) rest.emplace_back(0.3 * x, 0.3 * y, 0.01 * ((x * 7 + y * 3) % 5));
  rest.push_back(Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> counts;
  for (std::uint32_t cell = 0; cell < 9; ++cell) {
    const std::uint32_t first = cell / 3 * 4 + cell % 3;
    if (cell % 2 == 0) {
      corners.insert(corners.end(), {first, first + 1, first + 5, first + 4});
      counts.push_back(4);
      continue;
    }
    corners.insert(corners.end(), {first, first + 1, first + 5, first, first + 5, first + 4});
    counts.insert(counts.end(), {3, 3});
  }
  return Mesh::from_polygons(rest, corners, counts);
}

/// A tetrahedron that stands on its tip.
Mesh tetrahedron(double size) {
  const std::vector<Vector3d> rest{{0, 0, 0},
                                   {-size / 4, -size / 4, size},
                                   {size / 2, -size / 4, size},
                                   {-size / 4, size / 2, 1.25 * size}};
  const std::vector<std::array<std::uint32_t, 3>> faces{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
  return Mesh::from_triangles(rest, faces);
}

Eigen::Isometry3d pose_at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

}  // namespace

ExportScene::ExportScene() {
  record();
  replay();
}

void ExportScene::record() {
  Scene scene({.contact_distance = 0.05, .range = 10, .threads = 1, .region_distances = 100});
  const auto sheet = std::make_shared<const Mesh>(mixed_sheet());
  const auto spike = std::make_shared<const Mesh>(tetrahedron(0.3));
  (void)scene.add(sheet, {.name = "sheet, \"wide\"", .motion = Motion::fixed});
  const ObjectId moving = scene.add(spike, {.name = "spike\n2", .motion = Motion::rigid, .solid = true});
  const ObjectId removed = scene.add(spike, {.name = "block", .motion = Motion::rigid, .solid = true});
  Recorder recorder(scene, path("run.graze"), {.keyframe_interval = 4, .waiting_frames = 1000});
  for (std::size_t frame = 0; frame < frame_count; ++frame) {
    const double height = 0.02 * std::abs(static_cast<double>(frame) - 5.3);
    scene.set_pose(moving, pose_at(0.37, 0.41, height));
    if (frame == 0) scene.set_pose(removed, pose_at(0.71, 0.23, 0.03));
    if (frame == 8) scene.remove(removed);
    (void)scene.step();
  }
  recorder.close();
}

void ExportScene::replay() {
  const Recording recording(path("run.graze"));
  Replay replay(recording);
  while (replay.step()) {
    REQUIRE(!replay.difference());
    io::SceneSnapshot snapshot;
    snapshot.frame = replay.frame_index();
    snapshot.scene_frame = recording.frame(replay.frame_index()).frame;
    for (std::uint64_t since = 0; since <= replay.report()->frame(); ++since)
      snapshot.frames_by_since.push_back(since == 0 ? 0 : since - 1);
    for (std::size_t i = 0; i < replay.objects().size(); ++i) {
      const ReplayObject& object = replay.objects()[i];
      snapshot.objects.push_back({object.id, object.serial, object.settings.name, object.mesh, {}});
      replay.read_positions(i, snapshot.objects.back().positions);
    }
    // The block is removed in frame 8, and still named there.
    if (snapshot.frame == 8) snapshot.removed.push_back(frames_.back().objects.at(2));
    snapshot.report = replay.report();
    frames_.push_back(std::move(snapshot));
  }
  REQUIRE(frames_.size() == frame_count);
  for (const io::SceneSnapshot& snapshot : frames_) mark_report(*snapshot.report);
  REQUIRE(frames_[5].report->contacts().size() > 1);
}

}  // namespace graze::tests
