#pragma once

#include <array>
#include <cassert>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/settings.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/access.hpp"
#include "base/spare_positions.hpp"
#include "core/base/box.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/pair/self_exclusion.hpp"
#include "core/surface/surface.hpp"
#include "core/sweep/swept_surface.hpp"
#include "objects/filter_traits.hpp"

namespace graze {

/// The rows (r0, r1, r2, t) of a matrix.
using Pose = std::array<double, 12>;

/// The plan of a read for one object. Between reads it is `skip`, except that PairTable plans to `read` the
/// unread objects that it wants.
enum class ReadPlan : std::uint8_t {
  skip,
  read,
  read_with_blocks,  ///< blocks of a small object are made after the read, while its vertices are in a cache
  survey,            ///< only its box is computed
  survey_and_view,   ///< it is surveyed, and its surface views the positions if they are good
  view,              ///< its surface views positions that were surveyed
};

[[nodiscard]] constexpr bool is_survey(ReadPlan plan) {
  return plan == ReadPlan::survey || plan == ReadPlan::survey_and_view;
}

/// How an object's surface stands to the input that a step saw last. From `unread` on, the object has
/// positions that its surface lacks.
enum class ReadState : std::uint8_t {
  read,            ///< nothing is left to read
  viewed,          ///< the surface views the bound memory, which may go after a step
  due,             ///< the last step that saw it surveyed it. Newer input is to be read or was bad
  unread,          ///< promises show that the object is far from everything
  surveyed,        ///< the box is that of the new positions, and the surface has those of the last read
  still_surveyed,  ///< an earlier step surveyed it, and no call came since
};

/// The box of an object when a step last read or surveyed it.
struct Seen {
  Box box;
  bool is_in_surface = true;  ///< the surface has the positions that `box` is of
};

/// Memory that an object is bound to.
struct BoundMemory {
  PositionView view;
  BindPolicy policy = BindPolicy::every_step;
  bool is_notified = true;          ///< it was bound or `positions_changed` was called since the last read
  bool is_notified_again = false;   ///< `positions_changed` was called before the step before that, too
  std::uint64_t notified_step = 0;  ///< the last step before which `positions_changed` was called

  void notify(std::uint64_t step) {
    is_notified = true;
    if (notified_step != step) is_notified_again = step > 1 && notified_step == step - 1;
    notified_step = step;
  }
};

/// The promises about the motion of an object.
struct Promises {
  static constexpr double any_distance = std::numeric_limits<double>::infinity();

  /// The promise of the last call with positions since the last step. It is empty if no such call came.
  std::optional<double> next;
  /// The largest distance of any vertex from where the object was last read or surveyed, by the promises
  /// since. It is infinite before the first step, since promises count from where a step saw the object.
  double motion = any_distance;
  /// The sum of the promises since `motion` was last 0, as the caller gave them, for messages.
  double sum = 0;
  bool are_made = false;  ///< the motion of the memory that was bound last has been promised

  /// Whether they bound the motion.
  [[nodiscard]] bool are_bounds() const { return motion < any_distance; }
  /// Adds the promise of this step. Without one, the object may have moved by any distance.
  void add_next() {
    const double promise = next.value_or(any_distance);
    sum = motion == 0 ? promise : sum + promise;
    motion = (motion + promise) * round_up;
    next.reset();
  }
};

/// Whether an object moves so little, judged by its box, that its exact motion is worth knowing
/// (SlackOfMotion). It is not nearly static for some steps after its vertices moved further than its box.
class NearlyStatic {
 public:
  explicit operator bool() const { return holds_; }
  /// Returns whether the object may become nearly static. Counts down its cooldown otherwise.
  [[nodiscard]] bool may_begin() {
    if (cooldown_steps_ == 0) return true;
    --cooldown_steps_;
    return false;
  }
  void set(bool holds) {
    assert(!holds || cooldown_steps_ == 0);
    holds_ = holds;
  }
  void begin_cooldown() {
    holds_ = false;
    cooldown_steps_ = cooldown;
  }

 private:
  static constexpr std::uint8_t cooldown = 16;

  bool holds_ = false;
  std::uint8_t cooldown_steps_ = 0;
};

/// The most that a pair of the last step asked of an object.
enum class Demand : std::uint8_t {
  nothing,  ///< none tested it
  test,     ///< some tested it, and none needed blocks of its vertices, since they have lists
  blocks,   ///< some tested it and needed blocks of its vertices
};

/// The mesh by which the last report knows an object, if it was replaced since.
struct ReplacedMesh {
  std::shared_ptr<const IndexedMesh> mesh;  ///< the one that the last report speaks of
  std::vector<std::uint32_t> new_of_old;    ///< the vertex now of each vertex of it, or Mesh::no_vertex
};

/// Another object, the pair with which was ignored as a whole. It may be watched again, or be gone.
struct IgnoredPartner {
  std::uint64_t serial = 0;
  bool counts = false;  ///< no lasting filter takes that pair out

