#include "read_assimp.hpp"

#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <exception>

#include "assimp_scene.hpp"
#include "file_bytes.hpp"

namespace graze::io {
namespace {

const aiScene& load(const std::filesystem::path& path, Assimp::Importer& importer) {
  // Otherwise a skeleton without a mesh becomes a mesh.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
  const aiScene* scene = nullptr;
  std::string problem;
  try {
    scene = importer.ReadFile(path.string(), 0);
    problem = importer.GetErrorString();
  } catch (const std::exception& error) {
    problem = error.what();
  }
  if (scene == nullptr)
    fail(path,
         joined("it cannot be read (", problem, "); check that it is whole and in a format that is known"));
  return *scene;
}

}  // namespace

RiggedFile read_assimp(const std::filesystem::path& path) {
  require_file(path);
  const std::string extension = lower_extension(path);
  if (extension == ".raw")
    fail(path, "RAW is not read, since assimp makes nodes of it that do not exist; save the mesh as PLY");
  Assimp::Importer importer;
  return convert_scene(path, load(path, importer));
}

}  // namespace graze::io
