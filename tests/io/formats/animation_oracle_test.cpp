#include <assimp/config.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <map>
#include <optional>

#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

/// A second evaluation of assimp's animations, in its own types and single precision, vertex by vertex.
class Oracle {
 public:
  Oracle(const aiScene& scene, std::size_t animation, double seconds) {
    const aiAnimation& clip = *scene.mAnimations[animation];
    const double ticks = seconds * (clip.mTicksPerSecond > 0 ? clip.mTicksPerSecond : 25);
    std::map<std::string, const aiNodeAnim*> channels;
    for (unsigned i = 0; i < clip.mNumChannels; ++i)
      channels[clip.mChannels[i]->mNodeName.C_Str()] = clip.mChannels[i];
    for (unsigned i = 0; i < clip.mNumMorphMeshChannels; ++i)
      add_morph_weights(*clip.mMorphMeshChannels[i], ticks);
    place(*scene.mRootNode, aiMatrix4x4(), channels, ticks);
  }

  /// All vertices of a node's meshes, one after the other, repeated ones included.
  [[nodiscard]] std::vector<Eigen::Vector3d> vertices(const aiScene& scene, const aiNode& node) const {
    std::vector<Eigen::Vector3d> result;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
      const auto weights = weights_.find(node.mName.C_Str());
      for (unsigned vertex = 0; vertex < mesh.mNumVertices; ++vertex) {
        aiVector3D local = mesh.mVertices[vertex];
        if (weights != weights_.end())
          for (unsigned target = 0; target < mesh.mNumAnimMeshes; ++target)
            local += (mesh.mAnimMeshes[target]->mVertices[vertex] - mesh.mVertices[vertex]) *
                     weights->second.at(target);
        const aiVector3D global =
            skinned(mesh, vertex, local).value_or(globals_.at(node.mName.C_Str()) * local);
        result.emplace_back(global.x, global.y, global.z);
      }
    }
    return result;
  }

 private:
  void add_morph_weights(const aiMeshMorphAnim& channel, double ticks) {
    unsigned right = 0;
    while (right < channel.mNumKeys && channel.mKeys[right].mTime <= ticks) ++right;
    const aiMeshMorphKey& a = channel.mKeys[right == 0 ? 0 : right - 1];
    const aiMeshMorphKey& b = channel.mKeys[right == channel.mNumKeys ? right - 1 : right];
    const double part = b.mTime > a.mTime ? (ticks - a.mTime) / (b.mTime - a.mTime) : 0;
    for (unsigned i = 0; i < a.mNumValuesAndWeights; ++i)
      weights_[channel.mName.C_Str()][a.mValues[i]] =
          static_cast<float>(a.mWeights[i] * (1 - part) + b.mWeights[i] * part);
  }

  static aiVector3D mix(const aiVector3D& a, const aiVector3D& b, float part) {
    return a * (1 - part) + b * part;
  }
  static aiQuaternion mix(const aiQuaternion& a, const aiQuaternion& b, float part) {
    aiQuaternion result;
    aiQuaternion::Interpolate(result, a, b, part);
    return result.Normalize();
  }

  template <typename Key>
  static auto value_at(const Key* keys, unsigned count, double ticks) {
    unsigned right = 0;
    while (right < count && keys[right].mTime <= ticks) ++right;
    if (right == 0) return keys[0].mValue;
    if (right == count) return keys[count - 1].mValue;
    const Key& a = keys[right - 1];
    const Key& b = keys[right];
    return mix(a.mValue, b.mValue, static_cast<float>((ticks - a.mTime) / (b.mTime - a.mTime)));
  }

  void place(const aiNode& node, const aiMatrix4x4& parent,
             const std::map<std::string, const aiNodeAnim*>& channels, double ticks) {
    aiMatrix4x4 local = node.mTransformation;
    const auto found = channels.find(node.mName.C_Str());
    if (found != channels.end()) {
      const aiNodeAnim& channel = *found->second;
      local = aiMatrix4x4(value_at(channel.mScalingKeys, channel.mNumScalingKeys, ticks),
                          value_at(channel.mRotationKeys, channel.mNumRotationKeys, ticks),
                          value_at(channel.mPositionKeys, channel.mNumPositionKeys, ticks));
    }
    const aiMatrix4x4 global = parent * local;
    globals_.emplace(node.mName.C_Str(), global);
    for (unsigned i = 0; i < node.mNumChildren; ++i) place(*node.mChildren[i], global, channels, ticks);
  }

  [[nodiscard]] std::optional<aiVector3D> skinned(const aiMesh& mesh, unsigned vertex,
                                                  const aiVector3D& local) const {
    aiVector3D sum;
    float total = 0;
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const aiBone& bone = *mesh.mBones[i];
      const auto global = globals_.find(bone.mName.C_Str());
      for (unsigned j = 0; j < bone.mNumWeights && global != globals_.end(); ++j)
        if (bone.mWeights[j].mVertexId == vertex) {
          sum += (global->second * bone.mOffsetMatrix * local) * bone.mWeights[j].mWeight;
          total += bone.mWeights[j].mWeight;
        }
    }
    if (total > 0) return sum / total;
    return std::nullopt;
  }

  std::map<std::string, aiMatrix4x4> globals_;
  std::map<std::string, std::map<unsigned, float>> weights_;
};

