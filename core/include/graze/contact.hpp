#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>

namespace graze {

/// A feature's dimension: vertices 0, edges 1, faces 2.
enum class FeatureKind : std::uint8_t { vertex, edge, face };

/// One vertex, edge or face of a mesh, by the mesh's own number.
struct Feature {
  FeatureKind kind = FeatureKind::vertex;
  std::uint32_t index = 0;

  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// The six kinds of contact: in whose relative interiors the closest points lie, the lower dimension first.
/// `VF` is a vertex of either object and a face of the other.
enum class ContactKind : std::uint8_t { VV, VE, VF, EE, EF, FF };

/// On which side of a surface a point lies, by the angle-weighted normal at the feature. `none`: double
/// arithmetic cannot be sure of the sign, or there is no normal.
enum class Side : std::uint8_t { none, front, back };

/// How much a step says about each pair in contact.
enum class ContactDetail : std::uint8_t {
  none,      ///< distances and phases only
  closest,   ///< the one closest contact, of any of the six kinds
  regions,   ///< for each pair of leaf regions its closest vertex pair (the paper's answer)
  vertices,  ///< every pair of vertices below the threshold
  features,  ///< every vertex-face and edge-edge pair below the threshold, and every edge that pierces a face
};

/// One contact between objects a and b. Points and distance are in the caller's units.
struct Contact {
  ContactKind kind = ContactKind::VV;
  Side side_a = Side::none;  ///< the side of a's surface on which point_b lies
  Side side_b = Side::none;  ///< the side of b's surface on which point_a lies
  Feature feature_a;
  Feature feature_b;
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit length, from a to b
  double distance = 0;
  /// In reports of a scene: frame() of the first report of those, without a break up to this one, that list
  /// the two features in contact.
  std::uint64_t since = 0;
};

/// lower ≤ true distance ≤ upper.
struct DistanceBounds {
  double lower = 0;
  double upper = 0;
};

/// Two features and a point on each that are `DistanceBounds::upper` apart.
struct Witness {
  Feature feature_a;
  Feature feature_b;
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
};

/// A pair of regions that are near each other: one line of the paper's figure 7, between their middle
/// vertices.
struct RegionDistance {
  std::uint32_t level = 0;  ///< the deeper of the regions' levels; 1 is the paper's first
  std::uint32_t region_a = 0;
  std::uint32_t region_b = 0;
  std::uint32_t vertex_a = 0;  ///< the middle vertices
  std::uint32_t vertex_b = 0;
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  double distance = 0;  ///< of the points, rounded: eq. 4's δ
};

}  // namespace graze
