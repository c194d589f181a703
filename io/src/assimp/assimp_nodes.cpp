#include "assimp/assimp_nodes.hpp"

#include <utility>

#include "assimp/assimp_convert.hpp"

namespace graze::io {
namespace {

RigNode make_node(const aiNode& source, std::uint32_t parent) {
  RigNode node;
  node.parent = parent;
  node.local = to_eigen(source.mTransformation);
  aiVector3D scale;
  aiQuaternion rotation;
  aiVector3D translation;
  source.mTransformation.Decompose(scale, rotation, translation);
  node.translation = to_eigen(translation);
  node.rotation = to_eigen(rotation);
  node.scale = to_eigen(scale);
  return node;
}

}  // namespace

NodeTable::NodeTable(const aiScene& scene) {
  if (scene.mRootNode == nullptr) return;
  std::vector<std::pair<const aiNode*, std::uint32_t>> open = {{scene.mRootNode, RigNode::no_parent}};
  while (!open.empty()) {
    const auto [source, parent] = open.back();
    open.pop_back();
    const auto number = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(make_node(*source, parent));
    sources.push_back(source);
    by_name.try_emplace(source->mName.C_Str(), number);
    for (unsigned child = source->mNumChildren; child > 0; --child)
      open.emplace_back(source->mChildren[child - 1], number);
  }
}

}  // namespace graze::io
