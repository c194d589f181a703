#include "gltf/gltf_nodes.hpp"

#include <algorithm>
#include <utility>

#include "gltf/gltf_json.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

using nlohmann::json;

/// `count` numbers under `key`, or `values` as they are where the key is missing.
void read_numbers(const GltfDocument& document, const json& node, const char* key,
                  const std::string& json_path, double* values, std::size_t count) {
  const json& list = member(node, key);
  if (list.is_null()) return;
  const bool fits = list.is_array() && list.size() == count &&
                    std::ranges::all_of(list, [](const json& value) { return value.is_number(); });
  if (!fits)
    document.fail_at(joined(json_path, ".", key),
                     joined("expected ", count, " numbers; export the file again"));
  for (std::size_t i = 0; i < count; ++i) values[i] = list[i].get<double>();
}

/// Only a node that is animated needs its parts, and such a node has no matrix by the standard.
RigNode node_from_matrix(std::uint32_t parent, const Eigen::Matrix4d& matrix) {
  RigNode node;
  node.parent = parent;
  node.local.matrix().topRows<3>() = matrix.topRows<3>();
  node.translation = node.local.translation();
  Eigen::Matrix3d linear = node.local.linear();
  node.scale = linear.colwise().norm();
  if (linear.determinant() < 0) node.scale.x() = -node.scale.x();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (node.scale[axis] != 0) linear.col(axis) /= node.scale[axis];
  const Eigen::Quaterniond rotation(linear);
  if (rotation.norm() > 0) node.rotation = rotation.normalized();
  return node;
}

RigNode read_node(const GltfDocument& document, const json& source, const std::string& json_path,
                  std::uint32_t parent) {
  if (!member(source, "matrix").is_null()) {
    Eigen::Matrix4d matrix;
    read_numbers(document, source, "matrix", json_path, matrix.data(), 16);
    return node_from_matrix(parent, matrix);
  }
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  Eigen::Vector4d rotation(0, 0, 0, 1);
  read_numbers(document, source, "translation", json_path, translation.data(), 3);
  read_numbers(document, source, "rotation", json_path, rotation.data(), 4);
  read_numbers(document, source, "scale", json_path, scale.data(), 3);
  return make_gltf_node(parent, translation, Eigen::Quaterniond(rotation), scale);
}

class GltfNodeReader {
 public:
  explicit GltfNodeReader(const GltfDocument& document)
      : document_(document), sources_(document.list("nodes")) {
    result_.number_of.assign(sources_.size(), RigNode::no_parent);
  }

  GltfNodes read() {
    add_trees(scene_roots());
    result_.scene_count = result_.nodes.size();
    add_trees(other_roots());
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (result_.number_of[i] == RigNode::no_parent)
        document_.fail_at(joined("nodes[", i, "]"), "it hangs below itself; export the file again");
    note_what_is_left_out();
    return std::move(result_);
  }

 private:
  /// Nodes that are no other node's child and were not read yet.
  [[nodiscard]] std::vector<std::uint64_t> other_roots() const {
    std::vector<bool> is_child(sources_.size(), false);
    for (const json& node : sources_)
      for (const json& child : member(node, "children"))
        if (child.is_number_unsigned() && child.get<std::uint64_t>() < is_child.size())
          is_child[child.get<std::uint64_t>()] = true;
    std::vector<std::uint64_t> roots;
    for (std::size_t i = 0; i < sources_.size(); ++i)
      if (!is_child[i] && result_.number_of[i] == RigNode::no_parent) roots.push_back(i);
    return roots;
  }

  /// Returns the roots of the default scene, or those of the first one if none is the default. If there are
  /// no scenes, all roots count.
  [[nodiscard]] std::vector<std::uint64_t> scene_roots() {
    const json& scenes = document_.list("scenes");
    if (scenes.empty()) return other_roots();
    scene_ = document_.whole_number(document_.root(), "scene", "the document", scenes.size() - 1, 0);
    std::vector<std::uint64_t> roots;
    for (const json& root : member(scenes[scene_], "nodes"))
      roots.push_back(checked(root, joined("scenes[", scene_, "]")));
    return roots;
  }

  [[nodiscard]] std::uint64_t checked(const json& number, const std::string& json_path) const {
    if (!element(sources_, number).is_object())
      document_.fail_at(json_path, joined("it names a node that is not among the ", sources_.size(),
                                          "; export the file again"));
    return number.get<std::uint64_t>();
  }

  struct Open {
    std::uint64_t source;
    std::uint32_t parent;
    std::size_t depth;
  };

  void add_trees(const std::vector<std::uint64_t>& roots) {
    std::vector<Open> open;
    for (const std::uint64_t root : roots) {
      open.push_back({root, RigNode::no_parent, 0});
      while (!open.empty()) {
        const Open next = open.back();
        open.pop_back();
        add_node(next, open);
      }
    }
  }

  void add_node(const Open& next, std::vector<Open>& open) {
    constexpr std::size_t deepest = 1000;
    const std::string json_path = joined("nodes[", next.source, "]");
    if (next.depth > deepest)
      document_.fail_at(json_path, joined("it is nested deeper than ", deepest, " nodes; simplify the file"));
    if (result_.number_of[next.source] != RigNode::no_parent)
      document_.fail_at(json_path, "it hangs below itself or below two others; export the file again");
    const json& source = sources_[next.source];
    const auto number = static_cast<std::uint32_t>(result_.nodes.size());
    result_.number_of[next.source] = number;
    result_.sources.push_back(next.source);
    result_.nodes.push_back(read_node(document_, source, json_path, next.parent));
    const json& children = member(source, "children");
    for (std::size_t i = children.is_array() ? children.size() : 0; i > 0; --i)
      open.push_back({checked(children[i - 1], json_path), number, next.depth + 1});
  }

  void note_what_is_left_out() {
    std::size_t left_out = 0;
    for (std::size_t i = result_.scene_count; i < result_.nodes.size(); ++i)
      left_out += member(sources_[result_.sources[i]], "mesh").is_null() ? 0U : 1U;
    const json& scenes = document_.list("scenes");
    if (scenes.size() < 2 && left_out == 0) return;
    const std::string name = text_of(member(scenes[scene_], "name"));
    result_.warnings.push_back(
        joined(document_.path().string(), ": scene ", scene_, name.empty() ? "" : joined(" '", name, "'"),
               ", the default of ", scenes.size(), ", is read; ", left_out,
               left_out == 1 ? " node" : " nodes", " with a mesh outside of it left out"));
  }

  const GltfDocument& document_;
  const json& sources_;
  std::uint64_t scene_ = 0;
  GltfNodes result_;
};

}  // namespace

RigNode make_gltf_node(std::uint32_t parent, const Eigen::Vector3d& translation,
                       const Eigen::Quaterniond& rotation, const Eigen::Vector3d& scale) {
  RigNode node;
  node.parent = parent;
  node.translation = translation;
  node.scale = scale;
  if (rotation.norm() > 0) node.rotation = rotation.normalized();
  node.local.fromPositionOrientationScale(node.translation, node.rotation, node.scale);
  return node;
}

GltfNodes read_gltf_nodes(const GltfDocument& document) {
  return GltfNodeReader(document).read();
}

}  // namespace graze::io
