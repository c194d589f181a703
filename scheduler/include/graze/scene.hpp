#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <graze/task_scheduler.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>

namespace graze {

/// @cond internal
class Recorder;
class Replay;
/// @endcond

/// @addtogroup scene
/// @{

/// Says of a call that moves objects that they jump: what lies between is not passed. Objects that are
/// ObjectSettings::swept, and what they are tested with, then sweep nothing in the next step. They count as
/// standing at their new place for the whole step, also if further calls before the step move them.
struct Teleport {};

/// What is given to calls that move an object by a jump.
inline constexpr Teleport teleport{};

/// Holds n objects and answers for all n(n-1)/2 pairs between them. Each step reads where the vertices are
/// now. It publishes a report that says which pairs are near, how near they are, and where they touch.
///
/// @par Threads
/// Every call but step(), step_async() and wait() may come from any thread at any time. The next step takes
/// the calls up in the order in which they were made. One thread at a time may step. Only wait() waits for
/// another thread, except that bindings, unbindings, replaced meshes and the beginning of a step wait for
/// each other for a short time.
///
/// @par Errors
/// Constructors, add(), replace_mesh(), step() and step_async() throw Error, and wait() throws what went
/// wrong in step_async(). No other call throws Error: the next report has a Diagnostic that says what was
/// wrong.
///
/// @par Without memory
/// Constructors, add(), replace_mesh(), reserve(), object_settings(), name() and steps throw
/// `std::bad_alloc`. After add(), replace_mesh() and reserve() the scene is as before. After a step the last
/// report stays the latest one, and no call is lost. The next step begins afresh from where the objects are.
/// All other calls never throw. If there is no memory for such a call, the next report has a Diagnostic of
/// kind DiagnosticKind::out_of_memory. A call that ends a binding ends it in any case. docs/embedding.md has
/// the details.
///
/// @par When memory is taken
/// add(), replace_mesh(), set_rule(), object_settings() and name() with a long name, and calls that leave a
/// Diagnostic always take memory. Other calls take memory only if more calls wait for a step than ever
/// before, or than were reserved. In addition, set_positions() and unbind_positions() take memory for an
/// object's first copies, and beyond four copies that wait. A step takes memory if it needs more than any
/// step before it, and more than was reserved.
///
/// @par Calls for many objects
/// A call with spans means the same as one call for each object, in the order of `objects`. No call of
/// another thread comes in between, and one step takes up all of them. Such a call costs less for each
/// object. If the spans have different sizes, nothing is taken, and a Diagnostic without an object says so.
class GRAZE_API Scene {
 public:
  /// Stands for no promise: vertices may have moved any distance.
  static constexpr double any_displacement = std::numeric_limits<double>::infinity();

  /// @name Making a scene
  /// @{

  /// Makes a scene without objects. Its steps run their tasks with `scheduler`, which the scene keeps. If
  /// that is null, they run with oneTBB, or on one thread if graze was built without.
  ///
  /// Throws Error if a distance is negative or NaN, if `contact_distance` is infinite, if a value is no
  /// enumerator, if the time budget is negative, or if a limit of contacts is 0. Also throws Error for paper
  /// accuracy with a detail other than `regions` and `vertices`.
  explicit Scene(const SceneSettings& settings = {}, std::shared_ptr<TaskScheduler> scheduler = nullptr);
  /// Waits for the end of a step that is running, and frees the scene. Reports that handles keep stay valid.
  ~Scene();
  /// Scenes are not copied.
  Scene(const Scene&) = delete;
  /// Scenes are not copied.
  Scene& operator=(const Scene&) = delete;
  /// Takes everything of the other scene, which may then only be destroyed or assigned to.
  Scene(Scene&&) noexcept;
  /// Frees this scene and takes everything of the other one, which may then only be destroyed or assigned to.
  Scene& operator=(Scene&&) noexcept;

  /// Returns the settings that the scene was made with.
  [[nodiscard]] const SceneSettings& settings() const;

  /// @}

  /// @name Objects
  /// @{

