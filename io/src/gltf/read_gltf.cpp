#include "gltf/read_gltf.hpp"

#include <algorithm>
#include <map>

#include "assimp/read_assimp.hpp"
#include "gltf/gltf_accessor.hpp"
#include "gltf/gltf_clips.hpp"
#include "gltf/gltf_json.hpp"
#include "gltf/gltf_mesh.hpp"
#include "gltf/gltf_nodes.hpp"
#include "mesh/axes.hpp"
#include "mesh/unfolding.hpp"
#include "text/file_bytes.hpp"
#include "text/text_lines.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

class GltfReader {
 public:
  explicit GltfReader(GltfDocument& document) : document_(document), nodes_(read_gltf_nodes(document)) {}

  RiggedFile read() {
    result_.file.warnings = nodes_.warnings;
    result_.frame = {1.0, "y", z_up_from(UpAxis::y)};
    result_.rig.nodes = nodes_.nodes;
    result_.rig.clips = read_gltf_clips(document_, nodes_);
    for (std::uint32_t node = 0; node < nodes_.scene_count; ++node) add_node(node);
    NodePlaces places(result_.rig, nullptr, 0);
    for (std::size_t i = 0; i < result_.rig.bodies.size(); ++i) {
      const Body& body = result_.rig.bodies[i];
      RawSurface& surface = result_.file.objects[i].surface;
      pose(places, body, surface.positions);
      turn_faces(surface, mirrored_vertices(places, body));
    }
    if (small_faces_ > 0)
      result_.file.warnings.push_back(
          joined(document_.path().string(), ": ", small_faces_,
                 " points, lines or faces with fewer than 3 corners were left out"));
    return std::move(result_);
  }

 private:
  void add_node(std::uint32_t node) {
    const std::uint64_t number = nodes_.sources[node];
    const json& source = document_.list("nodes")[number];
    const json& mesh_number = member(source, "mesh");
    if (mesh_number.is_null()) return;
    const std::string json_path = joined("nodes[", number, "]");
    if (!element(document_.list("meshes"), mesh_number).is_object())
      document_.fail_at(json_path, "its mesh does not exist; export the file again");
    const GltfMesh& mesh = mesh_of(mesh_number, member(source, "skin"));
    small_faces_ += mesh.small_faces;
    if (mesh.faces.corner_counts.empty()) return;
    const std::string name = name_of(source, number, mesh_number);
    const json& instancing = member(member(source, "extensions"), "EXT_mesh_gpu_instancing");
    if (instancing.is_null() || !mesh.body.bones.empty()) {
      if (!instancing.is_null())
        result_.file.warnings.push_back(
            joined(document_.path().string(), ": ", json_path,
                   ": it has a skin, whose joints place it, so its instances were left out"));
      add_object(mesh, node, node, name, member(source, "weights"), json_path);
      return;
    }
    for (const RigNode& instance : read_instances(member(instancing, "attributes"), node, json_path)) {
      const auto instance_node = static_cast<std::uint32_t>(result_.rig.nodes.size());
      result_.rig.nodes.push_back(instance);
      add_object(mesh, instance_node, node, name, member(source, "weights"), json_path);
    }
  }

  /// Each mesh is read once for each skin that it is used with.
  const GltfMesh& mesh_of(const json& number, const json& skin) {
    const auto [known, is_new] = meshes_.try_emplace({number.get<std::uint64_t>(), skin.dump()});
    if (!is_new) return known->second;
    const std::vector<Bone>* joints =
        skin.is_null() ? nullptr : &joints_of(skin, joined("meshes[", number.get<std::uint64_t>(), "]"));
    known->second = read_gltf_mesh(document_, number, joints);
    const GltfMesh& mesh = known->second;
    result_.file.warnings.insert(result_.file.warnings.end(), mesh.warnings.begin(), mesh.warnings.end());
    return mesh;
  }

  /// Each skin is read once, however many meshes it holds.
  const std::vector<Bone>& joints_of(const json& skin, const std::string& user) {
    const auto [known, is_new] = skins_.try_emplace(skin.dump());
    if (!is_new) return known->second;
    known->second = read_gltf_skin(document_, skin, user);
    for (Bone& bone : known->second) bone.node = nodes_.number_of[bone.node];
    return known->second;
  }

  [[nodiscard]] std::string name_of(const json& node, std::uint64_t number, const json& mesh_number) const {
    std::string name = text_of(member(node, "name"));
    if (name.empty()) name = text_of(member(element(document_.list("meshes"), mesh_number), "name"));
    return name.empty() ? joined("node ", number) : shortened(std::move(name), longest_name);
  }

  /// A node's own morph weights win over its mesh's. An instance has those of the node that it hangs below.
  void add_object(const GltfMesh& mesh, std::uint32_t node, std::uint32_t morph_node, const std::string& name,
                  const json& weights, const std::string& json_path) {
    document_.count_kept(3 * mesh.body.vertices.size() * (2 + mesh.body.targets.size()) +
                             mesh.faces.corners.size() + numbers_of_object,
                         json_path);
    Body body = mesh.body;
    body.node = node;
    body.morph_node = morph_node;
    for (std::size_t i = 0; weights.is_array() && i < std::min(weights.size(), body.targets.size()); ++i)
      if (weights[i].is_number()) body.targets[i].rest_weight = weights[i].get<double>();
    result_.rig.bodies.push_back(std::move(body));
    result_.file.objects.push_back({name, mesh.faces});
  }

  /// The places of EXT_mesh_gpu_instancing, each below the node.
  std::vector<RigNode> read_instances(const json& attributes, std::uint32_t node,
                                      const std::string& json_path) {
    const auto read = [&](const char* key, const char* type) {
      const json& number = member(attributes, key);
      if (number.is_null()) return GltfNumbers{};
      return read_accessor(document_, number, type, joined(json_path, ".EXT_mesh_gpu_instancing.", key));
    };
    const GltfNumbers translations = read("TRANSLATION", "VEC3");
    const GltfNumbers rotations = read("ROTATION", "VEC4");
    const GltfNumbers scales = read("SCALE", "VEC3");
    const std::size_t count = std::max({translations.count(), rotations.count(), scales.count()});
    for (const GltfNumbers* numbers : {&translations, &rotations, &scales})
      if (numbers->count() != 0 && numbers->count() != count)
        document_.fail_at(json_path, "its instances have lists of different lengths; export the file again");
    std::vector<RigNode> instances;
    for (std::size_t i = 0; i < count; ++i) {
      Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
      if (rotations.count() > 0)
        rotation = Eigen::Quaterniond(Eigen::Vector4d(rotations.values.data() + 4 * i));
      instances.push_back(
          make_gltf_node(node, translations.count() > 0 ? translations.vector(i) : Eigen::Vector3d::Zero(),
                         rotation, scales.count() > 0 ? scales.vector(i) : Eigen::Vector3d::Ones()));
    }
    return instances;
  }

  GltfDocument& document_;
  GltfNodes nodes_;
  std::map<std::pair<std::uint64_t, std::string>, GltfMesh> meshes_;
  std::map<std::string, std::vector<Bone>> skins_;
  std::size_t small_faces_ = 0;
  RiggedFile result_;
};

}  // namespace

RiggedFile read_gltf(const std::filesystem::path& path, const ReadOptions& options) {
  GltfDocument document(path, options.outside_files);
  if (document.is_version_1()) return read_assimp(path, options);
  return GltfReader(document).read();
}

}  // namespace graze::io
