#include "io/formats/fbx_builder.hpp"

#include <array>
#include <numbers>
#include <sstream>

namespace graze::tests {
namespace {

Eigen::Affine3d shift(const Eigen::Vector3d& by) {
  return Eigen::Affine3d(Eigen::Translation3d(by));
}

Eigen::Affine3d turn(const Eigen::Vector3d& degrees, int order = 0) {
  constexpr std::array<std::array<int, 3>, 6> axes = {
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}}};
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  for (const int axis : axes[static_cast<std::size_t>(order)])
    result = Eigen::AngleAxisd(degrees[axis] * std::numbers::pi / 180, Eigen::Vector3d::Unit(axis)) * result;
  return result;
}

Eigen::Affine3d stretch(const Eigen::Vector3d& by) {
  return Eigen::Affine3d(Eigen::Scaling(by));
}

Eigen::Vector3d value_at(const FbxNode::Keys& keys, std::optional<int> key, const Eigen::Vector3d& rest) {
  if (!keys || !key) return rest;
  return *key == 0 ? keys->first : keys->second;
}

/// T · Roff · Rp · Rpre · R · Rpost⁻¹ · Rp⁻¹ · Soff · Sp · S · Sp⁻¹, the formula of the FBX SDK.
Eigen::Affine3d local(const FbxNode& node, std::optional<int> key) {
  return shift(value_at(node.translation_keys, key, node.translation)) * shift(node.rotation_offset) *
         shift(node.rotation_pivot) * turn(node.pre_rotation) *
         turn(value_at(node.rotation_keys, key, node.rotation), node.rotation_order) *
         turn(node.post_rotation).inverse() * shift(-node.rotation_pivot) * shift(node.scaling_offset) *
         shift(node.scaling_pivot) * stretch(value_at(node.scale_keys, key, node.scale)) *
         shift(-node.scaling_pivot);
}

Eigen::Affine3d geometric(const FbxNode& node) {
  return shift(node.geometric_translation) * turn(node.geometric_rotation) * stretch(node.geometric_scale);
}

template <typename Numbers>
std::string listed(const Numbers& numbers) {
  std::ostringstream text;
  text.precision(12);
  for (Eigen::Index i = 0; i < numbers.size(); ++i) text << (i == 0 ? "" : ",") << numbers.data()[i];
  return text.str();
}

std::string array_text(const std::string& key, std::size_t count, const std::string& numbers) {
  return key + ": *" + std::to_string(count) + " {\na: " + numbers + "\n}\n";
}

std::string connection(std::size_t from, std::size_t to, const std::string& property = "") {
  return "C: \"" + std::string(property.empty() ? "OO" : "OP") + "\"," + std::to_string(from) + "," +
         std::to_string(to) + (property.empty() ? "" : ", \"" + property + "\"") + "\n";
}

std::size_t node_id(std::size_t node) {
  return 1000 + node;
}

std::string node_text(const FbxNode& node, std::size_t number) {
  const std::string kind = node.is_joint ? "LimbNode" : "Mesh";
  std::string text = "Model: " + std::to_string(node_id(number)) + ", \"Model::" + node.name + "\", \"" +
                     kind +
                     "\" {\nVersion: 232\nProperties70: {\nP: \"RotationActive\", \"bool\", \"\", \"\",1\n";
  text += R"(P: "RotationOrder", "enum", "", "",)" + std::to_string(node.rotation_order) + "\n";
  const auto add = [&](const std::string& key, const Eigen::Vector3d& value, double usual) {
    if (value != Eigen::Vector3d::Constant(usual))
      text += "P: \"" + key + R"(", "Vector3D", "Vector", "",)" + listed(value) + "\n";
  };
  add("PreRotation", node.pre_rotation, 0);
  add("PostRotation", node.post_rotation, 0);
  add("RotationOffset", node.rotation_offset, 0);
  add("RotationPivot", node.rotation_pivot, 0);
  add("ScalingOffset", node.scaling_offset, 0);
  add("ScalingPivot", node.scaling_pivot, 0);
  add("GeometricTranslation", node.geometric_translation, 0);
  add("GeometricRotation", node.geometric_rotation, 0);
  add("GeometricScaling", node.geometric_scale, 1);
  add("Lcl Translation", node.translation, 0);
  add("Lcl Rotation", node.rotation, 0);
  add("Lcl Scaling", node.scale, 1);
  return text + "}\n}\n";
}