  /// Adds an object, which stands at the rest shape of its mesh until a call moves it. Any number of objects
  /// and scenes may share one mesh.
  ///
  /// Throws Error if `mesh` is null, if the margin is negative or not finite, if the kind is above 255, or if
  /// the motion is no enumerator. Also throws Error if a solid's surface is not closed, or if the settings
  /// have groups of faces, but not one for each face.
  ObjectId add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings = {});
  /// Gives an object another mesh under the same id, as a cut or a finer grid needs it. Calls made afterwards
  /// are about the new mesh. A binding of the old positions ends as with unbind_positions().
  ///
  /// A deformable object stands at the rest positions of the new mesh until a call moves it, even if bad
  /// positions had frozen it. A rigid or fixed one keeps its pose. If that was refused, its pairs stay
  /// `stale` until a good pose comes. Pairs of other objects go on as if nothing had happened.
  ///
  /// `new_of_old` holds for each vertex of the present mesh the vertex of the new mesh that it has become, or
  /// Mesh::no_vertex. Any number of old vertices may become one. The phases of the object's pairs go on. A
  /// contact keeps Contact::since if both its features survive. A feature survives if the new mesh has a
  /// feature of the same kind with exactly the vertices to which its vertices are mapped. If a mesh is
  /// replaced several times before a step, the maps count one after the other.
  ///
  /// `face_groups` holds the group of each face of the new mesh. If it is empty, all faces are in group 0.
  ///
  /// Throws Error if `mesh` is null, or if the object is a solid and the mesh is not closed. Also throws
  /// Error if `new_of_old` has not one entry for each vertex of the present mesh, or if an entry is neither a
  /// vertex of the new mesh nor Mesh::no_vertex. Also throws Error if `face_groups` is neither empty nor has
  /// one entry for each face. The scene is as before then. A stale id is a Diagnostic.
  void replace_mesh(ObjectId object, std::shared_ptr<const Mesh> mesh,
                    std::span<const std::uint32_t> new_of_old,
                    std::span<const std::uint8_t> face_groups = {});
  /// Removes an object and ends its binding. A pair of it that was in contact is listed once more as `ended`.
  /// The id stays valid as a key in that row, and is never given again.
  void remove(ObjectId object);
  /// Returns how many objects the scene has, by all calls made so far.
  [[nodiscard]] std::size_t object_count() const;
  /// Returns whether an id names an object of the scene, by all calls made so far.
  [[nodiscard]] bool contains(ObjectId object) const;
  /// Returns the mesh that an object has by all calls made so far, or null if the id names no object.
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(ObjectId object) const;
  /// Returns the settings that an object was added with, or default settings if the id names no object.
  /// Groups of faces are copied too, so it takes time and memory for each face. For the name take name().
  [[nodiscard]] ObjectSettings object_settings(ObjectId object) const;
  /// Returns a copy of the name that an object was added with. It is empty if the id names no object.
  [[nodiscard]] std::string name(ObjectId object) const;

  /// @}

  /// @name Moving rigid and fixed objects
  /// @{

  /// Places a rigid or fixed object. A rest vertex (x, y, z) goes to `((r0*x + r1*y) + r2*z) + t`, computed
  /// in double without fused operations. Here r0, r1 and r2 are the columns of the rotation R, and t is the
  /// translation.
  ///
  /// The pose is taken if no entry of RᵀR - I is larger than 1e-3 and R does not mirror, so float rotations
  /// of an engine are taken. It is used as it stands, without being made a rotation. Otherwise the next
  /// report has a Diagnostic of kind `bad_pose`, and the pairs of the object are `stale` until a good pose
  /// comes.
  void set_pose(ObjectId object, const Eigen::Isometry3d& pose) { set_pose_rows(object, rows_of(pose)); }
  /// Places a rigid or fixed object by a jump, as Teleport says.
  void set_pose(ObjectId object, const Eigen::Isometry3d& pose, Teleport jump) {
    set_pose_rows(object, rows_of(pose), jump);
  }
  /// Places a rigid or fixed object by a transform of floats or doubles, such as `Eigen::Isometry3f` or
  /// `Eigen::Affine3d`. Floats are converted to double and used as they stand. The checks are those of the
  /// first form.
  template <typename Scalar, int mode, int options>
  requires(mode != Eigen::Projective) void set_pose(ObjectId object,
                                                    const Eigen::Transform<Scalar, 3, mode, options>& pose) {
    set_pose_rows(object, rows_of(pose));
  }
  /// Places a rigid or fixed object by a transform of floats or doubles and a jump, as Teleport says.
  template <typename Scalar, int mode, int options>
  requires(mode != Eigen::Projective) void set_pose(ObjectId object,
                                                    const Eigen::Transform<Scalar, 3, mode, options>& pose,
                                                    Teleport jump) {
    set_pose_rows(object, rows_of(pose), jump);
  }
  /// Places a rigid or fixed object by a 4 x 4 matrix of floats or doubles. The matrix is for column vectors:
  /// the translation is its last column. The 16 floats of an engine are a
  /// `Eigen::Map<const Eigen::Matrix4f>`.
  ///
  /// The checks are those of the first form. The pose is also refused if an entry of the last row is further
  /// than 1e-6 from (0, 0, 0, 1), as in a transposed matrix or a projection.
  template <typename Matrix>
  requires(int(Matrix::RowsAtCompileTime) == 4 &&
           int(Matrix::ColsAtCompileTime) == 4) void set_pose(ObjectId object,
                                                              const Eigen::MatrixBase<Matrix>& pose) {
    const Eigen::Matrix<typename Matrix::Scalar, 4, 4> values = pose;
    std::array<double, 16> rows;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        rows[static_cast<std::size_t>(row * 4 + column)] = exactly_as_double(values(row, column));
    set_pose_matrix(object, rows);
  }
  /// Places a rigid or fixed object by the upper three rows of its 4 x 4 matrix, row by row. The checks are
  /// those of set_pose().
  void set_pose_rows(ObjectId object, const std::array<double, 12>& rows);
  /// Places a rigid or fixed object by a jump, as Teleport says.
  void set_pose_rows(ObjectId object, const std::array<double, 12>& rows, Teleport jump);
  /// Places a rigid or fixed object by all four rows of its 4 x 4 matrix, row by row. The checks are those of
  /// set_pose() for matrices.
  void set_pose_matrix(ObjectId object, const std::array<double, 16>& rows);
  /// Places many rigid or fixed objects. Both spans have the same size.
  void set_poses(std::span<const ObjectId> objects, std::span<const Eigen::Isometry3d> poses) {
    static_assert(sizeof(Eigen::Isometry3d) == 16 * sizeof(double));
    set_pose_matrices(objects, {poses.empty() ? nullptr : poses[0].data(), 16 * poses.size()});
  }
  /// Places many rigid or fixed objects by jumps, as Teleport says. Both spans have the same size.
  void set_poses(std::span<const ObjectId> objects, std::span<const Eigen::Isometry3d> poses, Teleport jump) {
    set_pose_matrices(objects, {poses.empty() ? nullptr : poses[0].data(), 16 * poses.size()}, jump);
  }

