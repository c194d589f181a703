#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <graze/cluster/settings.hpp>
#include <graze/cluster/transport.hpp>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/scene.hpp>
#include <graze/settings.hpp>
#include <graze/task_scheduler.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace graze::cluster {

/// @addtogroup cluster
/// @{

/// The answer of one step for one rank. It never changes, and depends on no scene.
using Report = std::shared_ptr<const FrameReport>;

/// A scene whose objects belong to several ranks, which are processes of one machine or of many. Each rank
/// has a Scene of this kind, calls it for its own objects, and gets the rows of its own objects.
/// docs/cluster.md says how it works.
///
/// @par The same answers
/// All ranks together have the rows of one graze::Scene, to which the same objects are added in the order of
/// their numbers. With Accuracy::exact() and Accuracy::paper() they are the same bit for bit. With
/// Accuracy::within() bounds may differ, and the true distance lies between either two.
///
/// @par Which rank calls
/// Calls about an object count at the rank that owns it, and are passed over at all other ranks. So a program
/// may make each call at the owner alone, or at every rank alike. Every rank that owns one of two objects
/// calls ignore() and watch() about them. Every rank calls set_rule(), step() and gather().
///
/// @par Threads
/// Calls but step(), gather() and the destructor may come from any thread, and not while a step runs. A call
/// about an object takes up a lock for a short time.
///
/// @par Errors
/// As those of graze::Scene. In addition step() and gather() throw Error if ranks have different settings or
/// do not step together, if two ranks own objects of one number near each other, or as Transport says. The
/// other ranks are told, and the scene may only be destroyed then. They are not told what other calls throw.
///
/// @par What it does not offer
/// Time and work budgets, SceneSettings::max_contacts and SceneSettings::region_distances, since they are
/// shared by all pairs. ObjectSettings::queries, ObjectSettings::patch_radius, and FrameReport::mesh(). Steps
/// on another thread, reports from any thread, and calls for many objects at once. What a promise of
/// `max_displacement` saves.
class GRAZE_API Scene {
 public:
  /// Makes a scene without objects. All ranks give the same settings, but for threads. The transport belongs
  /// to this scene alone as long as it lives.
  ///
  /// Throws Error as graze::Scene does, and if the settings ask for what a cluster does not offer, or if the
  /// transport is null.
  Scene(const SceneSettings& settings, std::shared_ptr<Transport> transport,
        const ClusterSettings& cluster = {}, std::shared_ptr<TaskScheduler> scheduler = nullptr);
  /// Frees the scene. Reports stay valid.
  ~Scene();
  /// Scenes are not copied.
  Scene(const Scene&) = delete;
  /// Scenes are not copied.
  Scene& operator=(const Scene&) = delete;

  /// The number of this rank, from 0.
  [[nodiscard]] int rank() const;
  /// How many ranks there are.
  [[nodiscard]] int size() const;

  /// @name Objects
  /// @{

  /// Adds an object that this rank owns. `number` is its place in the order of all objects of all ranks, and
  /// no other object ever has it. Rows name the object of the lower number first.
  ///
  /// Throws Error as graze::Scene::add() does, if the settings ask for what a cluster does not offer, or if
  /// this rank has an object of that number.
  ObjectId add(std::uint32_t number, std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings = {});
  /// The id of the object of a number, at every rank.
  [[nodiscard]] static ObjectId id_of(std::uint32_t number) { return {number, 1}; }
  /// Gives an object another mesh, as graze::Scene::replace_mesh() does.
  void replace_mesh(ObjectId object, std::shared_ptr<const Mesh> mesh,
                    std::span<const std::uint32_t> new_of_old,
                    std::span<const std::uint8_t> face_groups = {});
  /// Removes an object. Its number is never used again.
  void remove(ObjectId object);
  /// Returns whether this rank owns an object, by the calls made so far.
  [[nodiscard]] bool owns(ObjectId object) const;
  /// Returns the ids of all objects that this rank owns, ascending.
  [[nodiscard]] std::vector<ObjectId> owned() const;
  /// Returns the mesh of an object that this rank owns, or null.
  [[nodiscard]] std::shared_ptr<const Mesh> mesh(ObjectId object) const;
  /// Returns the settings of an object that this rank owns, or default settings.
  [[nodiscard]] ObjectSettings object_settings(ObjectId object) const;

  /// @}

  /// @name Moving objects
  /// As the functions of graze::Scene of the same names.
  /// @{

  /// Places a rigid or fixed object.
  void set_pose(ObjectId object, const Eigen::Isometry3d& pose) {
    // Inline, because what Eigen aligns depends on the compiler flags of the caller.
    std::array<double, 12> rows;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        rows[static_cast<std::size_t>(4 * row + column)] = pose.matrix()(row, column);
    set_pose_rows(object, rows);
  }
  /// Places a rigid or fixed object by the upper three rows of its matrix.
  void set_pose_rows(ObjectId object, const std::array<double, 12>& rows);
  /// Places a rigid or fixed object by a jump.
  void set_pose_rows(ObjectId object, const std::array<double, 12>& rows, Teleport jump);
  /// Places a rigid or fixed object by all four rows of its matrix.
  void set_pose_matrix(ObjectId object, const std::array<double, 16>& rows);
  /// Copies the positions of a deformable object.
  void set_positions(ObjectId object, PositionView positions);
  /// Copies the positions of a deformable object that jumps there.
  void set_positions(ObjectId object, PositionView positions, Teleport jump);
  /// Lets steps read the positions of a deformable object from the caller's memory. The binding ends where
  /// the object moves to another rank.
  void bind_positions(ObjectId object, PositionView positions, BindPolicy policy = BindPolicy::every_step);
  /// Ends a binding.
  void unbind_positions(ObjectId object);
  /// Tells the scene that the caller has written bound memory.
  void positions_changed(ObjectId object);
  /// Tells the scene that the caller has written bound memory, and that the object jumps there.
  void positions_changed(ObjectId object, Teleport jump);

  /// @}

  /// @name Pairs
  /// As the functions of graze::Scene of the same names.
  /// @{

  /// Takes one pair out, until watch() puts it back.
  void ignore(ObjectId a, ObjectId b);
  /// Puts a pair back.
  void watch(ObjectId a, ObjectId b);
  /// Takes faces of one group of `a` and of one group of `b` out.
  void ignore(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b);
  /// Puts faces back.
  void watch(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b);
  /// Gives thresholds to pairs of two kinds. Every rank calls it.
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);

  /// @}

  /// Makes room ahead of time, as graze::Scene::reserve() does, for the objects and ghosts of this rank.
  void reserve(const SceneCapacity& capacity);

  /// @name Steps
  /// @{

  /// Runs one step together with all other ranks. Returns a report of the rows of all pairs of which this
  /// rank owns an object, and of its own diagnostics. Objects have their ids of the cluster.
  ///
  /// The statistics of the report count its rows and contacts. Times, work and bytes are those of this rank.
  Report step(std::uint64_t tag = 0);
  /// Returns at rank 0 a report of all rows and diagnostics of all ranks in the last step, in order, and null
  /// elsewhere. All ranks call it.
  [[nodiscard]] Report gather();
  /// Returns what the last step has cost.
  [[nodiscard]] const ClusterStatistics& statistics() const;
  /// Returns the objects that have come to this rank after the last step, ascending. From now on this rank
  /// calls for them. Those that were bound to memory stand where they were, until they are bound again.
  [[nodiscard]] std::span<const ObjectId> arrived() const;
  /// Returns the objects that have gone to other ranks after the last step, ascending.
  [[nodiscard]] std::span<const ObjectId> departed() const;

  /// @}

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze::cluster
