#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>

namespace graze {

/// @addtogroup response
/// @{

/// Says which vertices of a mesh carry a point of its surface, and how much of it each carries. A solver
/// shares a force at the point out to the vertices by these weights.
struct SurfaceWeights {
  /// How many of the vertices count: 1 for a vertex, 2 for an edge, 3 or 4 for a face.
  int count = 0;
  /// The vertices of the feature. Those of a face are in the order of its corners.
  std::array<std::uint32_t, 4> vertex{};
  /// The weight of each vertex. Weights are at least 0, and their sum is 1 but for rounding.
  std::array<double, 4> weight{};
};

/// Returns the weights of the vertices of `feature` that give `point`. If the point is not on the feature,
/// they give a point of the feature near it. A quad is shared out by the triangle that holds the point, so
/// that one of its four weights is 0.
///
/// `positions` are those of the vertices of `mesh`, and the point is in the same units. The call computes in
/// double and takes no memory. Any thread may make it. Throws Error if the mesh has no such feature, if the
/// number of positions is not its number of vertices, or if they are null memory.
GRAZE_API SurfaceWeights weights(const Mesh& mesh, PositionView positions, const Feature& feature,
                                 const Eigen::Vector3d& point);

/// Says whether a direction is within 10.2° of the normal cone of a feature: whether the surface about the
/// feature stays behind it, seen along the direction. The sine of that angle squared is 1/32.
///
/// A contact of a vertex or an edge bears only along such a direction. A floor of cells that a box slides
/// over has vertices in front of the box. With ContactDetail::nearest each of them has a contact with the
/// front of the box, for that is what is nearest to it. Its push would stop the box. So a solver asks for a
/// vertex or an edge of a with Contact::push(), and for one of b with the opposite. It leaves the contact out
/// if the answer is no. A contact with a face inside it needs no question: it is square to the face.
///
/// For a vertex the call tests all edges from it. For an edge it tests the triangles beside it, square to the
/// edge. One triangle of a face has to be square to the direction or its opposite. The direction may have any
/// length but 0, where the answer means nothing. It is in the frame of the positions. For a rigid body turn
/// the direction into the frame of its mesh, and give the rest positions.
///
/// The call computes in double, in any floating-point mode of the caller. Memory, threads and errors are as
/// with evaluate(). It takes time in proportion to the number of edges at the vertex.
GRAZE_API bool in_normal_cone(const Mesh& mesh, PositionView positions, const Feature& feature,
                              const Eigen::Vector3d& direction);

/// Says where two features are at positions of the caller's. evaluate() computes it.
struct ContactGeometry {
  /// The closest point on the feature of a.
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  /// The closest point on the feature of b.
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  /// The direction from #point_a to #point_b, of length 1. At distance 0 it is chosen as for
  /// Contact::normal.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The direction, of length 1, along which b is moved relative to a to make the separation grow. Where both
  /// points are inside their features it is #normal or its opposite.
  Eigen::Vector3d push = Eigen::Vector3d::Zero();
  /// The distance of the two points.
  double distance = 0;
  /// The gap of the two points with a sign, negative where b has to move along #push to come to distance 0.
  double separation = 0;
  /// The side of the surface of a on which #point_b lies, as Contact::side_a. It is `none` at distance 0.
  Side side_a = Side::none;
  /// The side of the surface of b on which #point_a lies.
  Side side_b = Side::none;
  /// Whether the features are two edges with a negative separation, as Contact::sunk.
  bool sunk = false;
  /// Whether both points lie inside their features, as those of a contact do. If not, another pair of
  /// features may be nearer by now.
  bool is_interior = false;
};

/// Computes where two features of two meshes are at positions of the caller's. They may be any two features.
/// For the contacts of a report take the form with a Contact.
///
/// The positions are those of the vertices of each mesh. The points are the closest ones of the two features.
/// An edge that pierces a face has distance 0. Whether it does is decided exactly, as for a report: not at
/// the border of the face. Where an edge or a face is closest to the inner diagonal of a quad, these are the
/// points, although others may be nearer.
///
/// The separation is the distance with a sign, as Contact::separation() gives it, and the push follows
/// Contact::push(). Sides go by the normals of the two features at these positions. A report takes the
/// winding number for the vertices of a solid with ContactDetail::nearest. So signs may differ where a solid
/// is wound inside out or passes through itself.
///
/// Two edges that are each behind the other's surface are sunk if one of them pierces a face of the other
/// mesh. For these alone the call looks at all faces of both meshes, until it finds one. docs/answers.md says
/// how long that takes. Groups of faces that are ignored or hidden count like any others.
///
/// The rest is computed in double, so the sign of a separation near 0 is that of rounded numbers. The
/// caller's floating-point mode makes no difference. The call takes no memory, but for the first call for
/// edges or vertices of a mesh for which no step has needed their neighbours. Any thread may make it. The
/// positions of the features have to be finite: with others the answer means nothing. Throws Error if a mesh
/// has no such feature, if the number of positions is not its number of vertices, or if they are null memory.
GRAZE_API ContactGeometry evaluate(const Mesh& mesh_a, PositionView positions_a, const Feature& feature_a,
                                   const Mesh& mesh_b, PositionView positions_b, const Feature& feature_b);

/// Computes where a contact of a report is at other positions than those of the report. A program does so
/// between two steps, or in a line search.
///
/// The points, the normal and the distance are those of the two features, as the other form gives them. The
/// sign is that of the report, continued. The push is the direction of the two features that makes an angle
/// of at most 90 degrees with Contact::push() of `contact`. The direction is the cross product of two edges,
/// the normal of a face for a vertex or an edge, and ContactGeometry::normal otherwise. The separation is
/// the gap from point_a to point_b along the push. So it passes through 0 without a jump when the features
/// move through each other. At the positions of the report it is Contact::separation(). It also follows what
/// the report knows of solids by the winding number, and no face is searched.
///
/// The sides are those of the report, each turned round if the separation has changed its sign. Where the
/// report has distance 0 they are `none`. Where a face or two edges are closest at a border, the separation
/// is still that of the plane of the face, or of the lines of the edges. Its size is less than the distance
/// then, and `is_interior` is false. Edges that are parallel by now have no cross product: their direction is
/// ContactGeometry::normal.
///
/// `contact` is from a report about the two meshes, a and b as there. Memory, threads and errors are as with
/// the other form.
GRAZE_API ContactGeometry evaluate(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                                   PositionView positions_b, const Contact& contact);

/// @}

}  // namespace graze