  /// @}

  /// @name Moving deformable objects
  /// @{

  /// Copies the positions of a deformable object, one for each vertex of its mesh. The later one of this call
  /// and bind_positions() counts.
  ///
  /// `max_displacement` promises how far any vertex is at most from where the last step saw it. With a
  /// promise graze may skip reading an object that is certainly far from everything. A broken promise is a
  /// Diagnostic.
  ///
  /// A coordinate is at most 2^120 in size. If a vertex that a face uses is beyond that or not finite, the
  /// old positions stand, and a Diagnostic says so.
  void set_positions(ObjectId object, PositionView positions, double max_displacement = any_displacement);
  /// Copies the positions of many deformable objects, with one promise for all. Both spans have the same
  /// size.
  void set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                     double max_displacement = any_displacement);
  /// Copies the positions of a deformable object that jumps there, as Teleport says.
  void set_positions(ObjectId object, PositionView positions, Teleport jump);
  /// Copies the positions of many deformable objects that jump there, as Teleport says. Both spans have the
  /// same size.
  void set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                     Teleport jump);

  /// Lets steps read the positions of a deformable object from the caller's memory, until it is unbound. The
  /// call copies nothing. The later one of this call and set_positions() counts.
  ///
  /// The memory must stay valid, and may be written between steps only. With BindPolicy::every_step every
  /// step reads it. With BindPolicy::when_told the next step reads it, and then only steps after
  /// positions_changed().
  ///
  /// A coordinate is at most 2^120 in size. If a vertex that a face uses is beyond that or not finite, the
  /// object is frozen: its listed pairs repeat their last values as `stale`. A Diagnostic repeats until good
  /// positions are read.
  void bind_positions(ObjectId object, PositionView positions, BindPolicy policy = BindPolicy::every_step);
  /// Does not compile: steps would read the memory of a vector or a matrix that ends with the call.
  template <TemporaryPoints Points>
  void bind_positions(ObjectId object, Points&& positions,
                      BindPolicy policy = BindPolicy::every_step) = delete;
  /// Binds many deformable objects to memory. Both spans have the same size.
  void bind_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                      BindPolicy policy = BindPolicy::every_step);
  /// Ends a binding. The caller may free the memory when the call returns. If a step is running then, the
  /// memory must stay until that step ends, for which wait() waits. The same holds for remove(),
  /// set_positions() and a new binding.
  ///
  /// With BindPolicy::every_step the call copies the memory a last time, and the object stays there. If the
  /// memory is bad then, the object is frozen until it is given good positions. With BindPolicy::when_told
  /// the copy counts if no step has begun since the binding, if positions_changed() told of the memory and no
  /// step has read it since, or if steps only surveyed the object. Otherwise the object stays where it was.
  void unbind_positions(ObjectId object);
  /// Tells the scene that the caller has written bound memory. `max_displacement` promises how far any vertex
  /// is at most from where the last step saw it. A broken promise is a Diagnostic.
  ///
  /// A later step may read the memory as well, when another object comes near. So leave it unchanged until
  /// the next call.
  void positions_changed(ObjectId object, double max_displacement = any_displacement);
  /// Tells the scene that the caller has written bound memory, and that the object jumps there, as Teleport
  /// says.
  void positions_changed(ObjectId object, Teleport jump);
  /// Tells the scene that the caller has written the bound memory of many objects, and that they jump there,
  /// as Teleport says.
  void positions_changed(std::span<const ObjectId> objects, Teleport jump);
  /// Tells the scene that the caller has written the bound memory of many objects, with one promise for all.
  void positions_changed(std::span<const ObjectId> objects, double max_displacement = any_displacement);
  /// Tells the scene that the caller has written the bound memory of many objects, with a promise for each.
  /// Both spans have the same size.
  void positions_changed(std::span<const ObjectId> objects, std::span<const double> max_displacements);

  /// @}

  /// @name Pairs
  /// @{

  /// Takes one pair out, until watch() puts it back. A pair that was in contact is listed once more as
  /// `ended`. The order of the two objects does not matter.
  void ignore(ObjectId a, ObjectId b);
  /// Puts a pair back that ignore() took out. The order of the two objects does not matter.
  void watch(ObjectId a, ObjectId b);
  /// Takes faces of `group_a` of `a` and faces of `group_b` of `b` out: they are not tested against each
  /// other, until watch() puts them back. ObjectSettings::face_groups says which faces are in a group. A
  /// group may have no faces.
  ///
  /// A vertex, an edge or a face of one object is then tested with those faces of the other that at least
  /// one of its own faces may be tested with. Distances, witnesses, contacts and piercing are those of the
  /// rest. If nothing is left to be tested, the pair is treated as one that ignore() took out whole.
  /// Region distances (SceneSettings::region_distances) do not follow groups.
  ///
  /// This is for surfaces that are joined: give the faces at a seam a group, and ignore the groups of both
  /// sides. `a` and `b` may be one object, for ObjectSettings::self. The order of its two groups does not
  /// matter. Calls about groups and calls about whole pairs do not undo each other. Any thread may call it.
  void ignore(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b);
  /// Puts faces back that ignore() took out by the same two groups. Any thread may call it.
  void watch(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b);

  /// Gives thresholds to every pair of an object of `kind_a` and one of `kind_b`, in either order. They
  /// replace the scene's own. Kinds are 0 to 255, see ObjectSettings::kind.
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);

  /// @}

  /// @name Memory
  /// @{

  /// Makes room ahead of time, so that calls and steps within it take no memory from the allocator. Even the
  /// first contacts then take none. The call makes room for calls at once, and the next step for everything
  /// else. Throws `std::bad_alloc`.
  ///
  /// Three things still take memory: pairs of two surfaces of 4,096 vertices or more, more than 4,096 pairs
  /// of objects that one task of the broad phase finds, and diagnostics.
  void reserve(const SceneCapacity& capacity);

  /// @}

  /// @name Stepping and reports
  /// @{

  /// Runs one step: takes up the calls made since the last one, reads positions, and publishes a report.
  /// `tag` is any number of the caller's, which the report carries.
  ///
  /// Throws Error if another step of this scene is running, or if handles hold 65,536 reports. Throws
  /// `std::bad_alloc` without memory.
  ReportHandle step(std::uint64_t tag = 0);
  /// Begins a step on another thread and returns. The step takes up the calls made until now. Calls made
  /// while it runs are for the step after it. Bound memory must not change until wait() has returned.
  ///
  /// Throws Error if a step is running, and `std::bad_alloc` if the step cannot begin. Also throws what
  /// TaskScheduler::start() throws. A scheduler without threads runs the step before this returns.
  void step_async(std::uint64_t tag = 0);
  /// Returns whether a step is running.
  [[nodiscard]] bool is_stepping() const;
  /// Waits until no step is running, and returns the latest report. If the last step_async() went wrong, it
  /// throws what step() would have thrown. One thread at a time may call it.
  ReportHandle wait();
  /// Returns the last published report. Before the first step it is an empty report of frame 0. The call is
  /// wait-free.
  [[nodiscard]] ReportHandle latest_report() const;

  /// @}

 private:
  /// Returns the upper three rows of a transform. It is inline because what Eigen aligns depends on the
  /// compiler flags of the caller.
  template <typename Transform>
  static std::array<double, 12> rows_of(const Transform& pose) {
    std::array<double, 12> rows;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        rows[static_cast<std::size_t>(row * 4 + column)] = exactly_as_double(pose.matrix()(row, column));
    return rows;
  }
  /// Takes 16 numbers for each object: its 4 x 4 matrix, column by column.
  void set_pose_matrices(std::span<const ObjectId> objects, std::span<const double> matrices);
  void set_pose_matrices(std::span<const ObjectId> objects, std::span<const double> matrices, Teleport jump);

  friend class Recorder;
  friend class Replay;
  class State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze
