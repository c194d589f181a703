#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/task_pool.hpp"
#include "calls/calls.hpp"
#include "objects/object.hpp"
#include "objects/object_bytes.hpp"
#include "objects/position_reads.hpp"
#include "objects/swept_objects.hpp"

namespace graze {

/// A removed object that a report may still have to mention.
struct DepartedObject {
  ObjectId id;
  std::uint64_t serial = 0;  ///< Object::serial
};

/// The objects of a scene in the order of addition. Stepping thread only.
///
/// A step's work here is proportional to the number of objects that received calls, and of removals. A step
/// with removals also makes one pass over an array of pointers.
class ObjectStore {
 public:
  /// `with_blocks` says that jobs only need blocks of vertices. The store then makes blocks as soon as it
  /// reads an object near others, and views memory that is bound for every step instead of copying it.
  explicit ObjectStore(bool with_blocks) : reads_(with_blocks, swept_, bytes_) {}

  // A call of these that throws has changed nothing, and its argument is unchanged too.
  void apply(AddObject& call);
  void apply(ReplaceMesh& call);
  void apply(const RemoveObject& call);
  void apply(const SetPose& call);
  void apply(const RefusePose& call) noexcept;
  void apply(const SettlePose& call);
  void apply(SetPositions& call);
  void apply(const BindPositions& call);
  /// Appends a diagnostic if the bound memory is bad.
  void apply(UnbindPositions& call, std::vector<Diagnostic>& diagnostics);
  void apply(const PositionsChanged& call);
  void apply(const MarkTeleport& call);
  /// Takes up the layers and masks of objects that are swept elsewhere, and returns whether that lets more
  /// objects be in swept pairs. They are read in the next step.
  bool take_up_sweep(const ObjectSettings& settings);
  /// Reserves memory for that many objects.
  void reserve(std::size_t count);
  /// Reserves memory for the ways of all objects that may be in swept pairs, also of those that come later.
  void reserve_sweeps();

  /// Reads the current positions of all objects with input. Two kinds of objects are not read. An object that
  /// promises keep far from everything stays unread. An object that no pair of the last step tested, or that
  /// can be viewed, is surveyed: only its box is computed. A survey copies no bound memory, and reads no
  /// vertex of copies and poses. Objects are processed in parallel. Appends diagnostics in the order of the
  /// objects. `observer`, if there is one, stays until the
  /// next call. It sees each object whose bound memory was found new, here and in `read_unread`.
  void read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics, MemoryObserver* observer);
  /// Reads the objects in `wanted`, which are unread, listed once each and planned to be read.
  void read_unread(std::span<Object* const> wanted, TaskPool& tasks, std::vector<Diagnostic>& diagnostics);

  /// Reads objects to which a GhostSource has given a pose or positions. Each is listed once.
  void read_ghosts(std::span<Object* const> ghosts, TaskPool& tasks, std::vector<Diagnostic>& diagnostics);
  /// Sorts in the objects that came since `read_positions`, and drops those that went.
  void sort_ghosts() {
    sort_in_inserted();
    drop_removed();
  }

  /// Ignores all promises made before the next read. Call it after a step that failed at any point, even
  /// before it began, since the caller may count from positions that no step has seen.
  void forget_promises() noexcept { promises_count_ = false; }
  /// Forgets what steps have remembered of the objects. Call it after a step that failed at any point.
  /// Positions that were read stay read, and the next step reads the rest.
  void forget() noexcept;

