#include "assimp/assimp_scene.hpp"

#include <algorithm>
#include <span>

#include "assimp/assimp_body.hpp"
#include "assimp/assimp_clips.hpp"
#include "assimp/assimp_nodes.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

/// Names such as "<3DSRoot>", "$ColladaAutoName$_0" and "3DSMesh_0" are assimp's own.
bool is_made_by_assimp(const std::string& name) {
  return name.empty() || name.front() == '<' || name.front() == '$' || name.starts_with("3DSMesh_");
}

std::string object_name(const aiScene& scene, const aiNode& node) {
  std::string name = node.mName.C_Str();
  if (!is_made_by_assimp(name)) return name;
  name = scene.mMeshes[node.mMeshes[0]]->mName.C_Str();
  return is_made_by_assimp(name) ? std::string() : name;
}

bool has_faces(const aiScene& scene, const aiNode& node) {
  return std::ranges::any_of(std::span(node.mMeshes, node.mNumMeshes), [&](unsigned number) {
    if (number >= scene.mNumMeshes) return false;
    const aiMesh& mesh = *scene.mMeshes[number];
    return std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                       [](const aiFace& face) { return face.mNumIndices >= 3; });
  });
}

}  // namespace

RiggedFile convert_scene(const std::filesystem::path& path, const aiScene& scene) {
  const std::string extension = lower_extension(path);
  const bool use_rest_weights = extension == ".dae" || extension == ".zae";
  NodeTable nodes(scene);
  RiggedFile result;
  result.rig.clips = read_clips(scene, nodes);
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
    turn_faces(surface, mirrored_vertices(result.rig, result.rig.bodies[i]));
  }
  if (small_faces > 0)
    result.file.warnings.push_back(joined(path.string(), ": ", small_faces,
                                          " points, lines or faces with fewer than 3 corners were left out"));
  return result;
}

std::vector<std::string> object_names(const aiScene& scene) {
  std::vector<std::string> names;
  for (const aiNode* node : NodeTable(scene).sources)
    if (has_faces(scene, *node)) names.push_back(object_name(scene, *node));
  return names;
}

}  // namespace graze::io
