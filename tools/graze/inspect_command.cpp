#include "inspect_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <memory>
#include <string>
#include <vector>

#include "mesh_summary.hpp"

namespace graze::tools {
namespace {

void inspect(const std::filesystem::path& path) {
  const io::MeshFile file = io::MeshFile::read(path);
  std::printf("%s: %zu %s\n", path.string().c_str(), file.objects().size(),
              file.objects().size() == 1 ? "object" : "objects");
  for (const std::string& warning : file.warnings()) std::printf("  note       %s\n", warning.c_str());
  for (std::size_t i = 0; i < file.animations().size(); ++i)
    std::printf("  animation  %zu \"%s\", %.3g s\n", i, file.animations()[i].c_str(),
                file.animation_seconds(i));
  for (std::size_t i = 0; i < file.objects().size(); ++i) {
    const io::LoadedObject& object = file.objects()[i];
    std::printf("  object %zu \"%s\"%s\n", i, object.name.c_str(), object.animated ? ", animated" : "");
    std::fputs(summarise_mesh(*object.mesh, "    ").c_str(), stdout);
  }
}

}  // namespace

void add_inspect_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "inspect",
      "Says what mesh files hold: objects, animations, counts, what is odd, the regions of each, and bytes.");
  const auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("files", *files, "Mesh files, in any format that graze reads")->required();
  command->callback([files] {
    for (const std::string& file : *files) inspect(file);
  });
}

}  // namespace graze::tools
