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

/// Says where two features are at positions of the caller's. evaluate() computes it.
struct ContactGeometry {
  /// The closest point on the feature of a.
  Eigen::Vector3d point_a = Eigen::Vector3d::Zero();
  /// The closest point on the feature of b.
  Eigen::Vector3d point_b = Eigen::Vector3d::Zero();
  /// The direction from #point_a to #point_b, of length 1. At distance 0 it is chosen as for
  /// Contact::normal.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The distance of the two points.
  double distance = 0;
  /// The #distance with a sign, as Contact::separation() gives it. Sides go by the normals of the two
  /// features at these positions. A report takes the winding number for the vertices of a solid with
  /// ContactDetail::nearest. So the signs may differ where a solid is wound inside out or passes through
  /// itself.
  double separation = 0;
  /// Whether both points lie inside their features, as those of a contact do. If not, another pair of
  /// features may be nearer by now.
  bool is_interior = false;
};

/// Computes where the features of a contact are at other positions than those of its report. A program does
/// so between two steps, or in a line search.
///
/// The positions are those of the vertices of each mesh. The features may be any two features of the meshes.
/// The points are the closest ones of the two features. An edge that pierces a face has distance 0. Whether
/// it does is decided exactly, as for a report: not at the border of the face. Where an edge or a face is
/// closest to the inner diagonal of a quad, these are the points, although others may be nearer.
///
/// The rest is computed in double, so the sign of a separation near 0 is that of rounded numbers. The call
/// takes no memory, but for the first call for edges or vertices of a mesh for which no step has needed their
/// neighbours. Any thread may make it. The positions of the features have to be finite: with others the
/// answer means nothing. Throws Error if a mesh has no such feature, if the number of positions is not its
/// number of vertices, or if they are null memory.
GRAZE_API ContactGeometry evaluate(const Mesh& mesh_a, PositionView positions_a, const Feature& feature_a,
                                   const Mesh& mesh_b, PositionView positions_b, const Feature& feature_b);

/// @}

}  // namespace graze