/// The curves of one property of a node. Their ids begin at `id`.
std::string curves_text(const std::string& property, const FbxNode::Keys& keys, std::size_t node,
                        std::size_t id, std::string& connections) {
  if (!keys) return "";
  std::string text = "AnimationCurveNode: " + std::to_string(id) + R"(, "AnimCurveNode::)" +
                     property.substr(4, 1) + "\", \"\" {\n}\n";
  connections += connection(id, 301) + connection(id, node_id(node), property);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const std::size_t curve = id + 1 + static_cast<std::size_t>(axis);
    text += "AnimationCurve: " + std::to_string(curve) + ", \"AnimCurve::\", \"\" {\nKeyVer: 4008\n" +
            array_text("KeyTime", 2, "0,46186158000") +
            array_text("KeyValueFloat", 2, listed(Eigen::Vector2d(keys->first[axis], keys->second[axis]))) +
            array_text("KeyAttrFlags", 1, "4") + array_text("KeyAttrDataFloat", 4, "0,0,0,0") +
            array_text("KeyAttrRefCount", 1, "2") + "}\n";
    connections += connection(curve, id, std::string("d|") + static_cast<char>('X' + axis));
  }
  return text;
}

const std::string head = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
FBXHeaderVersion: 1003
FBXVersion: 7400
}
Objects:  {
Geometry: 100, "Geometry::g", "Mesh" {
)";

const std::string clip = R"(AnimationStack: 300, "AnimStack::Take", "" {
Properties70: {
P: "LocalStop", "KTime", "Time", "",46186158000
}
}
AnimationLayer: 301, "AnimLayer::Base", "" {
}
)";

}  // namespace

const std::vector<Eigen::Vector3d>& FbxFile::vertices() {
  static const std::vector<Eigen::Vector3d> tetrahedron = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}};
  return tetrahedron;
}

std::string FbxFile::text() const {
  Eigen::Matrix<double, 3, 4> corners;
  for (Eigen::Index i = 0; i < 4; ++i) corners.col(i) = vertices()[static_cast<std::size_t>(i)];
  std::string text = head + array_text("Vertices", 12, listed(corners)) +
                     array_text("PolygonVertexIndex", 12, "0,1,-3,0,3,-2,1,3,-3,0,2,-4") +
                     "GeometryVersion: 124\n}\n" + clip;
  std::string connections = connection(301, 300);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const FbxNode& node = nodes[i];
    text += node_text(node, i);
    connections +=
        connection(node_id(i), node.parent < 0 ? 0 : node_id(static_cast<std::size_t>(node.parent)));
    if (i == mesh_node()) connections += connection(100, node_id(i));
    text += curves_text("Lcl Translation", node.translation_keys, i, 10000 + 100 * i, connections);
    text += curves_text("Lcl Rotation", node.rotation_keys, i, 10020 + 100 * i, connections);
    text += curves_text("Lcl Scaling", node.scale_keys, i, 10040 + 100 * i, connections);
  }
  text += skin_text(connections);
  return text + "}\nConnections:  {\n" + connections + "}\n";
}

std::string FbxFile::skin_text(std::string& connections) const {
  if (weights.empty()) return "";
  std::string text = "Deformer: 500, \"Deformer::skin\", \"Skin\" {\nVersion: 101\n}\n";
  connections += connection(500, 100);
  const std::size_t mesh = mesh_node();
  std::size_t joint = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].is_joint) continue;
    const Eigen::Affine3d link = global(i, std::nullopt);
    const std::size_t id = 501 + joint;
    text += "Deformer: " + std::to_string(id) + ", \"SubDeformer::c\", \"Cluster\" {\nVersion: 100\n" +
            array_text("Indexes", 4, "0,1,2,3") + array_text("Weights", 4, listed(weights[joint])) +
            array_text("Transform", 16, listed((link.inverse() * global(mesh, std::nullopt)).matrix())) +
            array_text("TransformLink", 16, listed(link.matrix())) + "}\n";
    connections += connection(id, 500) + connection(node_id(i), id);
    ++joint;
  }
  return text;
}

std::size_t FbxFile::mesh_node() const {
  std::size_t node = 0;
  while (nodes[node].is_joint) ++node;
  return node;
}

Eigen::Affine3d FbxFile::global(std::size_t node, std::optional<int> key) const {
  const Eigen::Affine3d own = local(nodes[node], key);
  return nodes[node].parent < 0 ? own : global(static_cast<std::size_t>(nodes[node].parent), key) * own;
}

std::vector<Eigen::Vector3d> FbxFile::expected(std::optional<int> key) const {
  const std::size_t mesh = mesh_node();
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t vertex = 0; vertex < 4; ++vertex) {
    const Eigen::Vector3d point = geometric(nodes[mesh]) * vertices()[vertex];
    if (weights.empty()) {
      positions.emplace_back(global(mesh, key) * point);
      continue;
    }
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    std::size_t joint = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].is_joint)
        sum += weights[joint++][static_cast<Eigen::Index>(vertex)] *
               (global(i, key) * global(i, std::nullopt).inverse() * global(mesh, std::nullopt) * point);
    positions.push_back(sum);
  }
  return positions;
}

}  // namespace graze::tests
