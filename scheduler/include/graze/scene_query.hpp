#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>

namespace graze {

/// @addtogroup report
/// @{

/// Says which objects a query is about. The rule is that of pairs of objects. An object counts if its layer
/// has a bit of #collides_with, and #layer has a bit of the object's mask.
struct QueryFilter {
  /// A set of bits: the layers that the query is in. All bits are set by default.
  std::uint32_t layer = ~std::uint32_t{0};
  /// A set of bits: the layers of the objects that count. All bits are set by default.
  std::uint32_t collides_with = ~std::uint32_t{0};
  /// An object that does not count, such as the one that asks. A default id leaves out none.
  ObjectId ignored = {};
};

/// A point that a ray and a surface share.
struct RayHit {
  /// The object of the surface.
  ObjectId object;
  /// How far along the ray the point lies, in lengths of the ray's direction. It is the true number,
  /// correctly rounded.
  double t = 0;
  /// origin + t · direction, in double arithmetic.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// The unit normal of the triangle that was hit, by its winding. It is 0 for a triangle without area.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The vertex, edge or face in whose inside the point lies. The diagonal of a quad is inside its face.
  Feature feature;
  /// The lowest face that the ray meets there.
  std::uint32_t face = 0;
  /// The triangle of that face: 0 for its first three corners, 1 for the corners 0, 2 and 3 of a quad.
  std::uint8_t triangle = 0;
};

/// The first time at which a moving sphere touches an object: its centre is at most its radius away.
struct SphereHit {
  /// The object that is touched.
  ObjectId object;
  /// How far along its way the centre is then: 0 at the start, 1 at the end. It is never later than the true
  /// time. It is 0 if the sphere touches at the start.
  double t = 0;
  /// The centre of the sphere at #t.
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  /// The point of the object that is closest to #centre.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// The unit vector from #point to #centre. At distance 0 it is a normal of the surface.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The vertex, edge or face in whose inside #point lies.
  Feature feature;
};

/// The point of an object that is closest to a given point.
struct ClosestPoint {
  /// The object.
  ObjectId object;
  /// The distance of the two points. Its error is that of Contact::distance.
  double distance = 0;
  /// The closest point of the object.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// The unit vector from #point to the given point. At distance 0 it is a normal of the surface.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// The vertex, edge or face in whose inside #point lies.
  Feature feature;
  /// On which side of the surface the given point lies.
  Side side = Side::none;
};

/// A mesh that SceneQuery tries at one pose after the other. It is no object of a scene. One thread at a time
/// may use it.
class GRAZE_API MeshProbe {
 public:
  /// Takes a mesh at its rest shape. With `solid` what is inside of it counts as well, and it is inside of
  /// nothing. Throws Error if the mesh is null, or if that of a solid is not closed.
  explicit MeshProbe(std::shared_ptr<const Mesh> mesh, bool solid = false);
  ~MeshProbe();  ///< Lets go of the mesh.
  /// Takes what `other` holds. `other` must not be used any more.
  MeshProbe(MeshProbe&& other) noexcept;
  /// Takes what `other` holds. `other` must not be used any more.
  MeshProbe& operator=(MeshProbe&& other) noexcept;

  /// Poses the rest shape, with the arithmetic of Scene::set_pose(). Throws Error if the matrix is no
  /// rotation within 1e-3, or not finite.
  void set_pose(const Eigen::Isometry3d& pose);
  /// Gives each vertex a position. Throws Error if there are not as many positions as vertices, or if one
  /// that a face uses is not finite or beyond 2^120.
  void set_positions(PositionView positions);

