#pragma once

#include <graze/contact.hpp>
#include <graze/contact_geometry.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>

namespace graze {

/// @addtogroup response
/// @{

/// Says where a contact of a report has gone. follow() computes it.
struct FollowedContact {
  /// The feature of a that has ContactGeometry::point_a inside it now.
  Feature feature_a;
  /// The feature of b that has ContactGeometry::point_b inside it now.
  Feature feature_b;
  /// The points, directions and separation of the two features. If #is_known is false, these are what
  /// evaluate() says of the contact.
  ContactGeometry geometry;
  /// Whether a report about these positions would say this, as far as the triangles around the contact can
  /// tell. follow() says exactly when it is true.
  bool is_known = false;
  /// How often one of the features changed on the way from those of the contact.
  unsigned steps = 0;
};

/// Finds where a contact of a report is at other positions than those of the report. It goes over to other
/// features where these are nearer by now. A program does so between two steps. evaluate() would stay with
/// the features of the report.
///
/// A contact with a vertex keeps its vertex. The call walks over the other surface, from face to face around
/// the closest point. It ends where no triangle around the point is nearer. These are the triangles that
/// share a vertex with the vertex, edge or triangle that has the point inside it. Of two vertices that of a
/// is kept, and follow_vertex_of_b() keeps the other one.
///
/// Two edges stay as they are if ContactDetail::nearest would list them at these positions. Otherwise, if
/// their separation is above 0, the call walks over both surfaces until the two points are locally closest.
/// So the answer may be a contact with a vertex. An edge that pierced a face moves on to a face around it.
///
/// The separation is the distance with a sign. The sign is that of the report, continued over all features on
/// the way. So the separation passes through 0 without a jump when a vertex goes through a surface. The push
/// is the direction of the two points or its opposite. The sides are those of the report, each turned round
/// if the sign has changed. Of two vertices the side of the one that is kept gives the sign.
///
/// `is_known` is true of a contact with a vertex if the walk came to its end, and if the normals give a
/// side of the surface where it began and where it ended. If the sign has changed, no point of the walk may
/// have been on a border. A border here is an edge that does not join two faces wound the same way. If the
/// report has two vertices and the walk left the other one, the kept one has to be in front of the surface.
///
/// It is true of two edges that are apart if `nearest` would list them. It is also true if the walk came to
/// its end, but not at the fold of a quad. No call asks whether they are sunk by now because one of them
/// pierces a face. It is true of two edges with a negative separation if both are creases and lie in each
/// other's normal cones, as `nearest` asks for. It is true of an edge that pierced a face if it pierces that
/// face, or another one that shares a vertex with it.
///
/// It is false for all others: for an edge or a face that is closest to a face at a distance, and after 32
/// steps of a vertex or 8 of two edges. Then the answer is that of evaluate().
///
/// For a contact of one surface with itself, give its mesh and positions twice. The rings that a report
/// leaves out are not known here. A walk that comes to the vertex itself is not known.
///
/// The call knows nothing of surfaces beyond the triangles around the contact. Another part of a folded
/// surface may be nearer, and new contacts are in no report. The closest point is that of the whole surface
/// if the surface is convex, seen from outside, or bends little within the distance.
///
/// `contact` is from a report about the two meshes, a and b as there. The call computes in double, in any
/// floating-point mode of the caller. It takes no memory, but for the first call for a mesh for which no step
/// has needed its neighbours. Any thread may make it. The positions have to be finite: with others the answer
/// means nothing. Throws Error if a mesh has no such feature, if the number of positions is not its number of
/// vertices, or if they are null memory.
GRAZE_API FollowedContact follow(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                                 PositionView positions_b, const Contact& contact);

/// Finds where a contact is as follow() does, but of two vertices it keeps that of b. A contact of two
/// vertices may stand for both, and they part when the surfaces move. So ask both functions for such a
/// contact. For any other contact the answer is that of follow(). Memory, threads and errors are as there.
GRAZE_API FollowedContact follow_vertex_of_b(const Mesh& mesh_a, PositionView positions_a, const Mesh& mesh_b,
                                             PositionView positions_b, const Contact& contact);

/// @}

}  // namespace graze
