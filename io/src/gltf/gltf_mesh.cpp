#include "gltf/gltf_mesh.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "gltf/gltf_accessor.hpp"
#include "gltf/gltf_faces.hpp"
#include "gltf/gltf_json.hpp"
#include "mesh/skin.hpp"
#include "mesh/used_vertices.hpp"
#include "mesh/weld.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

/// Vertices that primitives share: those of one position accessor, with what else makes a vertex.
struct VertexSet {
  const json* attributes = nullptr;
  const json* targets = nullptr;
  std::string json_path;               ///< of the first primitive that has them
  std::uint64_t count = 0;             ///< of the accessor's elements
  std::vector<std::uint32_t> corners;  ///< of all triangles of these primitives
};

/// The triangles of a primitive: so many corners of its vertex set.
struct CornerRange {
  std::size_t set = 0;
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// What tells vertices of one position apart. Normals, colours and textures do not.
std::string key_of(const json& attributes, const json& targets) {
  std::string key;
  for (const auto& [name, accessor] : attributes.items())
    if (name == "POSITION" || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_"))
      key += name + ":" + accessor.dump() + ",";
  for (const json& target : targets) key += member(target, "POSITION").dump() + ",";
  return key;
}

class GltfMeshReader {
 public:
  GltfMeshReader(GltfDocument& document, std::uint64_t number, const std::vector<Bone>* joints)
      : document_(document),
        mesh_(document.list("meshes")[number]),
        json_path_(joined("meshes[", number, "]")),
        joints_(joints) {}

  GltfMesh read() {
    std::size_t number = 0;
    for (const json& primitive : member(mesh_, "primitives"))
      add_primitive(primitive, joined(json_path_, ".primitives[", number++, "]"));
    read_vertices();
    Body& body = result_.body;
    for (auto& target : body.targets) pad(target, body.vertices.size());
    if (!body.influences.empty()) {
      body.influences.resize(body.vertices.size());
      set_bones(body, *joints_);
    }
    set_rest_weights();
    const auto numbers = weld(body);
    for (auto& corner : result_.faces.corners) corner = numbers[corner];
    return std::move(result_);
  }

 private:
  void set_rest_weights() {
    const json& weights = member(mesh_, "weights");
    auto& targets = result_.body.targets;
    for (std::size_t i = 0; weights.is_array() && i < std::min(targets.size(), weights.size()); ++i)
      if (weights[i].is_number()) targets[i].rest_weight = weights[i].get<double>();
  }

  void add_primitive(const json& primitive, const std::string& json_path) {
    const json& attributes = member(primitive, "attributes");
    const json& position = member(attributes, "POSITION");
    if (position.is_null()) {
      result_.warnings.push_back(
          joined(document_.path().string(), ": ", json_path, ": it has no positions and was left out"));
      return;
    }
    refuse_draco(primitive, position, json_path);
    const json& targets = member(primitive, "targets");
    const auto [known, is_new] = set_by_key_.try_emplace(key_of(attributes, targets), sets_.size());
    if (is_new)
      sets_.push_back({&attributes,
                       &targets,
                       json_path,
                       element_count(document_, position, "VEC3", joined(json_path, ".attributes.POSITION")),
                       {}});
    add_faces(primitive, known->second, json_path);
  }

  /// Positions that are compressed have no bytes elsewhere, even where the extension is not required.
  void refuse_draco(const json& primitive, const json& position, const std::string& json_path) const {
    const json& draco = member(member(primitive, "extensions"), "KHR_draco_mesh_compression");
    const json& accessor = element(document_.list("accessors"), position);
    if (!draco.is_null() && member(accessor, "bufferView").is_null())
      document_.fail_at(json_path,
                        "its data is in KHR_draco_mesh_compression (Draco) only, which is not read; export "
                        "without compression");
  }

  void add_faces(const json& primitive, std::size_t set_number, const std::string& json_path) {
    VertexSet& set = sets_[set_number];
    const json& indices = member(primitive, "indices");
    std::vector<std::uint64_t> corners;
    if (indices.is_null())
      for (std::uint64_t i = 0; i < set.count; ++i) corners.push_back(i);
    else
      for (const double index :
           read_accessor(document_, indices, "SCALAR", joined(json_path, ".indices")).values)
        corners.push_back(index >= 0 && index < 4294967296.0 ? static_cast<std::uint64_t>(index) : ~0ULL);
    GltfFaces faces = make_gltf_faces(document_.whole_number(primitive, "mode", json_path, 6, 4), corners);
    result_.small_faces += faces.small_faces;
    std::size_t whole = 0;
    for (const auto& face : faces.triangles)
      if (std::ranges::all_of(face, [&](std::uint64_t corner) { return corner < set.count; })) ++whole;
    if (whole < faces.triangles.size())
      document_.fail_at(joined(json_path_, " ('", text_of(member(mesh_, "name")), "')",
                               json_path.substr(json_path_.size())),
                        joined("only ", whole, " of its ", faces.triangles.size(),
                               " faces name vertices that exist; export it again"));
    document_.count_kept(3 * whole, json_path);
    const std::size_t begin = set.corners.size();
    for (const auto& face : faces.triangles)
      for (const std::uint64_t corner : face) set.corners.push_back(static_cast<std::uint32_t>(corner));
    ranges_.push_back({set_number, begin, set.corners.size()});
  }

  /// Reads the vertices that triangles use, and gives the triangles in the order of the primitives.
  void read_vertices() {
    for (VertexSet& set : sets_) {
      const UsedVertices used(set.corners, set.count);
      first_ = static_cast<std::uint32_t>(result_.body.vertices.size());
      if (first_ + used.old_numbers().size() >= Mesh::no_edge)
        document_.fail_at(set.json_path, "the mesh has too many vertices; split it");
      document_.count_kept(3 * used.old_numbers().size(), set.json_path);
      const auto positions = read_accessor(document_, member(*set.attributes, "POSITION"), "VEC3",
                                           joined(set.json_path, ".attributes.POSITION"), used.old_numbers());
      for (std::size_t i = 0; i < positions.count(); ++i)
        result_.body.vertices.push_back(positions.vector(i));
      add_targets(set, used.old_numbers());
      if (joints_ != nullptr) add_influences(set, used.old_numbers());
      for (std::uint32_t& corner : set.corners) corner = first_ + used.new_number(corner);
    }
    for (const CornerRange& range : ranges_)
      for (std::size_t i = range.begin; i < range.end; i += 3)
        result_.faces.add_face(std::span(sets_[range.set].corners).subspan(i, 3));
  }

  /// Gives a target offsets of 0 up to a number of vertices.
  void pad(MorphTarget& target, std::size_t vertices) {
    if (target.offsets.size() >= vertices) return;
    document_.count_kept(3 * (vertices - target.offsets.size()), json_path_);
    target.offsets.resize(vertices, Eigen::Vector3d::Zero());
  }

  void add_targets(const VertexSet& set, const GltfElements& used) {
    if (!set.targets->is_array()) return;
    auto& targets = result_.body.targets;
    targets.resize(std::max(targets.size(), set.targets->size()));
    for (std::size_t i = 0; i < set.targets->size(); ++i) {
      const json& moved = member((*set.targets)[i], "POSITION");
      if (moved.is_null()) continue;
      const std::string here = joined(set.json_path, ".targets[", i, "].POSITION");
      if (accessor_count(document_, moved) != set.count)
        document_.fail_at(here, "the target has another number of vertices than the mesh; export it again");
      const GltfNumbers offsets = read_accessor(document_, moved, "VEC3", here, used);
      document_.count_kept(offsets.values.size(), here);
      pad(targets[i], first_);
      for (std::size_t vertex = 0; vertex < used.size(); ++vertex)
        targets[i].offsets.push_back(offsets.vector(vertex));
    }
  }

  /// Sets of four joints and four weights each: JOINTS_0 and WEIGHTS_0, JOINTS_1 and so on.
  void add_influences(const VertexSet& set, const GltfElements& used) {
    result_.body.influences.resize(result_.body.vertices.size());
    for (std::size_t number = 0;; ++number) {
      const json& joints = member(*set.attributes, joined("JOINTS_", number).c_str());
      const json& weights = member(*set.attributes, joined("WEIGHTS_", number).c_str());
      if (joints.is_null() || weights.is_null()) return;
      const std::string here = joined(set.json_path, ".attributes.WEIGHTS_", number);
      const std::string joints_here = joined(set.json_path, ".attributes.JOINTS_", number);
      if (element_count(document_, joints, "VEC4", joints_here) != set.count ||
          element_count(document_, weights, "VEC4", here) != set.count)
        document_.fail_at(here, "there is not one set of joints and weights a vertex; export it again");
      const GltfNumbers numbers = read_accessor(document_, joints, "VEC4", joints_here, used);
      const GltfNumbers shares = read_accessor(document_, weights, "VEC4", here, used);
      for (std::size_t i = 0; i < shares.values.size(); ++i)
        add_influence(used[i / 4], first_ + i / 4, numbers.values[i], shares.values[i], here);
    }
  }

  void add_influence(std::uint32_t file_vertex, std::size_t vertex, double joint, double weight,
                     const std::string& json_path) {
    if (!(weight > 0)) return;
    if (!(joint >= 0 && joint < static_cast<double>(joints_->size())))
      document_.fail_at(json_path, joined("vertex ", file_vertex,
                                          " (counted from 0) hangs on a joint that is not among the ",
                                          joints_->size(), " of its skin; export it again"));
    result_.body.influences[vertex].push_back({static_cast<std::uint32_t>(joint), weight});
  }

  GltfDocument& document_;
  const json& mesh_;
  std::string json_path_;
  const std::vector<Bone>* joints_;  ///< of the skin. It is null where there is none
  std::map<std::string, std::size_t> set_by_key_;
  std::vector<VertexSet> sets_;
  std::vector<CornerRange> ranges_;  ///< one for each primitive
  std::uint32_t first_ = 0;          ///< the number of the current set's first vertex
  GltfMesh result_;
};

}  // namespace

GltfMesh read_gltf_mesh(GltfDocument& document, const json& number, const std::vector<Bone>* joints) {
  return GltfMeshReader(document, number_of(number), joints).read();
}

std::vector<Bone> read_gltf_skin(GltfDocument& document, const json& number, const std::string& user) {
  const json& skin = element(document.list("skins"), number);
  if (!skin.is_object()) document.fail_at(user, "its skin does not exist; export the file again");
  const std::string json_path = joined("skins[", number_of(number), "]");
  const json& joints = member(skin, "joints");
  const json& matrices = member(skin, "inverseBindMatrices");
  if (!matrices.is_null() && accessor_count(document, matrices) < joints.size())
    document.fail_at(json_path, "there are fewer inverse bind matrices than joints; export it again");
  GltfNumbers offsets;
  if (!matrices.is_null())
    offsets = read_accessor(document, matrices, "MAT4", joined(json_path, ".inverseBindMatrices"));
  std::vector<Bone> bones;
  for (std::size_t i = 0; joints.is_array() && i < joints.size(); ++i) {
    if (!element(document.list("nodes"), joints[i]).is_object())
      document.fail_at(json_path, joined("joint ", i, " is no node of the file; export it again"));
    Bone bone;
    bone.node = joints[i].get<std::uint32_t>();
    if (!matrices.is_null())
      for (Eigen::Index column = 0; column < 4; ++column)
        for (Eigen::Index row = 0; row < 3; ++row)
          bone.offset(row, column) = offsets.values[16 * i + static_cast<std::size_t>(4 * column + row)];
    bones.push_back(bone);
  }
  return bones;
}

}  // namespace graze::io
