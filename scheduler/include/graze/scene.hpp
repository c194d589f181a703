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
#include <limits>
#include <memory>
#include <span>

namespace graze {

/// n objects and the n(n-1)/2 pairs between them. Each `step` reads where the vertices are now and publishes
/// which pairs are near, how near, and every contact.
///
/// Threads: every call but `step` may come from any thread at any time and is taken up by the next step, in
/// the order in which the calls were made; `step` runs on one thread at a time. No call but `wait` waits for
/// another thread, other than binding, unbinding and the beginning of a step for each other. After
/// construction only `add` and `step` throw Error; what is wrong with any other call is a Diagnostic in the
/// next report.
///
/// Without memory `add`, `reserve`, `object_settings` and steps throw std::bad_alloc. After `add` and
/// `reserve` the scene is as before. After a step the last report is still the latest, calls are taken up by
/// it or by the next one, and the next one begins afresh from where the objects are. Other calls never throw:
/// one for which there is no memory leaves a Diagnostic `out_of_memory`, and ends a binding all the same
/// (docs/embedding.md).
///
/// Memory: `add`, `set_rule`, `object_settings` and what makes a Diagnostic allocate. The other calls do
/// where more of them wait for a step than ever did or were reserved, and `set_positions` and
/// `unbind_positions` for the first copies of an object, and for each beyond four that wait at once. A step
/// takes memory where it needs more than any before and than was reserved.
///
/// Forms for many objects mean the same as one call after the other in the order of `objects`; no other
/// thread's calls come in between, and one step takes up all of them. Each object costs less than by a call
/// of its own. Where the spans do not fit together nothing is taken, and a Diagnostic names no object.
class GRAZE_API Scene {
 public:
  /// No promise: a vertex may have moved anywhere.
  static constexpr double any_displacement = std::numeric_limits<double>::infinity();

  /// Throws Error for a threshold that is negative or NaN, a number that is no enumerator, or paper accuracy
  /// with a detail other than `regions` and `vertices`.
  explicit Scene(const SceneSettings& settings = {});
  ~Scene();
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  Scene(Scene&&) noexcept;
  Scene& operator=(Scene&&) noexcept;

  [[nodiscard]] const SceneSettings& settings() const;

  /// Adds an object at its mesh's rest shape. Throws Error for no mesh, a margin that is negative or not
  /// finite, or a kind above 255.
  ObjectId add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings = {});
  void remove(ObjectId object);
  /// Objects added and not removed, by all calls made so far.
  [[nodiscard]] std::size_t object_count() const;
  [[nodiscard]] bool contains(ObjectId object) const;
  /// The mesh and settings an object was added with; null and defaults for an id that names none.
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(ObjectId object) const;
  [[nodiscard]] ObjectSettings object_settings(ObjectId object) const;

  /// Places a rigid or fixed object: vertex = ((r0·x + r1·y) + r2·z) + t of its rest vertex (x, y, z), in
  /// double.
  void set_pose(ObjectId object, const Eigen::Isometry3d& pose) { set_pose_rows(object, rows_of(pose)); }
  /// Places it by a transform of either precision, such as Eigen::Isometry3f or Affine3d. Floats are
  /// converted to double and used as they stand.
  template <typename Scalar, int mode, int options>
  requires(mode != Eigen::Projective) void set_pose(ObjectId object,
                                                    const Eigen::Transform<Scalar, 3, mode, options>& pose) {
    set_pose_rows(object, rows_of(pose));
  }
  /// Places it by a 4x4 matrix of either precision, for column vectors: the translation is its last column.
  /// An engine's 16 numbers can be given as `Eigen::Map<const Eigen::Matrix4f>`. Where an entry of the last
  /// row is further than 1e-6 from (0, 0, 0, 1) the pose is not taken, and a Diagnostic `bad_pose` says so.
  template <typename Matrix>
  requires(int(Matrix::RowsAtCompileTime) == 4 &&
           int(Matrix::ColsAtCompileTime) == 4) void set_pose(ObjectId object,
                                                              const Eigen::MatrixBase<Matrix>& pose) {
    const Eigen::Matrix<typename Matrix::Scalar, 4, 4> values = pose;
    std::array<double, 16> rows;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        rows[static_cast<std::size_t>(row * 4 + column)] = static_cast<double>(values(row, column));
    set_pose_matrix(object, rows);
  }
  /// Places it by the upper three rows of the 4x4 matrix, row by row.
  void set_pose_rows(ObjectId object, const std::array<double, 12>& rows);
  /// Places it by all four rows of the 4x4 matrix, row by row. The last one is checked as above.
  void set_pose_matrix(ObjectId object, const std::array<double, 16>& rows);
  /// A pose for each object.
  void set_poses(std::span<const ObjectId> objects, std::span<const Eigen::Isometry3d> poses) {
    static_assert(sizeof(Eigen::Isometry3d) == 16 * sizeof(double));
    set_pose_matrices(objects, {poses.empty() ? nullptr : poses[0].data(), 16 * poses.size()});
  }

