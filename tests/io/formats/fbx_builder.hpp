#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace graze::tests {

/// A node of an FBX file with all that its transform is made of. Angles are in degrees.
struct FbxNode {
  using Keys = std::optional<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;  ///< at 0 and at 1 second

  std::string name;
  int parent = -1;
  bool is_joint = false;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  int rotation_order = 0;  ///< XYZ, XZY, YZX, YXZ, ZXY, ZYX
  Eigen::Vector3d pre_rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d post_rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling_offset = Eigen::Vector3d::Zero();
  Eigen::Vector3d scaling_pivot = Eigen::Vector3d::Zero();
  Eigen::Vector3d geometric_translation = Eigen::Vector3d::Zero();
  Eigen::Vector3d geometric_rotation = Eigen::Vector3d::Zero();
  Eigen::Vector3d geometric_scale = Eigen::Vector3d::Ones();
  Keys translation_keys, rotation_keys, scale_keys;
};

/// Nodes, parents before children, and the mesh of the first node that is no joint: a tetrahedron.
struct FbxFile {
  std::vector<FbxNode> nodes;
  /// For each joint, the weights of the four vertices. Empty: the mesh has no skin.
  std::vector<Eigen::Vector4d> weights;

  static const std::vector<Eigen::Vector3d>& vertices();
  /// The file, as text.
  [[nodiscard]] std::string text() const;
  /// Where the FBX SDK's formula puts the mesh: at rest without a key, otherwise at key 0 or 1.
  [[nodiscard]] std::vector<Eigen::Vector3d> expected(std::optional<int> key) const;

 private:
  [[nodiscard]] std::size_t mesh_node() const;
  [[nodiscard]] Eigen::Affine3d global(std::size_t node, std::optional<int> key) const;
  [[nodiscard]] std::string skin_text(std::string& connections) const;
};

}  // namespace graze::tests
