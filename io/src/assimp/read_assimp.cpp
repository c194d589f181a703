#include "assimp/read_assimp.hpp"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "assimp/assimp_files.hpp"
#include "assimp/assimp_frame.hpp"
#include "assimp/assimp_scene.hpp"
#include "assimp/threemf_frame.hpp"
#include "mesh/known_formats.hpp"
#include "text/file_bytes.hpp"
#include "text/opened_files.hpp"

namespace graze::io {
namespace {

/// Null where assimp refuses the file, for the reason that becomes `problem`.
const aiScene* load(const std::filesystem::path& path, Assimp::Importer& importer, std::string& problem) {
  // Otherwise a skeleton without a mesh becomes a mesh.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  try {
    const aiScene* scene = importer.ReadFile(path.string(), 0);
    problem = importer.GetErrorString();
    return scene;
  } catch (const std::exception& error) {
    problem = error.what();
  }
  return nullptr;
}

/// What opens the files of an importer, which owns it.
AssimpFiles& open_files_with(Assimp::Importer& importer, const std::filesystem::path& path,
                             const ReadOptions& options) {
  auto files = std::make_unique<AssimpFiles>(path, options);
  importer.SetIOHandler(files.get());
  return *files.release();
}

std::string refusal_text(const std::string& file) {
  return joined("'", file, "' is outside the folder of this file, and was not read; ", outside_remedy);
}

[[noreturn]] void refuse(const std::filesystem::path& path, const Assimp::Importer& importer,
                         const std::string& problem) {
  const std::string extension = lower_extension(path);
  if (extension.empty())
    fail(path,
         "its name has no ending that says its format; call it .obj, .ply, .stl or .glb, whichever it is");
  if (!importer.IsExtensionSupported(extension))
    fail(path, joined("'", extension, "' is no format that is read; save the mesh as OBJ, PLY, STL or glTF"));
  fail(path, joined("it cannot be read (", problem, "); check that it is whole"));
}

bool is_collada(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".dae" || extension == ".zae";
}

/// COLLADA's ids are unique, so assimp names nodes by them. The names are what the file calls its nodes.
void use_collada_names(const std::filesystem::path& path, const ReadOptions& options, const aiScene& scene,
                       RiggedFile& file) {
  Assimp::Importer importer;
  open_files_with(importer, path, options);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_USE_COLLADA_NAMES, true);
  std::string problem;
  const aiScene* named = load(path, importer, problem);
  if (named == nullptr) return;
  const std::vector<std::string> names = object_names(*named);
  if (names.size() == object_names(scene).size() && names.size() == file.file.objects.size())
    for (std::size_t i = 0; i < names.size(); ++i) file.file.objects[i].name = names[i];
}

}  // namespace

RiggedFile read_assimp(const std::filesystem::path& path, const ReadOptions& options) {
  require_file(path);
  const std::string extension = lower_extension(path);
  if (extension == ".raw")
    fail(path, "RAW is not read, since assimp makes nodes of it that do not exist; save the mesh as PLY");
  if (const auto format = name_of_unread_format(extension))
    fail(path, joined("'", extension, "' is ", *format,
                      ", a format that is not read; save the mesh as OBJ, PLY, STL or glTF"));
  Assimp::Importer importer;
  const AssimpFiles& files = open_files_with(importer, path, options);
  std::string problem;
  if (load(path, importer, problem) == nullptr) {
    if (!files.refused().empty()) fail(path, refusal_text(*files.refused().begin()));
    refuse(path, importer, problem);
  }
  const std::unique_ptr<aiScene> scene(importer.GetOrphanedScene());
  FileFrame frame;
  if (is_collada(path)) frame = undo_collada_frame(*scene);
  undo_turn_to_y_up(*scene, extension);
  if (extension == ".fbx") frame = read_fbx_frame(*scene);
  if (extension == ".3mf") frame = read_threemf_frame(path);
  RiggedFile file = convert_scene(path, *scene);
  file.frame = std::move(frame);
  for (const std::string& refused : files.refused())
    file.file.warnings.push_back(joined(path.string(), ": ", refusal_text(refused)));
  if (is_collada(path)) use_collada_names(path, options, *scene, file);
  return file;
}

}  // namespace graze::io
