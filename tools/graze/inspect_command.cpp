#include "inspect_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <graze/io/player.hpp>
#include <graze/io/printable.hpp>
#include <graze/io/scene_file.hpp>
#include <memory>
#include <string>
#include <vector>

#include "mesh_summary.hpp"
#include "output/terminal.hpp"
#include "output/text.hpp"

namespace graze::tools {
namespace {

/// A line about the axes and the unit that the file states. A mesh file is never converted. A scene file may
/// ask for it.
std::string frame_line(const io::FileFrame& frame) {
  std::string said = frame.up ? *frame.up + " up" : "";
  if (frame.metres_per_unit)
    said += format("%s%.6g m a unit", said.empty() ? "" : ", ", *frame.metres_per_unit);
  return (said.empty() ? "axes and unit not said" : "the file says " + said) +
         "; coordinates as they stand in it";
}

void inspect_scene(const std::filesystem::path& path, bool outside_files) {
  io::SceneDescription scene = io::read_scene_file(path);
  if (outside_files) scene.outside_files = true;
  const io::Player player(scene);
  say("%s: %s\n", path.string().c_str(), counted(player.objects().size(), "object").c_str());
  for (const std::string& warning : player.warnings()) say("  note       %s\n", warning.c_str());
  for (std::size_t i = 0; i < player.objects().size(); ++i) {
    const io::SceneObject& object = player.objects()[i];
    say("  object %zu \"%s\"\n", i, io::printable(object.name).c_str());
    std::vector<Eigen::Vector3d> positions;
    player.read_positions(i, positions);
    say("    stands     %s\n", bounds_text(positions).c_str());
    say("%s", summarise_mesh(*object.mesh, "    ").c_str());
  }
}

void inspect_mesh(const std::filesystem::path& path, bool outside_files) {
  const io::MeshFile file = io::MeshFile::read(path, {.outside_files = outside_files});
  say("%s: %s\n", path.string().c_str(), counted(file.objects().size(), "object").c_str());
  for (const std::string& warning : file.warnings()) say("  note       %s\n", warning.c_str());
  say("  frame      %s\n", frame_line(file.frame()).c_str());
  for (std::size_t i = 0; i < file.animations().size(); ++i)
    say("  animation  %zu \"%s\", %.3g s\n", i, io::printable(file.animations()[i]).c_str(),
        file.animation_seconds(i));
  for (std::size_t i = 0; i < file.objects().size(); ++i) {
    const io::LoadedObject& object = file.objects()[i];
    say("  object %zu \"%s\"%s\n", i, io::printable(object.name).c_str(),
        object.animated ? ", animated" : "");
    say("%s", summarise_mesh(*object.mesh, "    ").c_str());
  }
}

void inspect(const std::filesystem::path& path, bool outside_files) {
  if (path.extension() == ".json")
    inspect_scene(path, outside_files);
  else
    inspect_mesh(path, outside_files);
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("inspect",
                                         "Says what mesh or scene files hold: axes and unit, objects, "
                                         "animations, counts, what is odd, regions, bytes.");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("files", *files, "Mesh files, in any format that graze reads, or scene files (.json)")
      ->required();
  const auto outside_files = std::make_shared<bool>(false);
  command->add_flag("--outside-files", *outside_files,
                    "Let mesh files name files outside their own folders, such as buffers of glTF");
  command->callback([files, outside_files] {
    for (const std::string& file : *files) inspect(file, *outside_files);
  });
}

}  // namespace graze::tools
