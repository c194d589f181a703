#include "assimp_scene_builder.hpp"

#include <array>
#include <vector>

namespace graze::fuzz {
namespace {

/// Mostly a small multiple of 1/4, now and then any bit pattern.
template <typename Real>
Real real(ByteReader& reader) {
  const std::uint8_t byte = reader.byte();
  if (byte == 255) return reader.raw<Real>();
  return static_cast<Real>((byte - 64) / 4.0);
}

/// Mostly below `count`, now and then not.
unsigned number(ByteReader& reader, unsigned count) {
  if (reader.once_in(64)) return reader.raw<std::uint32_t>();
  return reader.below(count + (reader.once_in(32) ? 1 : 0));
}

aiVector3D vector(ByteReader& reader) {
  const auto x = real<float>(reader);
  const auto y = real<float>(reader);
  return {x, y, real<float>(reader)};
}

aiMatrix4x4 matrix(ByteReader& reader) {
  aiMatrix4x4 result;
  const std::uint32_t kind = reader.below(4);
  if (kind == 1) aiMatrix4x4::Translation(vector(reader), result);
  if (kind == 2) aiMatrix4x4::Scaling(vector(reader), result);
  if (kind == 3)
    for (unsigned row = 0; row < 4; ++row)
      for (unsigned column = 0; column < 4; ++column) result[row][column] = real<float>(reader);
  return result;
}

/// Gives `array` and `count` new entries made one after the other by `make`.
template <typename Entry, typename Make>
void fill(Entry*& array, unsigned& count, unsigned length, Make make) {
  count = length;
  array = length == 0 ? nullptr : new Entry[length];
  for (unsigned i = 0; i < length; ++i) array[i] = make();
}

aiBone* bone(ByteReader& reader, unsigned vertices) {
  auto result = std::make_unique<aiBone>();
  result->mName = pick_name(reader);
  result->mOffsetMatrix = matrix(reader);
  fill(result->mWeights, result->mNumWeights, reader.below(6), [&] {
    const unsigned vertex = number(reader, std::max(vertices, 1U));
    return aiVertexWeight(vertex, real<float>(reader));
  });
  return result.release();
}

aiAnimMesh* morph_target(ByteReader& reader, unsigned vertices) {
  auto result = std::make_unique<aiAnimMesh>();
  const unsigned count = reader.once_in(16) ? reader.below(8) : vertices;
  fill(result->mVertices, result->mNumVertices, count, [&] { return vector(reader); });
  if (reader.once_in(16)) {
    delete[] result->mVertices;
    result->mVertices = nullptr;
  }
  result->mWeight = real<float>(reader);
  return result.release();
}

aiMesh* mesh(ByteReader& reader) {
  auto result = std::make_unique<aiMesh>();
  result->mName = pick_name(reader);
  fill(result->mVertices, result->mNumVertices, reader.below(9), [&] { return vector(reader); });
  const unsigned vertices = result->mNumVertices;
  if (reader.once_in(64)) {
    delete[] result->mVertices;
    result->mVertices = nullptr;
  }
  fill(result->mFaces, result->mNumFaces, reader.below(6), [&] {
    aiFace face;
    const unsigned corners = reader.flag() ? 3 : reader.below(8);
    fill(face.mIndices, face.mNumIndices, corners, [&] { return number(reader, std::max(vertices, 1U)); });
    return face;
  });
  fill(result->mBones, result->mNumBones, reader.below(4), [&] { return bone(reader, vertices); });
  fill(result->mAnimMeshes, result->mNumAnimMeshes, reader.below(3),
       [&] { return morph_target(reader, vertices); });
  return result.release();
}

aiNode* node(ByteReader& reader, unsigned mesh_count) {
  auto result = std::make_unique<aiNode>(pick_name(reader));
  result->mTransformation = matrix(reader);
  fill(result->mMeshes, result->mNumMeshes, reader.below(3), [&] { return number(reader, mesh_count); });
  return result.release();
}

/// A tree of nodes, each below an earlier one.
aiNode* node_tree(ByteReader& reader, unsigned mesh_count) {
  std::vector<aiNode*> nodes = {node(reader, mesh_count)};
  for (unsigned more = reader.below(8); more > 0; --more) {
    aiNode* const parent = nodes[reader.below(static_cast<std::uint32_t>(nodes.size()))];
    aiNode* child = node(reader, mesh_count);
    parent->addChildren(1, &child);
    nodes.push_back(child);
  }
  return nodes[0];
}

aiNodeAnim* channel(ByteReader& reader) {
  auto result = std::make_unique<aiNodeAnim>();
  result->mNodeName = pick_name(reader);
  const auto vector_key = [&] {
    const auto time = real<double>(reader);
    return aiVectorKey(time, vector(reader));
  };
  fill(result->mPositionKeys, result->mNumPositionKeys, reader.below(4), vector_key);
  fill(result->mRotationKeys, result->mNumRotationKeys, reader.below(4), [&] {
    const auto time = real<double>(reader);
    const auto w = real<float>(reader);
    const aiVector3D axis = vector(reader);
    return aiQuatKey(time, aiQuaternion(w, axis.x, axis.y, axis.z));
  });
  fill(result->mScalingKeys, result->mNumScalingKeys, reader.below(4), vector_key);
  return result.release();
}

aiMeshMorphAnim* morph_channel(ByteReader& reader) {
  auto result = std::make_unique<aiMeshMorphAnim>();
  result->mName = pick_name(reader) + (reader.flag() ? "*0" : "");
  result->mNumKeys = reader.below(4);
  result->mKeys = new aiMeshMorphKey[result->mNumKeys];
  for (unsigned i = 0; i < result->mNumKeys; ++i) {
    aiMeshMorphKey& key = result->mKeys[i];
    key.mTime = real<double>(reader);
    key.mNumValuesAndWeights = reader.below(4);
    if (key.mNumValuesAndWeights == 0) continue;
    key.mValues = new unsigned[key.mNumValuesAndWeights];
    key.mWeights = new double[key.mNumValuesAndWeights];
    for (unsigned j = 0; j < key.mNumValuesAndWeights; ++j) {
      key.mValues[j] = number(reader, 3);
      key.mWeights[j] = real<double>(reader);
    }
  }
  return result.release();
}

aiAnimation* animation(ByteReader& reader) {
  auto result = std::make_unique<aiAnimation>();
  result->mName = pick_name(reader);
  result->mDuration = real<double>(reader);
  result->mTicksPerSecond = real<double>(reader);
  fill(result->mChannels, result->mNumChannels, reader.below(4), [&] { return channel(reader); });
  fill(result->mMorphMeshChannels, result->mNumMorphMeshChannels, reader.below(3),
       [&] { return morph_channel(reader); });
  return result.release();
}

}  // namespace

std::string pick_name(ByteReader& reader) {
  static const std::array<std::string, 8> names = {"",       "a",          "b",   "c",
                                                   "<root>", "two\nlines", "d*0", std::string(1000, 'x')};
  const std::uint32_t choice = reader.below(9);
  return choice < names.size() ? names[choice] : reader.text(reader.below(16));
}

std::unique_ptr<aiScene> build_assimp_scene(ByteReader& reader) {
  auto scene = std::make_unique<aiScene>();
  fill(scene->mMeshes, scene->mNumMeshes, 1 + reader.below(3), [&] { return mesh(reader); });
  if (!reader.once_in(64)) scene->mRootNode = node_tree(reader, scene->mNumMeshes);
  fill(scene->mAnimations, scene->mNumAnimations, reader.below(3), [&] { return animation(reader); });
  return scene;
}

}  // namespace graze::fuzz
