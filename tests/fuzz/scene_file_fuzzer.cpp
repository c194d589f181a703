// The input is a scene file. What is read is sane, and is loaded and stepped with the meshes and motions that
// stand beside it. A path of the file is taken for the name of one of those.

#include <cmath>
#include <graze/error.hpp>
#include <graze/io/player.hpp>
#include <graze/io/scene_file.hpp>
#include <set>

#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/files/scene_files.hpp"
#include "input_folder.hpp"

namespace graze::fuzz {
namespace {

void check(const io::SceneDescription& scene) {
  expect(!scene.objects.empty(), "a scene without an object");
  expect(scene.settings.contact_distance >= 0 && scene.settings.range >= 0, "a negative threshold");
  expect(scene.frames.value_or(1) >= 1 && scene.frames_per_second > 0, "no frames");
  std::set<std::string> names;
  for (const io::ObjectDescription& object : scene.objects) {
    expect(object.settings.name.empty() || names.insert(object.settings.name).second, "a name stands twice");
    expect(object.settings.margin >= 0 && object.settings.kind <= 255 &&
               (object.transform.stretch.array() != 0).any(),
           "a value out of range");
    expect(object.poses.empty() || object.settings.motion == Motion::rigid, "poses of what is not rigid");
    for (std::size_t i = 1; i < object.poses.size(); ++i)
      expect(object.poses[i - 1].frame < object.poses[i].frame, "poses out of order");
  }
}

/// Nothing but the supplied files is opened.
void move_into_folder(io::SceneDescription& scene) {
  for (io::ObjectDescription& object : scene.objects) {
    object.mesh = input_folder() / object.mesh.filename().string();
    if (!object.positions.empty()) object.positions = input_folder() / object.positions.filename().string();
  }
}

void play(const io::SceneDescription& scene) {
  io::Player player(scene);
  expect(player.frame_count() >= 1, "a player without a frame");
  std::vector<Eigen::Vector3d> positions;
  for (const std::uint32_t frame : {0U, 1U, 2U, player.frame_count() - 1, ~0U}) {
    player.advance(frame);
    const ReportHandle report = player.scene().step();
    for (const PairReport& pair : report->pairs())
      expect(pair.distance.lower <= pair.distance.upper, "bounds the wrong way round");
    for (std::size_t object = 0; object < player.objects().size(); ++object) {
      player.read_positions(object, positions);
      expect(positions.size() == player.objects()[object].mesh->vertex_count(), "not one position a vertex");
    }
  }
}

void run(std::span<const std::uint8_t> bytes) {
  static const bool files_are_there = (write_scene_files(input_folder()), true);
  expect(files_are_there, "");
  constexpr std::size_t most_objects = 6;
  const auto path = write_input("scene.json", bytes);
  io::SceneDescription scene;
  if (!accepts([&] { scene = io::read_scene_file(path); })) return;
  check(scene);
  if (scene.objects.size() > most_objects) return;
  move_into_folder(scene);
  scene.settings.threads = 1;
  accepts([&] { play(scene); });
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run({data, size});
  return 0;
}
