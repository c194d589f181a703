#include "read_assimp.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <exception>
#include <memory>
#include <span>

#include "assimp_body.hpp"
#include "assimp_clips.hpp"
#include "assimp_nodes.hpp"
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

std::string object_name(const aiScene& scene, const aiNode& node) {
  std::string name = node.mName.C_Str();
  // Names such as "<STL_ROOT>" are assimp's own.
  if (!name.empty() && name.front() != '<') return name;
  return scene.mMeshes[node.mMeshes[0]]->mName.C_Str();
}

RiggedFile convert(const std::filesystem::path& path, const aiScene& scene, const SteppedTracks& steps) {
  const std::string extension = lower_extension(path);
  const bool use_rest_weights = extension == ".gltf" || extension == ".glb" || extension == ".dae";
  NodeTable nodes(scene);
  RiggedFile result;
  result.rig.clips = read_clips(scene, nodes, steps);
  std::size_t small_faces = 0;
  for (std::uint32_t node = 0; node < nodes.sources.size(); ++node) {
    if (nodes.sources[node]->mNumMeshes == 0) continue;
    NodeObject object = read_node_object(path, scene, nodes, node, use_rest_weights);
    small_faces += object.small_faces;
    for (const auto& bone : object.missing_bones)
      result.file.warnings.push_back(
          joined(path.string(), ": bone '", bone, "' has no node; its weights were left out"));
    if (object.faces.corner_counts.empty()) continue;
    result.file.objects.push_back({object_name(scene, *nodes.sources[node]), std::move(object.faces)});
    result.rig.bodies.push_back(std::move(object.body));
  }
  result.rig.nodes = std::move(nodes.nodes);
  for (std::size_t i = 0; i < result.rig.bodies.size(); ++i) {
    RawSurface& surface = result.file.objects[i].surface;
    pose(result.rig, result.rig.bodies[i], nullptr, 0, surface.positions);
    if (is_mirrored(result.rig, result.rig.bodies[i])) turn_faces(surface);
  }
  if (small_faces > 0)
    result.file.warnings.push_back(joined(path.string(), ": ", small_faces,
                                          " points, lines or faces with fewer than 3 corners were left out"));
  return result;
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
  if (!gltf) return convert(path, scene, {});
  require_all_faces(path, scene, *gltf);
  RiggedFile result = convert(path, scene, gltf->steps);
  result.file.warnings.insert(result.file.warnings.begin(), gltf->warnings.begin(), gltf->warnings.end());
  return result;
}

}  // namespace graze::io
