#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "calls/call_queue.hpp"
#include "calls/object_ids.hpp"

namespace graze {

/// Makes the call that adds an object, without its id. Throws Error for a missing mesh or bad settings.
[[nodiscard]] AddObject addition_of(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings);

/// Queues the calls on a scene from any thread, in the order in which they were made, until a step collects
/// them. Ids are checked here, so an id is valid or stale at the moment of the call. No call waits for
/// another thread, except calls that bind, unbind, or otherwise end a binding, and those that replace meshes.
/// These run one after the other, so that the binding and its mesh are known when its memory is copied.
///
/// The forms for many objects mean single calls in the order of the spans, with no other thread's calls in
/// between. Spans that do not fit together give a diagnostic, and no call is made.
///
/// Only `add`, `replace_mesh` and `reserve` throw. If there is no memory for another call, a bit is set that
/// needs none (LostCalls), and the next step reports it. No binding that such a call was to end is read any
/// more.
class Staging {
 public:
  /// Throws Error for a missing mesh or bad settings, and std::bad_alloc. Nothing has changed then.
  ObjectId add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings) {
    return add(addition_of(std::move(mesh), settings));
  }
  /// Adds an object by a call that has no id yet.
  ObjectId add(AddObject call);
  /// Throws Error for a missing mesh or lists that do not fit, and std::bad_alloc. Nothing has changed then.
  void replace_mesh(ObjectId object, std::shared_ptr<const Mesh> mesh,
                    std::span<const std::uint32_t> new_of_old, std::span<const std::uint8_t> face_groups);
  void remove(ObjectId object);
  // If `jumps` is true, the objects do not pass what lies between (MarkTeleport).
  void set_pose(ObjectId object, const std::array<double, 12>& rows, bool jumps = false);
  /// Sets a pose by all four rows of its matrix.
  void set_pose(ObjectId object, const std::array<double, 16>& rows);
  /// Sets poses by 16 numbers for each object: a 4x4 matrix in column-major order.
  void set_poses(std::span<const ObjectId> objects, std::span<const double> matrices, bool jumps = false);
  void set_positions(ObjectId object, const PositionView& positions, double max_displacement,
                     bool jumps = false);
  void set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                     double max_displacement, bool jumps = false);
  void bind_positions(ObjectId object, const PositionView& positions, BindPolicy policy);
  void bind_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                      BindPolicy policy);
  void unbind_positions(ObjectId object);
  void positions_changed(ObjectId object, double max_displacement, bool jumps = false);
  void positions_changed(std::span<const ObjectId> objects, double max_displacement, bool jumps = false);
  void positions_changed(std::span<const ObjectId> objects, std::span<const double> max_displacements);
  void set_ignored(ObjectId a, ObjectId b, bool ignored);
  void set_ignored(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b, bool ignored);
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);
  void reserve(const SceneCapacity& capacity);

  /// Queues a call as it is, for a replay. The caller has checked what the call's own function would check.
  template <typename OneCall>
  void repeat(OneCall call) {
    CallQueue::Chain(queue_).add(std::move(call));
  }

  // Of a GhostSource, which gives its objects to the store by itself.
  /// Returns the id of a ghost.
  [[nodiscard]] ObjectId name_ghost(const AddObject& ghost);
  /// Frees that id. The object is removed from the store.
  void forget_ghost(ObjectId ghost);
  /// Copies packed positions of a ghost, one for each of its vertices.
  [[nodiscard]] SparePositions::Loan copy_for_ghost(ObjectId ghost, const PositionView& positions);

  /// Pins the object that an id names. The pin is empty if it names none.
  [[nodiscard]] ObjectIds::Pin find(ObjectId object) { return ids_.pin(object); }
  [[nodiscard]] bool contains(ObjectId object) const {
    return ids_.standing(object) != ObjectIds::Standing::stale;
  }
  [[nodiscard]] std::size_t object_count() const { return ids_.count(); }
  /// The bytes of the ids' data, of copied positions and of waiting calls.
  [[nodiscard]] std::size_t byte_count() const noexcept { return ids_.byte_count() + queue_.byte_count(); }

  /// Collects the calls made so far for a step. Stepping thread only.
  void collect() {
    const std::lock_guard lock(bindings_);
    queue_.collect();
    ids_.collect_lost();
    ++steps_;
  }
  /// Notes that the last step failed. The next one applies the calls that it has not visited.
  void step_failed() noexcept;
  /// Calls `visit` with each collected call in order. If a visit throws, the next time begins with that call.
  /// Stepping thread only.
  template <typename Visitor>
  void visit_collected(const Visitor& visit) {
    queue_.visit_collected([&](auto& call) {
      // The adding thread may not have published the id yet. A report must not name an object before its id
      // is valid.
      if constexpr (std::is_same_v<decltype(call), AddObject&>) ids_.publish(call.object);
      visit(call);
    });
    ids_.visit_lost([&](ObjectId object, std::uint8_t& lost) { visit_lost(visit, object, lost); });
    if (unnamed_lost_.load(std::memory_order_relaxed) && unnamed_lost_.exchange(false))
      unnamed_collected_ = true;
    if (unnamed_collected_) visit_made(visit, lost_call({}));
    unnamed_collected_ = false;
  }

 private:
  using Calls = CallQueue::Chain;

  /// Visits replacements for the lost calls about an object, and clears their bits.
  template <typename Visitor>
  void visit_lost(const Visitor& visit, ObjectId object, std::uint8_t& lost) {
    const auto visit_one = [&](std::uint8_t bit, const auto& make) {
      if ((lost & bit) != 0) visit_made(visit, make());
      lost &= static_cast<std::uint8_t>(~bit);
    };
    visit_one(LostCalls::any, [&] { return lost_call(object); });
    visit_one(LostCalls::motion, [&] {
      return PositionsChanged{object, std::numeric_limits<double>::infinity()};
    });
    visit_one(LostCalls::binding, [&] { return lost_binding(object); });
    visit_one(LostCalls::removal, [&] { return RemoveObject{object}; });
  }
  template <typename Visitor, typename OneCall>
  static void visit_made(const Visitor& visit, OneCall call) {
    visit(call);
  }
  /// The end of a binding whose memory could not be copied.
  [[nodiscard]] static UnbindPositions lost_binding(ObjectId object) {
    UnbindPositions call;
    call.object = object;
    call.is_lost = true;
    return call;
  }
  /// A diagnostic that says that a call about an object, or about none, was lost.
  [[nodiscard]] Diagnostic lost_call(ObjectId object);
  /// Calls `make`, or notes the lost call if there is no memory for it.
  template <typename Make>
  void make_or_lose(ObjectId object, std::uint8_t lost, const Make& make) noexcept;
  void lose(ObjectId object, std::uint8_t lost) noexcept;
  /// Notes the loss of a call that ends an object's binding. The bound memory is not read any more.
  void lose_binding(ObjectId object) noexcept;
  [[nodiscard]] bool has_step_read(const Binding& binding) const;

  // Each of these checks one call and adds it, or a diagnostic instead, to `calls`. The `try_` forms note a
  // lost call if there is no memory.
  void add_pose(Calls& calls, ObjectId object, const std::array<double, 12>& rows,
                const std::array<double, 4>& last_row = {0, 0, 0, 1});
  void add_positions(Calls& calls, ObjectId object, const PositionView& positions, double max_displacement);
  void try_positions(Calls& calls, ObjectId object, const PositionView& positions,
                     double max_displacement) noexcept;
  /// Copies positions and computes their box. Returns null and a diagnostic if a coordinate is not finite or
  /// beyond 2^120.
  SparePositions::Loan copy_good(ObjectId object, NamedObject& named, const Mesh& mesh,
                                 const PositionView& view, const char* consequence, Box& box,
                                 std::optional<Diagnostic>& problem);
  void add_binding(Calls& calls, ObjectId object, const PositionView& positions, BindPolicy policy);
  void try_binding(Calls& calls, ObjectId object, const PositionView& positions, BindPolicy policy) noexcept;
  void add_unbinding(Calls& calls, ObjectId object);
  void try_jump(Calls& calls, ObjectId object) noexcept;
  void try_change(Calls& calls, ObjectId object, double max_displacement) noexcept;
  void add_ignored(Calls& calls, ObjectId a, ObjectId b, bool ignored);
  /// Returns whether both ids name objects, and adds a diagnostic if not.
  bool check_both(Calls& calls, ObjectId a, ObjectId b, bool ignored) const;

  /// Returns whether there are as many `things` as objects, and adds a diagnostic if not.
  bool check_sizes(Calls& calls, std::size_t objects, std::size_t things, const char* what,
                   const char* name_of_things) noexcept;
  /// Returns whether an id names a deformable object, and adds a diagnostic if not. `what` is the call's
  /// name.
  bool check_deformable(Calls& calls, ObjectId object, const char* what);
  /// Returns `max_displacement`. If it is negative or NaN, adds a diagnostic and returns infinity, which
  /// promises nothing.
  double promise_of(Calls& calls, ObjectId object, double max_displacement, const char* what);
  /// Ends an object's binding. No thread reads the bound memory after this returns.
  void end_binding(NamedObject& object);
  /// Ends it unless the object's mesh is another one by now.
  void end_binding(NamedObject& object, std::uint64_t mesh_number);
  /// The name in messages of an object that exists or existed a moment ago.
  std::string name(ObjectId object);

  // The queue is destroyed first, since its calls return their buffers to the ids' slots.
  ObjectIds ids_;
  CallQueue queue_;
  /// Held until calls that bind or unbind have entered the queue, and while calls are collected.
  std::mutex bindings_;
  std::uint64_t steps_ = 0;  ///< the number of steps that have collected calls
  // The last failed steps are those after `failed_after_` up to `failed_`.
  std::uint64_t failed_after_ = 0;
  std::uint64_t failed_ = 0;
  std::atomic<bool> unnamed_lost_{false};  ///< calls about no object were lost
  bool unnamed_collected_ = false;  ///< the same for the current step. Only the stepping thread uses it
};

}  // namespace graze