  /// Copies the positions of a deformable object, one for each vertex of its mesh. `max_displacement`
  /// promises how far any vertex is at most from where the last step saw it.
  void set_positions(ObjectId object, PositionView positions, double max_displacement = any_displacement);

  void set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                     double max_displacement = any_displacement);

  /// Reads a deformable object's positions from the caller's memory, without a copy, until it is unbound.
  /// Coordinates are at most 2^120 (docs/embedding.md); where a used vertex is beyond or not finite the
  /// object is frozen. The memory may be written between steps only. With BindPolicy::when_told it is read in
  /// the next step and then after `positions_changed`.
  void bind_positions(ObjectId object, PositionView positions, BindPolicy policy = BindPolicy::every_step);
  void bind_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                      BindPolicy policy = BindPolicy::every_step);
  /// Ends a binding. The memory is free when the call returns, or at the end of a step that is running
  /// meanwhile, for which `wait` waits; so it is where an object is bound anew, removed, or given positions.
  /// Memory that is read in every step is copied a last time, in the call, and the object stays there; bad
  /// memory freezes it until it is given good positions. Memory that is read when told is only copied if no
  /// step has begun since it was bound, else the object stays where that was read last.
  void unbind_positions(ObjectId object);
  /// Bound memory has been written: no vertex is further than `max_displacement` from where the last step saw
  /// it.
  void positions_changed(ObjectId object, double max_displacement = any_displacement);

  void positions_changed(std::span<const ObjectId> objects, double max_displacement = any_displacement);
  void positions_changed(std::span<const ObjectId> objects, std::span<const double> max_displacements);

  /// Takes one pair out, and puts it back.
  void ignore(ObjectId a, ObjectId b);
  void watch(ObjectId a, ObjectId b);

  /// Thresholds for every pair of an object of `kind_a` and one of `kind_b`, in either order.
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);

  /// Makes room ahead of time: for calls at once, for all else in the next step. Calls and steps that need no
  /// more than that take no memory from the allocator, the first contacts included. Three things still do:
  /// pairs of two surfaces of 4,096 vertices or more, more than 4,096 pairs of objects about one place, and
  /// diagnostics.
  void reserve(const SceneCapacity& capacity);

  /// One step: takes up the calls made since the last, and publishes a report. Throws Error when another step
  /// of this scene is running, or when 65,536 reports are held by handles; std::bad_alloc without memory.
  /// The report carries `tag`, any number of the caller's.
  ReportHandle step(std::uint64_t tag = 0);
  /// Begins a step on another thread and returns; it takes up the calls made until now. Throws Error when a
  /// step is running, and std::bad_alloc where it cannot begin. Calls made meanwhile are for the step after;
  /// bound memory stays as it is until `wait` has returned.
  void step_async(std::uint64_t tag = 0);
  /// Whether a step is running.
  [[nodiscard]] bool is_stepping() const;
  /// Waits for the end of the step that is running, if one is, and returns `latest_report`. Throws what went
  /// wrong in the last step_async, as `step` does. From one thread at a time. Memory that was unbound before
  /// is free when it returns.
  ReportHandle wait();
  /// The last published report; of frame 0 and empty before the first step. Wait-free.
  [[nodiscard]] ReportHandle latest_report() const;

 private:
  /// The upper three rows of a transform. Unpacked here, since what Eigen aligns depends on compiler flags.
  template <typename Transform>
  static std::array<double, 12> rows_of(const Transform& pose) {
    std::array<double, 12> rows;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        rows[static_cast<std::size_t>(row * 4 + column)] = static_cast<double>(pose.matrix()(row, column));
    return rows;
  }
  /// 16 numbers for each object: its 4x4 matrix, column by column.
  void set_pose_matrices(std::span<const ObjectId> objects, std::span<const double> matrices);

  class State;
  std::unique_ptr<State> state_;
};

}  // namespace graze
