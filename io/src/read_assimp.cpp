#include "read_assimp.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <exception>
#include <memory>
#include <span>

#include "assimp_scene.hpp"
#include "file_bytes.hpp"
#include "gltf_source.hpp"

namespace graze::io {
namespace {

/// Serves one file from memory and every other from the disk.
class PreparedFile : public Assimp::DefaultIOSystem {
 public:
  PreparedFile(std::string path, const std::string& bytes) : path_(std::move(path)), bytes_(bytes) {}

  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (path_ != file) return DefaultIOSystem::Open(file, mode);
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }

 private:
  std::string path_;
  const std::string& bytes_;
};

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

/// assimp leaves faces out that name no vertex.
void require_all_faces(const std::filesystem::path& path, const aiScene& scene, const GltfSource& source) {
  for (const aiMesh* mesh : std::span(scene.mMeshes, scene.mNumMeshes)) {
    const auto primitive = source.primitives.find(mesh->mName.C_Str());
    if (primitive != source.primitives.end() && primitive->second.face_count != mesh->mNumFaces)
      fail(path, joined(primitive->second.place, ": only ", mesh->mNumFaces, " of its ",
                        primitive->second.face_count, " faces name vertices that exist; export it again"));
  }
}

}  // namespace

RiggedFile read_assimp(const std::filesystem::path& path) {
  require_file(path);
  const std::string extension = lower_extension(path);
  if (extension == ".raw")
    fail(path, "RAW is not read, since assimp makes nodes of it that do not exist; save the mesh as PLY");
  std::optional<GltfSource> gltf;
  if (extension == ".gltf" || extension == ".glb") gltf = prepare_gltf(path);
  Assimp::Importer importer;
  if (gltf) importer.SetIOHandler(std::make_unique<PreparedFile>(path.string(), gltf->bytes).release());
  const aiScene& scene = load(path, importer);
  if (!gltf) return convert_scene(path, scene, {});
  require_all_faces(path, scene, *gltf);
  RiggedFile result = convert_scene(path, scene, gltf->steps);
  result.file.warnings.insert(result.file.warnings.begin(), gltf->warnings.begin(), gltf->warnings.end());
  return result;
}

}  // namespace graze::io