  friend auto operator<=>(const IgnoredPartner&, const IgnoredPartner&) = default;
};

/// How an object that may be in a swept pair moves in a step. Steps have the numbers of ObjectStore.
struct ObjectSweep {
  SurfaceMotion motion;
  std::uint64_t kept_step = 0;   ///< the step that kept where the object was before
  std::uint64_t jumps_step = 0;  ///< the step by which it jumps
  std::uint64_t swept_step = 0;  ///< the last step that has swept a pair of it
};

/// One object of a scene, as steps see it. `validate` says which states cannot be.
struct Object {
  ObjectId id;
  std::uint64_t serial = 0;  ///< ascends in the order of addition. It is never reused
  /// The number of objects that came before. It is the serial, unless objects come with serials of their own.
  std::uint64_t arrival = 0;
  ObjectSettings settings;
  std::shared_ptr<const FaceGroups> face_groups;  ///< null if all faces are in group 0, and none is hidden
  std::shared_ptr<const SelfExclusion> self;      ///< null unless it is tested against itself
  std::unique_ptr<Surface> owned_surface;         ///< use the accessors below
  const IndexedMesh* mesh = nullptr;              ///< the surface's
  std::shared_ptr<const Mesh> users_mesh;         ///< the same, as the caller gave it
  bool in_parts = false;                          ///< it is large, so several tasks read and refit it
  PairPlace place;                                ///< says where its pairs are tested
  std::uint64_t mesh_number = 0;                  ///< how often its mesh was replaced (NamedMesh)
  std::unique_ptr<ReplacedMesh> replaced;         ///< null, unless that was after the last report

  // The input of the next read. Posed objects have the first two, and deformable objects the others.
  std::optional<Pose> pose;
  std::optional<Pose> standing_pose;  ///< the last pose that was read or surveyed
  SparePositions::Loan positions;
  Box box_of_positions;                     ///< the box of `positions`
  SparePositions::Loan standing_positions;  ///< the copy that the surface uses
  std::optional<BoundMemory> bound;         ///< not beside `positions`
  Promises promises;

  // The current plan, and what reads have found.
  ReadPlan plan = ReadPlan::skip;
  ReadState state = ReadState::read;
  /// The bound memory was bad when last read, or the last pose was refused. The object stays where it was,
  /// and its pairs are not tested.
  bool frozen = false;
  /// It has been frozen since it was added or got its mesh. So no step has seen it at a place of its own.
  bool is_unplaced = false;
  bool is_settled = false;  ///< since it was added (SettlePose)
  bool moved = false;       ///< the last read found it moved, or it was bound since
  /// The bound memory may differ from what the store's observer saw last, in a way that reads can tell.
  bool is_unobserved = true;
  NearlyStatic nearly_static;
  Box box;  ///< contains the object: `seen.box`, grown by the motion promised since
  Seen seen;
  std::uint64_t version = 0;  ///< of the surface, after a read

  Demand demand = Demand::nothing;
  bool goes_by_lists = false;  ///< the demand was `test` when its read was planned last
  /// What the current refit has counted. If `refit` is another number, the counts are of an earlier refit.
  struct Asked {
    std::uint64_t refit = 0;
    std::size_t jobs = 0;  ///< jobs that test it
    bool walked = false;   ///< one of these jobs walked its regions in the last step
    double shares = 0;     ///< the shares of its box near the jobs' other objects, for large objects only
  } asked;

  std::unique_ptr<ObjectSweep> sweep;  ///< null if no pair of it can be swept

  std::vector<IgnoredPartner> ignored_partners;  ///< the notes of IgnoredObjects

  // The store's own notes.
  bool may_have_input = false;    ///< the store lists it for the next read
  bool removed = false;           ///< it is dropped before the next read
  std::size_t counted_bytes = 0;  ///< its part of ObjectBytes

  [[nodiscard]] bool hides_some_faces() const { return face_groups != nullptr && face_groups->hides_some(); }
  [[nodiscard]] bool hides_all_faces() const { return face_groups != nullptr && face_groups->all().none(); }
  [[nodiscard]] bool is_posed() const { return settings.motion != Motion::deformable; }
  [[nodiscard]] bool is_read_in_every_step() const {
    return bound && bound->policy == BindPolicy::every_step;
  }
  [[nodiscard]] bool is_unread() const { return state >= ReadState::unread; }
  /// Whether the last that a step saw of the object is a survey, and no newer input is due.
  [[nodiscard]] bool is_surveyed() const { return state >= ReadState::surveyed; }
  /// Whether the last that a step saw of the object is a survey, even if newer input is due.
  [[nodiscard]] bool was_surveyed() const { return is_surveyed() || state == ReadState::due; }

  /// Ends the view of bound memory. The surface's positions are of no use before the next read or view.
  void end_view() {
    if (state != ReadState::viewed) return;
    state = ReadState::read;
    surface_to_write().end_view();
  }

  [[nodiscard]] const Surface& surface() const {
    require_read(StepData::surfaces, this);
    return *owned_surface;
  }
  [[nodiscard]] Surface& surface_to_write() {
    require_write(StepData::surfaces, this);
    return *owned_surface;
  }
};

inline FilterTraits filter_traits_of(const Object& object) {
  const ObjectSettings& settings = object.settings;
  return {settings.group, settings.layer, settings.collides_with, settings.motion == Motion::fixed,
          object.place};
}

/// Checks after a read that each object's state is one that can be. Does nothing without GRAZE_VALIDATE.
void validate(std::span<const std::unique_ptr<Object>> objects);

}  // namespace graze
