#include "objects/object_reading.hpp"

#include <algorithm>
#include <cassert>
#include <new>
#include <string>
#include <utility>

#include "base/object_name.hpp"
#include "core/base/bad_vertex_text.hpp"
#include "core/base/number_text.hpp"
#include "objects/leaf_test_slack.hpp"

namespace graze {
namespace {

/// Makes a diagnostic with the text of `message`, or without a text if there is no memory for it. It does not
/// throw, since a read that has begun to change an object must be completed.
template <typename Message>
Diagnostic diagnostic_of(const Object& object, DiagnosticKind kind, const Message& message) noexcept {
  Diagnostic diagnostic{object.id, kind, {}};
  try {
    diagnostic.message = message();
  } catch (const std::bad_alloc&) {
    diagnostic.message.clear();
  }
  return diagnostic;
}

Diagnostic bad_vertex(const Object& object, std::uint32_t vertex, const Eigen::Vector3d& position,
                      const char* consequence) {
  const bool finite = position.allFinite();
  return diagnostic_of(object, finite ? DiagnosticKind::too_large : DiagnosticKind::not_finite, [&] {
    return name_of(object.id, object) + ": " + bad_vertex_text(vertex, position) + "; " + consequence;
  });
}

const char* const stands_still = "it stands still until good positions are read";
const char* const pose_refused = "the pose was not taken";

/// Returns a diagnostic if a displacement is larger than the promised one.
std::optional<Diagnostic> check_promise(const Object& object, double displacement) {
  // The displacement is rounded, so a promise that is kept to the last bit must not count as broken.
  if (!(displacement > object.promises.motion * round_up)) return std::nullopt;
  return diagnostic_of(object, DiagnosticKind::broken_promise, [&] {
    const double promised = object.promises.motion == 0 ? 0 : object.promises.sum;
    return name_of(object.id, object) + ": a vertex moved by " + number_text(displacement) +
           ", further than the " + number_text(promised) + " promised; all positions were read";
  });
}

/// The pose that the object is to have: a new one, or the one that the last survey used.
const Pose& pose_of(const Object& object) {
  return object.pose ? *object.pose : *object.standing_pose;
}

/// The positions that the object is to have.
PositionView positions_of(const Object& object) {
  return object.positions ? object.positions->view() : object.bound->view;
}

bool is_same(const Box& left, const Box& right) {
  return left.min == right.min && left.max == right.max;
}

/// A lower bound of the largest motion of a vertex, from the boxes before and after.
double motion_between(const Box& left, const Box& right) {
  return std::max((left.min - right.min).cwiseAbs().maxCoeff(), (left.max - right.max).cwiseAbs().maxCoeff());
}

/// Whether lists of vertices pay if the other object of a pair moves as much.
bool hardly_moves(const Object& object, double motion) {
  return list_slack_of_vertices.of(2 * motion, object.surface().leaf_size()) > 0;
}

/// Whether an object seems nearly static by its box. Counts down its cooldown.
bool seems_nearly_static(Object& object, const Box& now) {
  return object.nearly_static.may_begin() && hardly_moves(object, motion_between(object.box, now));
}

/// Judges by the exact motion whether an object that seemed nearly static is so.
void check_nearly_static(Object& object, double displacement, const Box& now) {
  if (!object.nearly_static || hardly_moves(object, displacement)) return;
  object.nearly_static.set(false);
  if (hardly_moves(object, motion_between(object.box, now))) object.nearly_static.begin_cooldown();
}

/// Notes that the surface has the object's current positions.
void note_read(Object& object) {
  object.state = ReadState::read;
  object.box = object.surface().box();
  object.seen = {object.box, true};
  object.version = object.surface().version();
}

void note_survey(Object& object, const Box& box) {
  object.state = ReadState::surveyed;
  object.box = box;
  object.seen = {box, false};
}

/// Refuses a pose that moves a vertex beyond the limits. The object's pairs are stale until a good pose
/// comes.
ReadOutcome refuse_pose(Object& object, std::uint32_t vertex, const Eigen::Vector3d& position) {
  object.pose.reset();
  const bool changed = !std::exchange(object.frozen, true);
  return {false, changed, bad_vertex(object, vertex, position, pose_refused), false};
}

/// Surveys a pose by the box of the posed rest shape. It reads vertices only if that box may be beyond the
/// limits.
ReadOutcome survey_pose(Object& object) {
  Box box = object.mesh->rest_reach().box_at(*object.pose);
  if (!Surface::is_within_limits(box.min) || !Surface::is_within_limits(box.max)) {
    const auto all = object.surface().scan_pose(*object.pose, 0, object.mesh->vertex_count());
    if (all.bad_vertex != Surface::ReadResult::no_vertex)
      return refuse_pose(object, all.bad_vertex, all.bad_position);
    box = all.box;
  }
  object.standing_pose = std::exchange(object.pose, std::nullopt);
  object.moved = true;
  note_survey(object, box);
  return {false, true, std::nullopt};
}

/// Accepts the pose that the surface was given, or refuses it.
ReadOutcome accept_pose(Object& object, const Surface::ReadResult& result) {
  if (!result.taken()) return refuse_pose(object, result.bad_vertex, result.bad_position);
  object.moved = result.changed;
  return {result.changed, result.changed, std::nullopt};
}

void finish_pose(Object& object) {
  if (object.pose) object.standing_pose = std::exchange(object.pose, std::nullopt);
  note_read(object);
}

ReadOutcome read_pose(Object& object) {
  if (is_survey(object.plan)) return survey_pose(object);
  const Surface::ReadResult result = object.surface_to_write().set_pose(pose_of(object));
  ReadOutcome outcome = accept_pose(object, result);
  if (outcome.accepted) finish_pose(object);
  return outcome;
}

/// Accepts the result of a survey, or freezes the object and says why.
ReadOutcome accept_survey(Object& object, const Surface::PartSeen& all) {
  ReadOutcome outcome;
  object.frozen = all.bad_vertex != Surface::ReadResult::no_vertex;
  if (object.frozen) {
    object.state = ReadState::read;
    object.is_unobserved = true;
    outcome.changed = true;
    outcome.problem = bad_vertex(object, all.bad_vertex, all.bad_position, stands_still);
  } else {
    outcome.changed = !is_same(object.box, all.box);
    object.is_unobserved |= outcome.changed;
    object.moved = outcome.changed;
    object.nearly_static.set(object.plan == ReadPlan::survey_and_view &&
                             seems_nearly_static(object, all.box));
    note_survey(object, all.box);
    object.promises.motion = 0;
  }
  return outcome;
}

/// Makes the surface accept the positions that were read. A copy becomes the surface's positions without
/// another copy.
Surface::ReadResult accept_positions(Object& object, const Surface::PartSeen& all) {
  Surface& surface = object.surface_to_write();
  if (!object.positions) {
    Surface::ReadResult result = surface.accept(all);
    if (result.changed) object.standing_positions.reset();
    return result;
  }
  Surface::ReadResult result = surface.take_in_place(all, object.positions->view());
  if (result.changed) object.standing_positions = std::move(object.positions);
  return result;
}

}  // namespace

bool has_input(const Object& object) {
  if (object.pose || object.is_read_in_every_step()) return true;
  if (object.is_surveyed())
    return object.promises.next || object.state != ReadState::still_surveyed || object.sweep != nullptr;
  return object.positions || (object.bound && object.bound->is_notified);
}

bool stays_unread(const Object& object) {
  return object.is_surveyed() && !object.pose && !object.promises.next && !object.is_read_in_every_step() &&
         object.sweep == nullptr;
}

void add_promise(Object& object) {
  const bool may_have_moved = object.is_read_in_every_step() || object.promises.next;
  if (may_have_moved) object.promises.add_next();
}

bool can_be_viewed(const Object& object) {
  return (object.positions || object.is_read_in_every_step()) &&
         object.surface().can_view(positions_of(object));
}

bool can_be_surveyed(const Object& object, bool with_views) {
  if (object.sweep != nullptr || object.settings.queries) return false;
  const bool is_tested = object.demand != Demand::nothing;
  if (object.pose) return !is_tested;
  const bool is_told_again = object.bound && object.bound->is_notified_again;
  if (!object.positions && !object.is_read_in_every_step() && !is_told_again) return false;
  return !object.promises.are_made && !object.promises.are_bounds() && !object.frozen &&
         (object.was_surveyed() || object.moved) &&
         (!is_tested || (with_views && !object.nearly_static && can_be_viewed(object)));
}

bool has_known_box(const Object& object) {
  return object.pose || object.positions;
}

Surface::PartSeen scan_part(const Object& object, std::uint32_t begin, std::uint32_t end) {
  const Surface& surface = object.surface();
  if (object.is_posed()) return surface.scan_pose(pose_of(object), begin, end);
  if (is_survey(object.plan)) return Surface::survey(*object.mesh, object.bound->view, begin, end);
  // A promise is checked against the exact largest displacement, not against a bound of it.
  const bool is_held = object.seen.is_in_surface && object.promises.are_bounds();
  const auto displacement = is_held ? Surface::Displacement::exact : Surface::Displacement::bound;
  return surface.scan_positions(positions_of(object), begin, end, displacement);
}

ReadOutcome accept_scan(Object& object, const Surface::PartSeen& all) {
  if (object.is_posed()) return accept_pose(object, object.surface_to_write().accept(all));
  if (is_survey(object.plan)) return accept_survey(object, all);
  const bool was_behind = object.surface().is_behind();
  const bool seems_at_rest = was_behind && is_same(object.box, all.box);
  const bool is_copy = object.positions != nullptr;
  const Surface::ReadResult result = accept_positions(object, all);
  object.is_unobserved |= was_behind || !object.seen.is_in_surface || result.changed || !result.taken();
  if (!was_behind) check_nearly_static(object, result.displacement, all.box);
  ReadOutcome outcome{result.changed && !is_copy, result.changed, std::nullopt};
  // After a view, only the next step can tell whether the object moves.
  object.moved = result.changed && !seems_at_rest;
  outcome.changed = outcome.changed || object.frozen == result.taken();
  outcome.accepted = result.taken();
  object.frozen = !outcome.accepted;
  outcome.problem = object.frozen ? bad_vertex(object, result.bad_vertex, result.bad_position, stands_still)
                                  : check_promise(object, object.seen.is_in_surface
                                                              ? result.displacement
                                                              : motion_between(object.seen.box, all.box));
  return outcome;
}

void write_part(Object& object, std::uint32_t begin, std::uint32_t end) {
  Surface& surface = object.surface_to_write();
  if (object.is_posed()) return surface.write_pose(pose_of(object), begin, end);
  surface.write_positions(object.bound->view, begin, end);
}

void finish_read(Object& object, bool accepted) {
  if (is_survey(object.plan) || !accepted) return;
  if (object.is_posed()) return finish_pose(object);
  if (object.bound) object.bound->is_notified = false;
  object.positions.reset();  // now, so that the buffer can be lent again at once
  object.promises.motion = 0;
  note_read(object);
}

void view_memory(Object& object) {
  assert(can_be_viewed(object) && !object.frozen);
  Surface& surface = object.surface_to_write();
  surface.view(positions_of(object), object.box);
  object.is_unobserved = true;
  // A copy stays valid. The caller's memory may go after the step.
  object.state = object.positions ? ReadState::read : ReadState::viewed;
  object.standing_positions = std::move(object.positions);
  object.version = surface.version();
  if (!object.in_parts) surface.make_blocks();
}

/// A pose that is beyond the limits stays, for the step to refuse.
void settle_pose(Object& object) {
  if (object.surface_to_write().set_pose(*object.pose).taken()) finish_pose(object);
}

ReadOutcome read_whole(Object& object) {
  if (object.is_posed()) return read_pose(object);
  if (object.plan == ReadPlan::view) {
    view_memory(object);
    return {};
  }
  const std::uint32_t count = object.mesh->vertex_count();
  Surface::PartSeen all;
  if (is_survey(object.plan) && object.positions)
    all.box = object.box_of_positions;
  else
    all = scan_part(object, 0, count);
  ReadOutcome outcome = accept_scan(object, all);
  if (outcome.to_write) write_part(object, 0, count);
  if (object.plan == ReadPlan::survey_and_view && !object.frozen) view_memory(object);
  finish_read(object, outcome.accepted);
  return outcome;
}

}  // namespace graze