  /// Whether anything may differ from the step before: the set of objects, the position of one, or whether it
  /// is frozen or unread. Valid after `read_positions`.
  [[nodiscard]] bool changed() const { return reads_.changed(); }
  /// The objects that exist after `read_positions`, ascending by serial.
  [[nodiscard]] std::span<const std::unique_ptr<Object>> objects() const { return objects_; }
  [[nodiscard]] Object* find(ObjectId id) const;
  /// Whether the positions of the call are wanted, or why they are bad. Otherwise the object stays where it
  /// is.
  [[nodiscard]] bool wants(const UnbindPositions& call) const;
  /// Whether the positions of the call are of a mesh that was replaced since. They change nothing.
  [[nodiscard]] bool is_outdated(const SetPositions& call) const;
  /// The serial of the next object that is added.
  [[nodiscard]] std::uint64_t next_serial() const { return next_serial_; }
  /// The arrival of the next object that is added.
  [[nodiscard]] std::uint64_t next_arrival() const { return next_arrival_; }
  /// A number that grows whenever objects come or go: how many did either.
  [[nodiscard]] std::uint64_t arrivals_and_departures() const { return 2 * next_arrival_ - objects_.size(); }
  /// How many objects have come before others that were there.
  [[nodiscard]] std::uint64_t insertions() const { return insertions_; }
  /// Calls `visit(object)` with each object whose arrival is at least `arrival`. Valid after
  /// `read_positions`.
  template <typename Visit>
  void visit_arrived(std::uint64_t arrival, const Visit& visit) const {
    // Where none was inserted, they are the last.
    for (auto object = objects_.rbegin();
         object != objects_.rend() && (insertions_ > 0 || (*object)->arrival >= arrival); ++object)
      if ((*object)->arrival >= arrival) visit(**object);
  }
  /// The object of a serial, or null.
  [[nodiscard]] const Object* find_serial(std::uint64_t serial) const;
  /// Whether a step has seen the object at a place of its own, with the mesh that it has.
  [[nodiscard]] bool was_seen(const Object& object) const {
    return !is_new(object) && object.replaced == nullptr && !object.is_unplaced;
  }
  /// The objects removed since `forget_departed`, sorted by id once `read_positions` has returned.
  [[nodiscard]] std::span<const DepartedObject> departed() const { return departed_; }
  /// Forgets the removed objects. Call it when a report has named the pairs that their removal ended.
  void forget_departed() noexcept { departed_.clear(); }
  /// Whether the mesh of an object was replaced since `forget_replaced`. Valid after `read_positions`.
  [[nodiscard]] bool some_replaced() const { return !replaced_.empty(); }
  /// The objects whose mesh was replaced since then.
  [[nodiscard]] std::span<Object* const> replaced() const { return replaced_; }
  /// Forgets the replaced meshes. Call it when a report speaks of the new ones.
  void forget_replaced() noexcept;
  /// How objects move that may be in swept pairs. Valid after `read_positions`.
  [[nodiscard]] const SweptObjects& swept() const { return swept_; }
  /// How many objects the last reads left unread because of promises.
  [[nodiscard]] std::size_t unread_count() const { return reads_.unread_count(); }
  /// How many objects were surveyed, including those that were read afterwards.
  [[nodiscard]] std::size_t surveyed_count() const { return reads_.surveyed_count(); }

  /// The bytes that surfaces hold.
  [[nodiscard]] ObjectBytes& bytes() { return bytes_; }
  /// The bytes of all objects, with each surface as it was counted last.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void make_sweep(Object& object, const IndexedMesh& mesh) const;
  [[nodiscard]] bool is_new(const Object& object) const { return object.arrival >= first_unseen_; }
  void sort_in_inserted();
  void drop_removed();
  void mark_new_seen();
  [[nodiscard]] ReadsOfStep reads_of_step() const;

  SweptObjects swept_;
  ObjectBytes bytes_;
  PositionReads reads_;
  bool sweeps_are_reserved_ = false;
  bool last_failed_ = false;            ///< no report speaks of what the last read has found
  MemoryObserver* observer_ = nullptr;  ///< of the current step
  std::vector<std::unique_ptr<Object>>
      objects_;                         ///< null in the slot of a removed object until the next read
  std::vector<std::uint64_t> serials_;  ///< of `objects_`, in one array for binary search
  std::vector<Object*> by_index_;
  std::vector<std::unique_ptr<Object>> removed_;
  std::vector<DepartedObject> departed_;
  std::vector<Object*> replaced_;                  ///< objects with another mesh since the last report
  std::vector<std::unique_ptr<Object>> inserted_;  ///< that come amid `objects_` before the next read
  std::uint64_t next_serial_ = 0;
  std::uint64_t next_arrival_ = 0;
  std::uint64_t insertions_ = 0;
  std::uint64_t steps_ = 0;         ///< the number of steps that have read positions
  std::uint64_t first_unseen_ = 0;  ///< the arrival of the first object that no step has seen
  bool promises_count_ = true;
  bool will_have_changed_ = false;  ///< `changed` holds at the next `read_positions`, whatever it reads
};

}  // namespace graze
