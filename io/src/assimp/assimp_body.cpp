#include "assimp/assimp_body.hpp"

#include <algorithm>
#include <span>
#include <unordered_map>
#include <vector>

#include "assimp/assimp_convert.hpp"
#include "assimp/assimp_pivots.hpp"
#include "mesh/skin.hpp"
#include "mesh/weld.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

bool has_surface(const aiMesh& mesh) {
  return std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces,
                     [](const aiFace& face) { return face.mNumIndices >= 3; });
}

class BodyReader {
 public:
  BodyReader(const std::filesystem::path& path, const NodeTable& nodes, std::uint32_t node,
             bool use_rest_weights)
      : path_(path), nodes_(nodes), use_rest_weights_(use_rest_weights) {
    result_.body.node = result_.body.morph_node = node;
    geometric_ = geometric_transform(nodes, node);
  }

  void add(const aiMesh& mesh) {
    first_ = static_cast<std::uint32_t>(result_.body.vertices.size());
    add_faces(mesh);
    if (!has_surface(mesh)) return;
    if (mesh.mVertices == nullptr)
      fail(path_, joined("mesh '", mesh.mName.C_Str(), "': it has no positions; export it again"));
    for (unsigned i = 0; i < mesh.mNumVertices; ++i)
      result_.body.vertices.push_back(to_eigen(mesh.mVertices[i]));
    add_targets(mesh);
    add_bones(mesh);
  }

  NodeObject finish() {
    Body& body = result_.body;
    for (auto& target : body.targets) target.offsets.resize(body.vertices.size(), Eigen::Vector3d::Zero());
    if (!body.influences.empty()) {
      body.influences.resize(body.vertices.size());
      set_bones(body, joints_);
    }
    const auto numbers = weld(body);
    for (auto& corner : result_.faces.corners) corner = numbers[corner];
    return std::move(result_);
  }

 private:
  void add_faces(const aiMesh& mesh) {
    std::vector<std::uint32_t> corners;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const std::span face(mesh.mFaces[i].mIndices, mesh.mFaces[i].mNumIndices);
      if (face.size() < 3) {
        ++result_.small_faces;
        continue;
      }
      corners.clear();
      for (const unsigned corner : face) {
        if (corner >= mesh.mNumVertices)
          fail(path_, joined("mesh '", mesh.mName.C_Str(), "': face ", i, " (counted from 0) names vertex ",
                             corner, " of ", mesh.mNumVertices, "; remove the face or add the vertex"));
        corners.push_back(first_ + corner);
      }
      result_.faces.add_face(corners);
    }
  }

  void add_targets(const aiMesh& mesh) {
    auto& targets = result_.body.targets;
    targets.resize(std::max<std::size_t>(targets.size(), mesh.mNumAnimMeshes));
    for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
      const aiAnimMesh& source = *mesh.mAnimMeshes[i];
      if (use_rest_weights_) targets[i].rest_weight = static_cast<double>(source.mWeight);
      if (source.mVertices == nullptr || source.mNumVertices != mesh.mNumVertices) continue;
      targets[i].offsets.resize(first_, Eigen::Vector3d::Zero());
      for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex)
        targets[i].offsets.emplace_back(to_eigen(source.mVertices[vertex]) -
                                        to_eigen(mesh.mVertices[vertex]));
    }
  }

  void add_bones(const aiMesh& mesh) {
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const aiBone& source = *mesh.mBones[i];
      const auto node = nodes_.find(source.mName.C_Str());
      if (!node) {
        result_.missing_bones.insert(source.mName.C_Str());
        continue;
      }
      const std::uint32_t bone = number_of_bone(*node, to_eigen(source.mOffsetMatrix) * geometric_);
      for (unsigned j = 0; j < source.mNumWeights; ++j) add_influence(mesh, bone, source.mWeights[j]);
    }
  }

  /// Meshes of one node name the same bones. Each is kept once.
  std::uint32_t number_of_bone(std::uint32_t node, const Eigen::Affine3d& offset) {
    const auto [begin, end] = joints_of_node_.equal_range(node);
    for (auto known = begin; known != end; ++known)
      if (joints_[known->second].offset.matrix() == offset.matrix()) return known->second;
    const auto number = static_cast<std::uint32_t>(joints_.size());
    joints_.push_back({node, offset});
    joints_of_node_.emplace(node, number);
    return number;
  }

  void add_influence(const aiMesh& mesh, std::uint32_t bone, const aiVertexWeight& source) {
    if (!(source.mWeight > 0)) return;
    if (source.mVertexId >= mesh.mNumVertices)
      fail(path_, joined("mesh '", mesh.mName.C_Str(), "': a bone weight is for vertex ", source.mVertexId,
                         " of ", mesh.mNumVertices, "; export the skeleton again"));
    auto& influences = result_.body.influences;
    influences.resize(result_.body.vertices.size());
    influences[first_ + source.mVertexId].push_back({bone, static_cast<double>(source.mWeight)});
  }

  const std::filesystem::path& path_;
  const NodeTable& nodes_;
  bool use_rest_weights_;
  Eigen::Affine3d geometric_;
  std::vector<Bone> joints_;
  std::unordered_multimap<std::uint32_t, std::uint32_t> joints_of_node_;
  std::uint32_t first_ = 0;  ///< the number of the current mesh's first vertex
  NodeObject result_;
};

}  // namespace

NodeObject read_node_object(const std::filesystem::path& path, const aiScene& scene, const NodeTable& nodes,
                            std::uint32_t node, bool use_rest_weights) {
  BodyReader reader(path, nodes, node, use_rest_weights);
  const aiNode& source = *nodes.sources[node];
  for (const unsigned mesh : std::span(source.mMeshes, source.mNumMeshes)) {
    if (mesh >= scene.mNumMeshes)
      fail(path, joined("node '", source.mName.C_Str(), "' names mesh ", mesh, " of ", scene.mNumMeshes,
                        "; export the file again"));
    reader.add(*scene.mMeshes[mesh]);
  }
  return reader.finish();
}

}  // namespace graze::io
