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

#include "calls/call_queue.hpp"
#include "calls/object_ids.hpp"

namespace graze {

/// Takes the calls on a scene from any thread and keeps them, in the order in which they were made, until a
/// step takes them up. Ids are given and checked here, so an id is good or stale at the moment of the call.
/// Nobody waits for another thread, but those that bind, unbind, or end the binding of an object in another
/// way: they do so one after the other, so that what is bound is known when it is copied.
///
/// The forms for many objects mean the same as single calls in the order of the spans, of which no other
/// thread's calls come in between; spans that do not fit together are a diagnostic and nothing is taken.
///
/// Only `add` and `reserve` throw. Where there is no memory for another call, a bit is set that takes none
/// (LostCalls), and the next step says so. Nothing is read through a binding that such a call was to end.
class Staging {
 public:
  /// Throws Error for no mesh or bad settings, and std::bad_alloc; nothing has changed then.
  ObjectId add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings);
  void remove(ObjectId object);
  void set_pose(ObjectId object, const std::array<double, 12>& rows);
  /// With the last row of the matrix.
  void set_pose(ObjectId object, const std::array<double, 16>& rows);
  /// 16 numbers for each object: a 4x4 matrix, column by column.
  void set_poses(std::span<const ObjectId> objects, std::span<const double> matrices);
  void set_positions(ObjectId object, const PositionView& positions, double max_displacement);
  void set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                     double max_displacement);
  void bind_positions(ObjectId object, const PositionView& positions, BindPolicy policy);
  void bind_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                      BindPolicy policy);
  void unbind_positions(ObjectId object);
  void positions_changed(ObjectId object, double max_displacement);
  void positions_changed(std::span<const ObjectId> objects, double max_displacement);
  void positions_changed(std::span<const ObjectId> objects, std::span<const double> max_displacements);
  void set_ignored(ObjectId a, ObjectId b, bool ignored);
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);
  void reserve(const SceneCapacity& capacity);

  /// What an id names now; empty where it names nothing.
  [[nodiscard]] ObjectIds::Pin find(ObjectId object) { return ids_.pin(object); }
  [[nodiscard]] bool contains(ObjectId object) const {
    return ids_.standing(object) != ObjectIds::Standing::stale;
  }
  [[nodiscard]] std::size_t object_count() const { return ids_.count(); }
  /// Of what is told of objects, copies of positions, and waiting calls.
  [[nodiscard]] std::size_t byte_count() const noexcept { return ids_.byte_count() + queue_.byte_count(); }

  /// Takes the calls made so far out of the queue, for a step. Stepping thread only.
  void collect() {
    const std::lock_guard lock(bindings_);
    queue_.collect();
    ids_.collect_lost();
    ++steps_;
  }
  /// The step that took calls last came to no end. The next one takes up those that it has not visited.
  void step_failed() noexcept;
  /// Calls `visit` with each call taken and not yet visited, in their order. Where a visit throws, that call
  /// is the first of the next time. Stepping thread only.
  template <typename Visitor>
  void visit_collected(const Visitor& visit) {
    queue_.visit_collected([&](auto& call) {
      // The thread that adds may not have come so far yet; a report that names the object may not go ahead.
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

  /// Visits what stands for lost calls about an object, and clears their bits.
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
  /// A binding that ended without a copy of what was bound.
  [[nodiscard]] static UnbindPositions lost_binding(ObjectId object) {
    UnbindPositions call;
    call.object = object;
    call.is_lost = true;
    return call;
  }
  /// Says that a call about an object, or about none, was lost.
  [[nodiscard]] Diagnostic lost_call(ObjectId object);
  /// Does `make`, or notes what is lost where there is no memory for it.
  template <typename Make>
  void make_or_lose(ObjectId object, std::uint8_t lost, const Make& make) noexcept;
  void lose(ObjectId object, std::uint8_t lost) noexcept;
  /// The same of a call that ends the binding of an object: nothing is read through it any more.
  void lose_binding(ObjectId object) noexcept;
  [[nodiscard]] bool has_step_read(const Binding& binding) const;

  // Each checks one call and adds it, or a diagnostic in its place, to `calls`; those that try note what is
  // lost where there is no memory for that.
  void add_pose(Calls& calls, ObjectId object, const std::array<double, 12>& rows,
                const std::array<double, 4>& last_row = {0, 0, 0, 1});
  void add_positions(Calls& calls, ObjectId object, const PositionView& positions, double max_displacement);
  void try_positions(Calls& calls, ObjectId object, const PositionView& positions,
                     double max_displacement) noexcept;
  /// A copy of positions and their box; none, and a diagnostic, where one is not finite or beyond 2^120.
  SparePositions::Loan copy_good(ObjectId object, NamedObject& named, const PositionView& view,
                                 const char* consequence, Box& box, std::optional<Diagnostic>& problem);
  void add_binding(Calls& calls, ObjectId object, const PositionView& positions, BindPolicy policy);
  void try_binding(Calls& calls, ObjectId object, const PositionView& positions, BindPolicy policy) noexcept;
  void add_unbinding(Calls& calls, ObjectId object);
  void try_change(Calls& calls, ObjectId object, double max_displacement) noexcept;
  void add_ignored(Calls& calls, ObjectId a, ObjectId b, bool ignored);

  /// Whether there are as many `things` as objects; a diagnostic where not.
  bool check_sizes(Calls& calls, std::size_t objects, std::size_t things, const char* what,
                   const char* name_of_things) noexcept;
  /// Whether an id names a deformable object; a diagnostic where not. `what` is the call's name.
  bool check_deformable(Calls& calls, ObjectId object, const char* what);
  /// `max_displacement`, or no promise and a diagnostic where it is none.
  double promise_of(Calls& calls, ObjectId object, double max_displacement, const char* what);
  /// Nobody reads the memory that an object was bound to when this returns, or will.
  void end_binding(NamedObject& object);
  /// How a message names an object that is there or was a moment ago.
  std::string name(ObjectId object);

  // The queue goes first: its calls give their buffers back to the ids' places.
  ObjectIds ids_;
  CallQueue queue_;
  /// Held until the calls that bind or unbind have entered the queue, and while calls are taken out of it.
  std::mutex bindings_;
  std::uint64_t steps_ = 0;  ///< that have taken calls
  // Of the last steps, those after `failed_after_` up to `failed_` came to no end.
  std::uint64_t failed_after_ = 0;
  std::uint64_t failed_ = 0;
  std::atomic<bool> unnamed_lost_{false};  ///< calls about no object
  bool unnamed_collected_ = false;         ///< and for the step at hand: the stepping thread's
};

}  // namespace graze