 private:
  friend class SceneQuery;
  struct State;
  std::unique_ptr<State> state_;
};

/// Asks about the surfaces of one report: rays, moving spheres, closest points, free places and boxes.
///
/// A query sees the objects with ObjectSettings::queries, at the positions that the report is about. So all
/// queries of one report agree with each other and with its contacts, while the scene goes on. Faces in
/// ObjectSettings::hidden_groups are not there. Margins, rules of kinds, groups of objects and ignored pairs
/// do not count. A quad is its two triangles.
///
/// Answers are exact, as those of a scene: what is hit is decided as in real arithmetic. They have the same
/// bits on every machine and for any number of threads.
///
/// Each thread has a SceneQuery of its own. It waits for nothing. It keeps its working memory, and allocates
/// nothing once it has met the largest mesh. Functions that fill a list write into the caller's memory.
///
/// Functions throw Error if a number is not finite, beyond 2^120, or not in the range that is said.
class GRAZE_API SceneQuery {
 public:
  /// Asks about a report, which the query keeps. With an empty handle there are no objects.
  explicit SceneQuery(ReportHandle report = {});
  ~SceneQuery();  ///< Lets go of the report.
  /// Takes what `other` holds. `other` must not be used any more.
  SceneQuery(SceneQuery&& other) noexcept;
  /// Takes what `other` holds. `other` must not be used any more.
  SceneQuery& operator=(SceneQuery&& other) noexcept;

  /// Asks about another report from now on.
  void set_report(ReportHandle report);
  /// Returns the report that is asked about.
  [[nodiscard]] const ReportHandle& report() const;

  /// Returns the first point that a ray hits, for t from 0 to `limit`. `direction` is not 0, and need not
  /// have unit length. `limit` is 0 or more, and may be infinite. A ray through a common edge or vertex of
  /// two faces hits. A ray in the plane of a triangle hits it where it enters it.
  std::optional<RayHit> cast_ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                 double limit = std::numeric_limits<double>::infinity(),
                                 const QueryFilter& filter = {});
  /// Fills `room` with the first hits of a ray, as many as fit, and returns how many these are. They are
  /// sorted by t, then by the order in which objects were added, then by the kind and index of the feature. A
  /// point that several triangles share is listed once for its vertex or edge.
  std::size_t cast_ray(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double limit,
                       std::span<RayHit> room, const QueryFilter& filter = {});

  /// Returns where a sphere first touches an object, on its straight way from one point to another. `radius`
  /// is 0 or more. Whether it touches is exact, and SphereHit::t is never late. At that time a gap may be
  /// left between the sphere and the object. It is at most 2^-40 of the largest of three lengths: the radius,
  /// the way, and the distance from the start to a corner that is touched.
  std::optional<SphereHit> cast_sphere(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                                       const QueryFilter& filter = {});
  /// Fills `room` with the first objects that the sphere would touch if it went on through them, as many as
  /// fit. Returns how many these are. They are sorted by t, then by the order in which they were added.
  std::size_t cast_sphere(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius,
                          std::span<SphereHit> room, const QueryFilter& filter = {});

  /// Returns the closest point of all objects that is strictly nearer than `limit`, which may be infinite.
  std::optional<ClosestPoint> closest_point(const Eigen::Vector3d& point,
                                            double limit = std::numeric_limits<double>::infinity(),
                                            const QueryFilter& filter = {});
  /// Fills `room` with the closest points of the nearest objects, one for each, as many as fit. Returns how
  /// many these are. They are sorted by distance, then by the order in which objects were added.
  std::size_t closest_points(const Eigen::Vector3d& point, double limit, std::span<ClosestPoint> room,
                             const QueryFilter& filter = {});

  /// Returns whether a mesh would be in contact with no object, if `clearance` were the threshold. That is
  /// what a scene with ContactDetail::features says: no features are strictly nearer, no edge pierces a face,
  /// and nothing is inside a solid. `clearance` is 0 or more.
  bool is_free(MeshProbe& probe, double clearance, const QueryFilter& filter = {});
  /// Fills `room` with the objects that would be in contact, in the order in which they were added, as many
  /// as fit. Returns how many there are.
  std::size_t blocking(MeshProbe& probe, double clearance, std::span<ObjectId> room,
                       const QueryFilter& filter = {});

  /// Fills `room` with the objects of which some face has a point in a box, its border included. They are in
  /// the order in which they were added, as many as fit. Returns how many there are. `min` is at most `max`
  /// along each axis.
  std::size_t objects_in_box(const Eigen::Vector3d& min, const Eigen::Vector3d& max, std::span<ObjectId> room,
                             const QueryFilter& filter = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze
