#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/access.hpp"
#include "base/task_pool.hpp"
#include "calls/calls.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// The rows (r0, r1, r2, t) of a matrix.
using Pose = std::array<double, 12>;

/// One object of a scene as the steps see it.
struct Object {
  ObjectId id;
  std::uint64_t serial = 0;  ///< the order in which objects were added; never used again
  ObjectSettings settings;
  std::unique_ptr<Surface> owned_surface;  ///< through the accessors below
  const IndexedMesh* mesh = nullptr;       ///< the surface's
  Box box;                    ///< where it certainly is: what was seen, grown by what was promised since
  Box seen;                   ///< its box when it was looked at last, read or surveyed
  bool has_surface = true;    ///< the surface's positions are those of that look
  std::uint64_t version = 0;  ///< the surface's, after a read

  // What the next read takes up, and what is promised of it.
  std::optional<Pose> pose;
  std::optional<Pose> standing_pose;  ///< the last one that was read or surveyed
  SparePositions::Loan positions;
  Box box_of_positions;                     ///< of those
  SparePositions::Loan standing_positions;  ///< the copy that the surface looks at
  std::optional<PositionView> bound;
  BindPolicy policy = BindPolicy::every_step;
  bool is_notified = false;
  std::uint64_t notified_step = 0;  ///< the last one before which `positions_changed` was called
  bool is_notified_again = false;   ///< it was so before the step before that, too
  bool is_new = false;              ///< given since the last step
  bool may_have_input = false;      ///< it is among those that the store looks at in the next read
  double promise = std::numeric_limits<double>::infinity();
  /// No vertex is further from where it was when the object was looked at last, by the promises since. At
  /// first without a bound: promises speak of where a step saw the object, and none has.
  double promised = std::numeric_limits<double>::infinity();
  /// The sum of the promises since `promised` was last 0, as the caller gave them, for messages.
  double promise_sum = 0;
  bool promises = false;  ///< bound memory of which motion has been promised
  /// There are positions that have not been read, since promises say that they are far from everything, or a
  /// survey does.
  bool unread = false;
  bool wanted = false;  ///< among those that `read_unread` was asked for
  /// What is unread was surveyed: `box` is where that is, and the surface stands where it was read last.
  bool surveyed = false;
  bool stays_unread = false;  ///< it was told nothing since it was surveyed in an earlier step
  bool to_survey = false;     ///< and not read, in the read that is under way
  bool moved = false;         ///< it was elsewhere than before when it was read last, or was bound since
  /// It moved so little, as far as its box tells, that how far it does is worth knowing (SlackOfMotion); not
  /// for some steps after it turned out to have moved further.
  bool is_nearly_static = false;
  std::uint8_t static_cooldown_steps = 0;
  bool tested = false;            ///< in a pair of the last step
  bool asked_for_blocks = false;  ///< by a pair of the last step
  /// No pair of the last step asked for blocks of its vertices, though some looked at it: they have lists.
  bool goes_by_lists = false;
  bool to_block = false;  ///< blocks are made of its vertices as soon as they are read, and in a cache
  bool to_view = false;   ///< in place of being read: it was surveyed
  bool viewed = false;    ///< its surface looks at its bound memory, which after a step may go
  /// What the refit under way counted; of another one where the numbers differ.
  struct Asked {
    std::uint64_t refit = 0;
    std::size_t jobs = 0;  ///< that look at it
    bool walked = false;   ///< one of them went from region to region in the last step
    double shares = 0;     ///< of its box that are near the jobs' other objects, where it is read in parts
  } asked;
  /// Bound memory was bad when last read, or the last pose was not taken: the object stands where it was, and
  /// its pairs are not tested.
  bool frozen = false;

  bool in_parts = false;          ///< it is so large that several tasks read and refit it
  bool removed = false;           ///< it goes before the next read
  std::size_t counted_bytes = 0;  ///< its part of ObjectStore::surface_bytes_

  [[nodiscard]] const Surface& surface() const {
    require_read(StepData::surfaces, this);
    return *owned_surface;
  }
  [[nodiscard]] Surface& surface_to_write() {
    require_write(StepData::surfaces, this);
    return *owned_surface;
  }
};

/// An object that was removed, of which reports may still have something to say.
struct DepartedObject {
  ObjectId id;
  std::uint64_t serial = 0;  ///< Object::serial
};

/// The objects of a scene in the order in which they were added. Stepping thread only.
///
/// A step's work here follows the objects that were told something and the removals, but for one pass
/// over an array of pointers in a step with removals.
class ObjectStore {
 public:
  /// `with_blocks`: nothing is asked of objects but blocks of their vertices, so that these are made as soon
  /// as what is near something is read, and memory that is read in every step is viewed in place of that.
  explicit ObjectStore(bool with_blocks) : with_blocks_(with_blocks) {}

  // A call that throws has changed nothing, itself included.
  void apply(AddObject& call);
  void apply(const RemoveObject& call);
  void apply(const SetPose& call);
  void apply(const RefusePose& call) noexcept;
  void apply(SetPositions& call);
  void apply(const BindPositions& call);
  /// Appends what is wrong with the memory.
  void apply(UnbindPositions& call, std::vector<Diagnostic>& diagnostics);
  void apply(const PositionsChanged& call);
  /// Makes room for that many objects.
  void reserve(std::size_t count);

  /// Brings every object to where it is now, but for those of which promises say about where they are, and
  /// those that were near nothing a step ago. These are surveyed: only their boxes are made, from bound
  /// memory without a copy, of copies and poses without a look at any vertex. So are those that can be
  /// viewed. Several objects at a time; appends what was wrong in the objects' order.
  void read_positions(TaskPool& tasks, std::vector<Diagnostic>& diagnostics);
  /// Reads those of `wanted`, which are unread and there once each.
  void read_unread(std::vector<Object*>& wanted, TaskPool& tasks, std::vector<Diagnostic>& diagnostics);

  /// After a step that came to no end, at any point and also before it began: no promise made before the next
  /// read counts, since its caller may count from positions that no step has seen.
  void forget_promises() noexcept { promises_count_ = false; }
  /// Forgets what steps have remembered of the objects, after one that came to no end at any point. What was
  /// read stays read; the next step reads the rest.
  void forget() noexcept;

  /// Whether anything may be otherwise than the step before saw it: which objects there are, where one is,
  /// and whether it is frozen or unread. After `read_positions`.
  [[nodiscard]] bool changed() const { return changed_; }
  /// Those that are there after `read_positions`; ascending by serial.
  [[nodiscard]] std::span<const std::unique_ptr<Object>> objects() const { return objects_; }
  [[nodiscard]] Object* find(ObjectId id);
  /// The objects removed since `forget_departed`. They are in the order of their ids once `read_positions`
  /// has returned.
  [[nodiscard]] std::span<const DepartedObject> departed() const { return departed_; }
  /// After a report that names the pairs that they ended.
  void forget_departed() noexcept { departed_.clear(); }
  /// How many objects the last reads left unread because of promises.
  [[nodiscard]] std::size_t unread_count() const { return unread_count_; }
  /// How many were surveyed, those that were then read included.
  [[nodiscard]] std::size_t surveyed_count() const { return surveyed_count_; }

  /// Takes up how many bytes an object's surface holds now.
  void count_bytes(Object& object);
  /// Of all objects, with their surfaces as they were counted last.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// Some vertices of a large object.
  struct Part {
    Object* object;
    std::uint32_t begin;
    std::uint32_t count;
    Surface::PartSeen seen;
  };
  struct LargeObject {
    Object* object;
    std::size_t end;  ///< of its parts
    std::optional<Diagnostic> problem = std::nullopt;
    bool accepted = true;
  };

  /// Has the object looked at in the next read.
  void expect_input(Object& object);
  void drop_removed();
  void plan_read(Object& object);
  void mark_new_seen();
  void clear_read_list();
  void list_to_read(Object& object);
  void read_small(std::size_t index);
  void read_listed(TaskPool& tasks, std::vector<Diagnostic>& diagnostics);
  void finish_large(TaskPool& tasks);
  void finish_parts(std::size_t index, std::size_t& to_write);
  void report_problems(std::vector<Diagnostic>& diagnostics);

  bool with_blocks_;
  std::vector<std::unique_ptr<Object>> objects_;  ///< null in the place of one removed, until the next read
  std::vector<std::uint64_t> serials_;            ///< of `objects_`, side by side for the search of one
  std::vector<Object*> by_index_;
  std::vector<std::unique_ptr<Object>> removed_;
  std::vector<DepartedObject> departed_;
  std::vector<Object*> with_input_;  ///< those that may have something to be read, in any order
  std::vector<Object*> to_read_;     ///< small ones
  std::vector<LargeObject> large_;   ///< large ones
  std::vector<Part> parts_;          ///< of `large_`, one after the other
  std::vector<std::optional<Diagnostic>> read_problems_;        ///< of `to_read_`; empty when they were told
  std::vector<std::pair<std::uint64_t, Diagnostic>> problems_;  ///< by serial; likewise
  std::uint64_t next_serial_ = 0;
  std::uint64_t steps_ = 0;         ///< that have read positions
  std::uint64_t first_unseen_ = 0;  ///< the serial of the first object that no step has seen
  std::size_t surface_bytes_ = 0;
  std::size_t unread_count_ = 0;
  std::size_t surveyed_count_ = 0;
  std::atomic<bool> some_problems_ = false;  ///< were not told yet
  std::atomic<bool> changed_ = false;
  bool promises_count_ = true;
  bool will_have_changed_ = false;  ///< at the next `read_positions`, whatever that sees
};

}  // namespace graze