const aiNode* node_with_meshes(const aiNode& node) {
  if (node.mNumMeshes > 0) return &node;
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    if (const aiNode* found = node_with_meshes(*node.mChildren[i])) return found;
  return nullptr;
}

/// Every triangle or quad of the first object, corner by corner, against the oracle's repeated vertices.
double largest_corner_difference(const graze::Mesh& mesh, const std::vector<Eigen::Vector3d>& positions,
                                 const aiScene& scene, const aiNode& node,
                                 const std::vector<Eigen::Vector3d>& oracle) {
  double largest = 0;
  std::uint32_t face = 0;
  std::size_t first = 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& source = *scene.mMeshes[node.mMeshes[i]];
    for (unsigned j = 0; j < source.mNumFaces; ++j) {
      if (source.mFaces[j].mNumIndices < 3) continue;
      const auto corners = mesh.face(face++);
      REQUIRE(corners.size() == source.mFaces[j].mNumIndices);
      for (std::size_t corner = 0; corner < corners.size(); ++corner)
        largest = std::max(
            largest, (positions[corners[corner]] - oracle[first + source.mFaces[j].mIndices[corner]]).norm());
    }
    first += source.mNumVertices;
  }
  REQUIRE(face == mesh.face_count());
  return largest;
}

double size_of(const std::vector<Eigen::Vector3d>& positions) {
  Eigen::Vector3d low = positions[0];
  Eigen::Vector3d high = positions[0];
  for (const auto& position : positions) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  return (high - low).norm();
}

void check_against_oracle(const std::filesystem::path& path) {
  Assimp::Importer importer;
  // Coordinates are taken as they stand. Left alone, assimp turns COLLADA files until y points up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  REQUIRE(scene != nullptr);
  const aiNode* node = node_with_meshes(*scene->mRootNode);
  REQUIRE(node != nullptr);
  const auto file = MeshFile::read(path);
  REQUIRE(file.objects()[0].animated);
  REQUIRE(file.animations().size() == scene->mNumAnimations);
  std::vector<Eigen::Vector3d> start;
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t animation = 0; animation < file.animations().size(); ++animation) {
    double largest_move = 0;
    file.animate(0, animation, 0, start);
    for (const double part : {0.0, 0.13, 0.4, 0.77, 1.0}) {
      const double seconds = part * file.animation_seconds(animation);
      file.animate(0, animation, seconds, positions);
      const auto oracle = Oracle(*scene, animation, seconds).vertices(*scene, *node);
      INFO(path << ", animation " << animation << ", second " << seconds);
      CHECK(largest_corner_difference(*file.objects()[0].mesh, positions, *scene, *node, oracle) <
            1e-5 * size_of(positions));
      largest_move = std::max(largest_move, largest_difference(positions, start));
    }
    CHECK(largest_move > 1e-3 * size_of(start));
  }
}

}  // namespace

TEST_CASE("animations of real characters are evaluated as a plain second evaluation says") {
  const auto path = GENERATE(
      shared_file("characters/Fox.glb"), shared_file("characters/AnimatedMorphSphere.glb"),
      shared_file("characters/MorphStressTest.gltf"), assimp_model("FBX/huesitos.fbx"),
      assimp_model("FBX/animation_with_skeleton.fbx"), assimp_model("X/BCN_Epileptic.X"),
      assimp_model("X/anim_test.x"), assimp_model("Collada/anims_with_full_rotations_between_keys.DAE"));
  if (is_missing(path)) return;
  check_against_oracle(path);
}

TEST_CASE("an FBX skeleton in its bind pose leaves the mesh where the modeller had it") {
  const auto path = assimp_model("FBX/huesitos.fbx");
  if (is_missing(path)) return;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  REQUIRE(scene != nullptr);
  const aiNode* node = node_with_meshes(*scene->mRootNode);
  aiMatrix4x4 global;
  for (const aiNode* step = node; step != nullptr; step = step->mParent)
    global = step->mTransformation * global;
  std::vector<Eigen::Vector3d> unskinned;
  const aiMesh& mesh = *scene->mMeshes[node->mMeshes[0]];
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const aiVector3D place = global * mesh.mVertices[i];
    unskinned.emplace_back(place.x, place.y, place.z);
  }
  const auto file = MeshFile::read(path);
  const auto rest = file.objects()[0].mesh->rest();
  const std::vector<Eigen::Vector3d> positions(rest.begin(), rest.end());
  CHECK(largest_corner_difference(*file.objects()[0].mesh, positions, *scene, *node, unskinned) <
        1e-4 * size_of(positions));
}
