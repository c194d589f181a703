#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "models/models.hpp"
#include "motions.hpp"
#include "scene_text.hpp"
#include "writers.hpp"

namespace {

namespace models = graze::models;
using Eigen::Vector3d;
using std::filesystem::path;

using Motion = Vector3d (*)(const Vector3d&, int);

models::MeshData at_frame(const models::MeshData& rest, Motion motion, int frame) {
  models::MeshData moved = rest;
  for (Vector3d& point : moved.positions) point = motion(point, frame);
  return moved;
}

std::string numbered(const std::string& stem, int number) {
  const std::string digits = std::to_string(number);
  return stem + std::string(4 - digits.size(), '0') + digits + ".ply";
}

/// The paper's five models, a floor, and the frames of the two that deform.
void write_scene(const path& folder, const path& character) {
  std::filesystem::create_directories(folder);
  const models::MeshData torus = models::torus(models::Faces::quads);
  const models::MeshData tooth = models::tooth();
  graze::demo::write_obj(folder / "torus.obj", torus);
  graze::demo::write_obj(folder / "tooth.obj", tooth);
  graze::demo::write_obj(folder / "pawn.obj", models::pawn(models::Faces::quads));
  graze::demo::write_obj(folder / "cylinder.obj", models::cylinder(models::Faces::quads));
  graze::demo::write_obj(folder / "human.obj", models::human());
  graze::demo::write_obj(folder / "ground.obj", models::sheet(18, 9, 5.2, 2.6));
  std::vector<std::vector<Vector3d>> ring_frames;
  for (int frame = 0; frame < graze::demo::frame_count; ++frame) {
    ring_frames.push_back(at_frame(torus, graze::demo::ring_point, frame).positions);
    graze::demo::write_ply(folder / numbered("tooth_", frame),
                           at_frame(tooth, graze::demo::jelly_point, frame));
  }
  graze::demo::write_pc2(folder / "torus.pc2", ring_frames);
  graze::demo::write_text(folder / "scene.json", graze::demo::scene_text(character.string()));
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    if (argument_count < 2 || argument_count > 3)
      throw std::runtime_error("say where to: graze_demo_scene FOLDER [FOLDER OF ASSIMP'S MODELS]");
    const path models_folder = argument_count == 3 ? arguments[2] : GRAZE_ASSIMP_MODELS;
    const path character = models_folder / "X" / "Testwuson.X";
    if (!std::filesystem::exists(character))
      throw std::runtime_error(character.string() +
                               ": is not there; install Debian's assimp-testmodels, or name the "
                               "folder that holds them as the second argument");
    write_scene(arguments[1], character);
    std::printf("%s\n", (path(arguments[1]) / "scene.json").string().c_str());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "graze_demo_scene: %s\n", error.what());
    return 2;
  }
}
