#pragma once

#include <Eigen/Core>
#include <bit>
#include <compare>
#include <cstdint>

namespace graze {

/// @addtogroup report
/// @{

/// The kinds of features of a mesh. The value of each is the dimension of the feature.
enum class FeatureKind : std::uint8_t {
  vertex,  ///< A vertex, of dimension 0.
  edge,    ///< An edge, of dimension 1.
  face,    ///< A triangle or a quad, of dimension 2.
};

/// Names one vertex, edge or face of a mesh.
struct Feature {
  /// Whether it is a vertex, an edge or a face.
  FeatureKind kind = FeatureKind::vertex;
  /// The index of the feature in its mesh: a vertex or face index of the caller's, or an index for
  /// Mesh::edge().
  std::uint32_t index = 0;

  /// Compares by kind, then by index.
  friend auto operator<=>(const Feature&, const Feature&) = default;
};

/// The six kinds of contact. The kind says in whose relative interiors the two closest points lie. The
/// feature of lower dimension comes first, and may belong to either object. A fold is the inner diagonal of a
/// quad that is not flat.
///
/// A point that several features share is named by the lowest dimension, then by the lowest index. So a
/// vertex over the edge between two faces is one VE contact, and not two VF contacts.
enum class ContactKind : std::uint8_t {
  VV,  ///< Two vertices.
  VE,  ///< A vertex and an edge.
  VF,  ///< A vertex and a face.
  EE,  ///< Two edges.
  EF,  ///< An edge that pierces a face, is parallel to one, or is closest to a quad at its fold.
  FF,  ///< Two faces that are parallel, or that are closest at the fold of a quad.
};

/// Says on which side of a surface a point lies, by the angle-weighted normal at the feature.
enum class Side : std::uint8_t {
  none,   ///< Double arithmetic cannot be sure of the sign, or there is no normal.
  front,  ///< The point lies on the side to which the normal points.
  back,   ///< The point lies on the other side.
};

/// Says of a pair with a solid whether one object is inside the other. A vertex is inside a solid where the
/// solid's winding number about it is not 0, which is decided exactly. On the surface it is not inside. Only
/// what pierces depends on groups of faces that are ignored: an edge and a face that are not tested
/// against each other do not count.
enum class Inside : std::uint8_t {
  none,      ///< No vertex of one is inside the other's solid, and nothing pierces. Or neither is a solid.
  a_in_b,    ///< All vertices of a are inside b, and nothing pierces.
  b_in_a,    ///< All vertices of b are inside a, and nothing pierces.
  crossing,  ///< An edge of one pierces a face of the other, or some vertices are inside and others are not.
};

/// Selects what a step says about each pair in contact. More details may be added, so do not rely on there
/// being only these.
enum class ContactDetail : std::uint8_t {
  /// Distances and phases only. Distances are between surfaces.
  none,
  /// One contact for each pair in contact: the closest one, of any of the six kinds. Exact ties go to the
  /// smallest kind, feature a, feature b. Distances are between surfaces.
  closest,
  /// The paper's answer: for each pair of leaf regions below the threshold, its closest pair of vertices.
  /// Ties go to the lowest vertex of a, then of b. Distances are between vertices.
  regions,
  /// Every pair of vertices below the threshold. Distances are between vertices.
  vertices,
  /// Every vertex-face and edge-edge pair below the threshold, named by its closest features, and every edge
  /// that pierces a face. Each pair of features is listed once. Distances are between surfaces.
  features,
  /// The closest point on the other surface of each vertex that is nearer to it than the threshold. Exact
  /// ties go to the smallest kind, then feature. Every pair of edges of `features` that is locally closest,
  /// or
  /// that bounds a patch, is listed too, and every edge that pierces a face. Where none of these is below the
  /// threshold or pierces, but the fold of a quad is, the nearest such contact of `features` is listed. There
  /// are fewer contacts than in `features`, and enough to push objects apart. Distances are between surfaces.
  ///
  /// Two edges are locally closest if, on no face beside either of them, the way from the closest point,
  /// square to the edge, leads nearer to the other point. Edges that cross are. Two edges bound a patch if
  /// both are creases of their meshes at rest, and the way between the closest points lies within 10.2° of
  /// the normal cones of both. docs/answers.md has the rules.
  nearest,
};

/// @cond internal
/// Returns whether the separation of two features is negative. `is_behind_a` says whether the point of b lies
/// behind the surface of a, and `is_behind_b` the opposite. `is_sunk` says it of two edges. Each is asked
/// only if the answer needs it.
template <typename IsBehindA, typename IsBehindB, typename IsSunk>
[[nodiscard]] bool has_negative_separation(FeatureKind a, FeatureKind b, const IsBehindA& is_behind_a,
                                           const IsBehindB& is_behind_b, const IsSunk& is_sunk) {
  const bool has_vertex_a = a == FeatureKind::vertex;
  const bool has_vertex_b = b == FeatureKind::vertex;
  if (a == FeatureKind::edge && b == FeatureKind::edge) return is_sunk();
  if (!has_vertex_a && !has_vertex_b) return is_behind_a() && is_behind_b();
  return (has_vertex_b && is_behind_a()) || (has_vertex_a && is_behind_b());
}
/// @endcond

/// One contact between two objects a and b. Points and distances are in the caller's units. Contacts of a
/// pair are sorted by kind, feature a, feature b, and these three are the key of a contact from step to step.
struct Contact {
  /// In whose relative interiors the two points lie.
  ContactKind kind = ContactKind::VV;
  /// The side of the surface of object a on which #point_b lies. It is `none` at distance 0, but for an edge
  /// that pierces a face of a; see push().
  Side side_a = Side::none;
  /// The side of the surface of object b on which #point_a lies.
  Side side_b = Side::none;
  /// Whether two edges are sunk: both sides are Side::back, and one of the two edges pierces a face of the
  /// other object. Both sides alone are `back` where thin things lie on each other. It is false for any other
  /// kind, and at distance 0.
  bool sunk = false;
  /// The feature of object a.
  Feature feature_a;
  /// The feature of object b.
  Feature feature_b;
  /// The closest point on #feature_a.
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  /// The closest point on #feature_b.
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  /// The direction from a to b, of length 1. At distance 0 it depends on the positions only.
  ///
  /// At distance 0 it is the first of these that exists: the face normal of a by its winding, or minus the
  /// face normal of b. For EE it is the cross product of the edges, with the sign that agrees with the
  /// averaged normals of the two vertices of a. Otherwise it is the averaged normal of a, or minus that of b,
  /// or +z. A quad that is not flat has the normal of the triangle that holds the point.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The distance of the two points, as in real arithmetic and then rounded. It may equal the threshold by
  /// rounding. Its absolute error is at most 2^-48 times the size of the two features plus their gap.
  double distance = 0;
  /// FrameReport::frame() of the first report that lists the two features in contact, without a break up to
  /// this one. It is 0 outside the reports of a scene.
  std::uint64_t since = 0;

