#include "assimp/assimp_scene.hpp"

#include <algorithm>
#include <set>
#include <span>

#include "assimp/assimp_body.hpp"
#include "assimp/assimp_clips.hpp"
#include "assimp/assimp_nodes.hpp"
#include "mesh/unfolding.hpp"
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

/// About how many numbers a mesh becomes.
std::uint64_t numbers_of(const aiMesh& mesh) {
  return std::uint64_t{mesh.mNumVertices} * 3 * (2 + mesh.mNumAnimMeshes) + std::uint64_t{mesh.mNumFaces} * 3;
}

std::uint64_t numbers_of(const aiScene& scene, const aiNode& node) {
  std::uint64_t numbers = numbers_of_object;
  for (const unsigned mesh : std::span(node.mMeshes, node.mNumMeshes))
    if (mesh < scene.mNumMeshes) numbers += numbers_of(*scene.mMeshes[mesh]);
  return numbers;
}

/// Of all meshes, each once.
std::uint64_t numbers_of(const aiScene& scene) {
  std::uint64_t numbers = 0;
  for (unsigned mesh = 0; mesh < scene.mNumMeshes; ++mesh) numbers += numbers_of(*scene.mMeshes[mesh]);
  return numbers;
}

}  // namespace

RiggedFile convert_scene(const std::filesystem::path& path, const aiScene& scene) {
  const std::string extension = lower_extension(path);
  const bool use_rest_weights = extension == ".dae" || extension == ".zae";
  NodeTable nodes(scene);
  RiggedFile result;
  result.rig.clips = read_clips(scene, nodes);
  std::size_t small_faces = 0;
  std::set<std::string> missing_bones;
  const std::uint64_t most = most_unfolded(numbers_of(scene));
  std::uint64_t kept = 0;
  for (std::uint32_t node = 0; node < nodes.sources.size(); ++node) {
    if (nodes.sources[node]->mNumMeshes == 0) continue;
    const std::uint64_t numbers = numbers_of(scene, *nodes.sources[node]);
    if (numbers > most - std::min(most, kept))
      fail(path, joined("node '", nodes.sources[node]->mName.C_Str(), "': the file unfolds to more than ",
                        most, " numbers here; split it"));
    kept += numbers;
    NodeObject object = read_node_object(path, scene, nodes, node, use_rest_weights);
    small_faces += object.small_faces;
    for (const auto& bone : object.missing_bones)
      if (missing_bones.insert(bone).second)
        result.file.warnings.push_back(
            joined(path.string(), ": bone '", bone, "' has no node; its weights were left out"));
    if (object.faces.corner_counts.empty()) continue;
    result.file.objects.push_back({object_name(scene, *nodes.sources[node]), std::move(object.faces)});
    result.rig.bodies.push_back(std::move(object.body));
  }
  result.rig.nodes = std::move(nodes.nodes);
  NodePlaces places(result.rig, nullptr, 0);
  for (std::size_t i = 0; i < result.rig.bodies.size(); ++i) {
    RawSurface& surface = result.file.objects[i].surface;
    pose(places, result.rig.bodies[i], surface.positions);
    turn_faces(surface, mirrored_vertices(places, result.rig.bodies[i]));
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
