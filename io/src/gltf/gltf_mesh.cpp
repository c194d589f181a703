#include "gltf/gltf_mesh.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "gltf/gltf_accessor.hpp"
#include "gltf/gltf_faces.hpp"
#include "gltf/gltf_json.hpp"
#include "mesh/weld.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

class GltfMeshReader {
 public:
  GltfMeshReader(GltfDocument& document, std::uint64_t number, const json& skin)
      : document_(document),
        mesh_(document.list("meshes")[number]),
        json_path_(joined("meshes[", number, "]")) {
    if (!skin.is_null()) read_skin(skin);
  }

  GltfMesh read() {
    std::size_t number = 0;
    for (const json& primitive : member(mesh_, "primitives"))
      add_primitive(primitive, joined(json_path_, ".primitives[", number++, "]"));
    Body& body = result_.body;
    for (auto& target : body.targets) target.offsets.resize(body.vertices.size(), Eigen::Vector3d::Zero());
    if (has_influences())
      body.influences.resize(body.vertices.size());
    else
      body.bones.clear();
    if (body.bones.empty()) body.influences.clear();
    set_rest_weights();
    renumber(leave_out_unused());
    renumber(weld(body));
    document_.count_kept(3 * body.vertices.size() * (1 + body.targets.size()), json_path_);
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool has_influences() const {
    return std::ranges::any_of(result_.body.influences,
                               [](const auto& of_vertex) { return !of_vertex.empty(); });
  }

  void renumber(const std::vector<std::uint32_t>& numbers) {
    for (auto& corner : result_.faces.corners) corner = numbers[corner];
  }

  /// Meshes of one file often share a buffer of vertices, of which each uses some. Returns each old vertex's
  /// new number.
  std::vector<std::uint32_t> leave_out_unused() {
    Body& body = result_.body;
    std::vector<bool> is_used(body.vertices.size(), false);
    for (const std::uint32_t corner : result_.faces.corners) is_used[corner] = true;
    std::vector<std::uint32_t> numbers(body.vertices.size(), 0);
    std::uint32_t count = 0;
    for (std::size_t old = 0; old < is_used.size(); ++old) {
      if (!is_used[old]) continue;
      body.vertices[count] = body.vertices[old];
      for (auto& target : body.targets) target.offsets[count] = target.offsets[old];
      if (count != old && !body.influences.empty()) body.influences[count] = std::move(body.influences[old]);
      numbers[old] = count++;
    }
    body.vertices.resize(count);
    for (auto& target : body.targets) target.offsets.resize(count);
    if (!body.influences.empty()) body.influences.resize(count);
    return numbers;
  }

  void set_rest_weights() {
    const json& weights = member(mesh_, "weights");
    auto& targets = result_.body.targets;
    for (std::size_t i = 0; weights.is_array() && i < std::min(targets.size(), weights.size()); ++i)
      if (weights[i].is_number()) targets[i].rest_weight = weights[i].get<double>();
  }

  void read_skin(const json& number) {
    const json& skin = element(document_.list("skins"), number);
    if (!skin.is_object()) document_.fail_at(json_path_, "its skin does not exist; export the file again");
    const std::string json_path = joined("skins[", number_of(number), "]");
    const json& joints = member(skin, "joints");
    const json& matrices = member(skin, "inverseBindMatrices");
    if (!matrices.is_null() && accessor_count(document_, matrices) < joints.size())
      document_.fail_at(json_path, "there are fewer inverse bind matrices than joints; export it again");
    GltfNumbers offsets;
    if (!matrices.is_null())
      offsets = read_accessor(document_, matrices, "MAT4", joined(json_path, ".inverseBindMatrices"));
    for (std::size_t i = 0; joints.is_array() && i < joints.size(); ++i) {
      if (!element(document_.list("nodes"), joints[i]).is_object())
        document_.fail_at(json_path, joined("joint ", i, " is no node of the file; export it again"));
      Bone bone;
      bone.node = joints[i].get<std::uint32_t>();
      if (!matrices.is_null())
        for (Eigen::Index column = 0; column < 4; ++column)
          for (Eigen::Index row = 0; row < 3; ++row)
            bone.offset(row, column) = offsets.values[16 * i + static_cast<std::size_t>(4 * column + row)];
      result_.body.bones.push_back(bone);
    }
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
    // Primitives often share all of their vertices.
    const std::string key = attributes.dump() + member(primitive, "targets").dump();
    const auto [known, is_new] = vertices_by_key_.try_emplace(key, Vertices{});
    if (is_new) {
      const auto positions =
          read_accessor(document_, position, "VEC3", joined(json_path, ".attributes.POSITION"));
      known->second = {static_cast<std::uint32_t>(result_.body.vertices.size()), positions.count()};
      if (known->second.first + positions.count() >= Mesh::no_edge)
        document_.fail_at(json_path, "the mesh has too many vertices; split it");
      for (std::size_t i = 0; i < positions.count(); ++i)
        result_.body.vertices.push_back(positions.vector(i));
    }
    first_ = known->second.first;
    count_ = known->second.count;
    add_faces(primitive, json_path);
    if (!is_new) return;
    add_targets(member(primitive, "targets"), json_path);
    if (!result_.body.bones.empty()) add_influences(attributes, json_path);
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

  void add_faces(const json& primitive, const std::string& json_path) {
    const json& indices = member(primitive, "indices");
    std::vector<std::uint64_t> corners;
    if (indices.is_null())
      for (std::uint64_t i = 0; i < count_; ++i) corners.push_back(i);
    else
      for (const double index :
           read_accessor(document_, indices, "SCALAR", joined(json_path, ".indices")).values)
        corners.push_back(index >= 0 && index < 4294967296.0 ? static_cast<std::uint64_t>(index) : ~0ULL);
    GltfFaces faces = make_gltf_faces(document_.whole_number(primitive, "mode", json_path, 6, 4), corners);
    result_.small_faces += faces.small_faces;
    std::size_t whole = 0;
    for (const auto& face : faces.triangles)
      if (std::ranges::all_of(face, [&](std::uint64_t corner) { return corner < count_; })) ++whole;
    if (whole < faces.triangles.size())
      document_.fail_at(joined(json_path_, " ('", text_of(member(mesh_, "name")), "')",
                               json_path.substr(json_path_.size())),
                        joined("only ", whole, " of its ", faces.triangles.size(),
                               " faces name vertices that exist; export it again"));
    document_.count_kept(3 * whole, json_path);
    for (const auto& face : faces.triangles)
      result_.faces.add_face(std::array{first_ + static_cast<std::uint32_t>(face[0]),
                                        first_ + static_cast<std::uint32_t>(face[1]),
                                        first_ + static_cast<std::uint32_t>(face[2])});
  }

  void add_targets(const json& sources, const std::string& json_path) {
    if (!sources.is_array()) return;
    auto& targets = result_.body.targets;
    targets.resize(std::max(targets.size(), sources.size()));
    for (std::size_t i = 0; i < sources.size(); ++i) {
      const json& moved = member(sources[i], "POSITION");
      if (moved.is_null()) continue;
      const std::string here = joined(json_path, ".targets[", i, "].POSITION");
      if (accessor_count(document_, moved) != count_)
        document_.fail_at(here, "the target has another number of vertices than the mesh; export it again");
      const GltfNumbers offsets = read_accessor(document_, moved, "VEC3", here);
      targets[i].offsets.resize(first_, Eigen::Vector3d::Zero());
      for (std::size_t vertex = 0; vertex < count_; ++vertex)
        targets[i].offsets.push_back(offsets.vector(vertex));
    }
  }

  /// Sets of four joints and four weights each: JOINTS_0 and WEIGHTS_0, JOINTS_1 and so on.
  void add_influences(const json& attributes, const std::string& json_path) {
    result_.body.influences.resize(result_.body.vertices.size());
    for (std::size_t set = 0;; ++set) {
      const json& joints = member(attributes, joined("JOINTS_", set).c_str());
      const json& weights = member(attributes, joined("WEIGHTS_", set).c_str());
      if (joints.is_null() || weights.is_null()) return;
      const std::string here = joined(json_path, ".attributes.WEIGHTS_", set);
      const GltfNumbers numbers =
          read_accessor(document_, joints, "VEC4", joined(json_path, ".attributes.JOINTS_", set));
      const GltfNumbers shares = read_accessor(document_, weights, "VEC4", here);
      if (numbers.count() != count_ || shares.count() != count_)
        document_.fail_at(here, "there is not one set of joints and weights a vertex; export it again");
      for (std::size_t i = 0; i < shares.values.size(); ++i)
        add_influence(i / 4, numbers.values[i], shares.values[i], here);
    }
  }

  /// Keeps a vertex's influences in order of bones, each bone once.
  void add_influence(std::size_t vertex, double joint, double weight, const std::string& json_path) {
    if (!(weight > 0)) return;
    const std::size_t bones = result_.body.bones.size();
    if (!(joint >= 0 && joint < static_cast<double>(bones)))
      document_.fail_at(json_path,
                        joined("vertex ", vertex, " (counted from 0) hangs on a joint that is not among the ",
                               bones, " of its skin; export it again"));
    const auto bone = static_cast<std::uint32_t>(joint);
    auto& influences = result_.body.influences[first_ + vertex];
    const auto at = std::ranges::find_if(influences, [&](const Influence& i) { return i.bone >= bone; });
    if (at != influences.end() && at->bone == bone)
      at->weight += weight;
    else
      influences.insert(at, {bone, weight});
  }

  /// The range of a primitive's vertices among those of the body.
  struct Vertices {
    std::uint32_t first = 0;
    std::size_t count = 0;
  };

  GltfDocument& document_;
  const json& mesh_;
  std::string json_path_;
  std::map<std::string, Vertices> vertices_by_key_;
  std::uint32_t first_ = 0;  ///< the number of the current primitive's first vertex
  std::size_t count_ = 0;    ///< how many vertices it has
  GltfMesh result_;
};

}  // namespace

GltfMesh read_gltf_mesh(GltfDocument& document, const json& number, const json& skin) {
  return GltfMeshReader(document, number_of(number), skin).read();
}

}  // namespace graze::io