  /// Returns the #distance with a sign: negative if the contact's vertex lies behind the surface of the other
  /// object, that is, if its side there is Side::back. Of two vertices it is negative if either side is
  /// `back`. Of two edges it is negative if they are #sunk. Of an edge or a face parallel to a face it is
  /// negative if both sides are `back`. An edge that pierces a face has separation 0. Where a side is `none`
  /// at a distance above 0, nothing says that the point lies behind.
  [[nodiscard]] double separation() const { return is_behind() ? -distance : distance; }
  /// Returns the direction, of length 1, along which b is moved relative to a to make separation() grow. It
  /// is #normal, or its opposite if the separation is negative.
  ///
  /// The push of an edge that pierces a face is the normal of the face by its winding if the face is a's, and
  /// its opposite if the face is b's. With ContactDetail::nearest it leads out of a solid, also if that is
  /// wound inside out: the side of the pierced object is `back` then, and turns it.
  [[nodiscard]] Eigen::Vector3d push() const {
    return is_behind() || leads_in() ? Eigen::Vector3d(-normal) : normal;
  }

 private:
  /// At distance 0 nothing is behind, so that no separation is -0.
  [[nodiscard]] bool is_behind() const {
    return !is_at_zero() && has_negative_separation(
                                feature_a.kind, feature_b.kind, [&] { return side_a == Side::back; },
                                [&] { return side_b == Side::back; }, [&] { return sunk; });
  }
  /// Whether the distance is 0, by its bits. Where the caller flushes denormals, a comparison would take a
  /// denormal distance for 0.
  [[nodiscard]] bool is_at_zero() const { return std::bit_cast<std::uint64_t>(distance) << 1U == 0; }
  /// Whether the normal of a face that an edge pierces leads into its solid.
  [[nodiscard]] bool leads_in() const {
    if (!is_at_zero() || kind != ContactKind::EF) return false;
    return (feature_a.kind == FeatureKind::face ? side_a : side_b) == Side::back;
  }
};

/// Bounds of a distance: #lower ≤ true distance ≤ #upper. With Accuracy::exact() they are the true distance,
/// rounded down and up.
struct DistanceBounds {
  /// The distance is not less than this.
  double lower = 0;
  /// The distance is not more than this.
  double upper = 0;
};

/// Two features and a point on each, which show the upper bound of a distance. The points are
/// DistanceBounds::upper apart.
struct Witness {
  /// The feature of object a.
  Feature feature_a;
  /// The feature of object b.
  Feature feature_b;
  /// The point on #feature_a, in the caller's units.
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  /// The point on #feature_b, in the caller's units.
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
};

/// A way out of a pair of objects whose surfaces pass through each other. SceneSettings::ways_out asks for
/// it, and PairReport::way_out has it. Without a way all of it is 0 but #fullness and #point. It is not
/// promised to be the shortest way.
///
/// The contour is where triangles of a and of b cross. It consists of segments p-q, directed along n_a × n_b,
/// where n_a and n_b are the normals of the two triangles. Where surfaces share a plane, crossings within
/// that plane count half on each side of it.
struct WayOut {
  /// The direction, of length 1, along which b leaves a. It is S/|S| with S = ½ Σ p × q over the contour,
  /// taken from #point. If both are solids, −S is the gradient of the volume that they share, by a
  /// translation of b. It is zero if #fullness is below 0.1.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// The middle of the contour, in the caller's units: that of its segments, weighted by their lengths.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// |S| divided by ½ Σ |(p − c) × (q − c)|, where c is #point. It is 1 where the contour is flat and winds
  /// one way, and 0 where it cancels, as that of a stake through a plank. It is 0 if there is no contour.
  double fullness = 0;
  /// The extent along #direction of the contour, of the vertices of a inside b and of those of b inside a. It
  /// is an estimate of the depth. Only vertices inside solids count.
  double thickness = 0;
  /// How far b has to go along #direction until the two are apart for certain: until all of b is beyond all
  /// of a.
  double extent = 0;
};

/// A pair of regions that are near each other. It is one line of the paper's figure 7, between the middle
/// vertices of the two regions. SceneSettings::region_distances asks for these.
struct RegionDistance {
  /// The deeper one of the levels of the two regions. Level 1 is the first level of the paper.
  std::uint32_t level = 0;
  /// The index of the region of object a. Region 0 is the whole mesh.
  std::uint32_t region_a = 0;
  /// The index of the region of object b. Region 0 is the whole mesh.
  std::uint32_t region_b = 0;
  /// The middle vertex of the region of object a: the vertex closest to the average of the region's vertices.
  std::uint32_t vertex_a = 0;
  /// The middle vertex of the region of object b: the vertex closest to the average of the region's vertices.
  std::uint32_t vertex_b = 0;
  /// The position of #vertex_a now, in the caller's units.
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  /// The position of #vertex_b now, in the caller's units.
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  /// The distance of the two points, rounded: δ in equation 4 of the paper.
  double distance = 0;
};

/// @}

}  // namespace graze
