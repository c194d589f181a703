#include "objects/object_reading.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <string>
#include <utility>

#include "base/object_name.hpp"
#include "core/base/number_text.hpp"
#include "objects/leaf_test_slack.hpp"

namespace graze {
namespace {

std::string coordinates(const Eigen::Vector3d& point) {
  std::string text = number_text(point.x());
  text.append(", ").append(number_text(point.y())).append(", ").append(number_text(point.z()));
  return text;
}

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
    return name_of(object.id, object) + ": vertex " + std::to_string(vertex) + " is at " +
           coordinates(position) + (finite ? ", beyond 2^120" : "") + "; " + consequence;
  });
}

const char* const stands_still = "it stands still until good positions are read";
const char* const pose_refused = "the pose was not taken";

/// Returns a diagnostic if a displacement is larger than the promised one.
std::optional<Diagnostic> check_promise(const Object& object, double displacement) {
  // The displacement is rounded, so a promise that is kept to the last bit must not count as broken.
  if (!(displacement > object.promised * round_up)) return std::nullopt;
  return diagnostic_of(object, DiagnosticKind::broken_promise, [&] {
    const double promised = object.promised == 0 ? 0 : object.promise_sum;
    return name_of(object.id, object) + ": a vertex moved by " + number_text(displacement) +
           ", further than the " + number_text(promised) + " promised; all positions were read";
  });
}

bool is_read_in_every_step(const Object& object) {
  return object.bound && object.policy == BindPolicy::every_step;
}

/// The pose that the object is to have: a new one, or the one that the last survey used.
const Pose& pose_of(const Object& object) {
  return object.pose ? *object.pose : *object.standing_pose;
}

/// The positions that the object is to have.
PositionView positions_of(const Object& object) {
  return object.positions ? object.positions->view() : *object.bound;
}

bool is_posed(const Object& object) {
  return object.settings.motion != Motion::deformable;
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

/// The number of steps in which an object does not count as nearly static after its vertices moved further
/// than its box.
constexpr std::uint8_t static_cooldown = 16;

/// Whether an object seems nearly static by its box. Counts down its cooldown.
bool seems_nearly_static(Object& object, const Box& now) {
  if (object.static_cooldown_steps == 0) return hardly_moves(object, motion_between(object.box, now));
  --object.static_cooldown_steps;
  return false;
}

/// Notes that the surface has the object's current positions.
void note_read(Object& object) {
  object.unread = object.surveyed = object.stays_unread = false;
  object.box = object.seen = object.surface().box();
  object.has_surface = true;
  object.version = object.surface().version();
}

void note_survey(Object& object, const Box& box) {
  object.unread = object.surveyed = true;
  object.stays_unread = false;
  object.box = object.seen = box;
  object.has_surface = false;
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
  if (object.to_survey) return survey_pose(object);
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
    object.unread = object.surveyed = false;
    outcome.changed = true;
    outcome.problem = bad_vertex(object, all.bad_vertex, all.bad_position, stands_still);
  } else {
    outcome.changed = !is_same(object.box, all.box);
    object.moved = outcome.changed;
    object.is_nearly_static = object.to_block && seems_nearly_static(object, all.box);
    note_survey(object, all.box);
    object.promised = 0;
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
  if (object.pose || is_read_in_every_step(object)) return true;
  if (object.unread && object.surveyed) return object.is_new || !object.stays_unread;
  return object.positions || (object.bound && object.is_notified);
}

bool stays_unread(const Object& object) {
  return object.unread && object.surveyed && !object.pose && !object.is_new && !is_read_in_every_step(object);
}

void add_promise(Object& object) {
  const bool may_have_moved = is_read_in_every_step(object) || object.is_new;
  if (may_have_moved) {
    object.promise_sum = object.promised == 0 ? object.promise : object.promise_sum + object.promise;
    object.promised = (object.promised + object.promise) * round_up;
  }
  object.is_new = false;
  object.promise = std::numeric_limits<double>::infinity();
}

bool can_be_viewed(const Object& object) {
  return (object.positions || is_read_in_every_step(object)) &&
         object.surface().can_view(positions_of(object));
}

bool can_be_surveyed(const Object& object, bool with_views) {
  if (object.pose) return !object.tested;
  if (!object.positions && !is_read_in_every_step(object) && !object.is_notified_again) return false;
  return !object.promises && !std::isfinite(object.promised) && !object.frozen &&
         (object.surveyed || object.moved) &&
         (!object.tested || (with_views && !object.is_nearly_static && can_be_viewed(object)));
}

bool has_known_box(const Object& object) {
  return object.pose || object.positions;
}

Surface::PartSeen scan_part(const Object& object, std::uint32_t begin, std::uint32_t end) {
  const Surface& surface = object.surface();
  if (is_posed(object)) return surface.scan_pose(pose_of(object), begin, end);
  if (object.to_survey) return Surface::survey(*object.mesh, *object.bound, begin, end);
  // A promise is checked against the exact largest displacement, not against a bound of it.
  const bool is_held = object.has_surface && std::isfinite(object.promised);
  const auto displacement = is_held ? Surface::Displacement::exact : Surface::Displacement::bound;
  return surface.scan_positions(positions_of(object), begin, end, displacement);
}

ReadOutcome accept_scan(Object& object, const Surface::PartSeen& all) {
  if (is_posed(object)) return accept_pose(object, object.surface_to_write().accept(all));
  if (object.to_survey) return accept_survey(object, all);
  const bool was_behind = object.surface().is_behind();
  const bool seems_at_rest = was_behind && is_same(object.box, all.box);
  const bool is_copy = object.positions != nullptr;
  const Surface::ReadResult result = accept_positions(object, all);
  if (!was_behind && object.is_nearly_static) {
    object.is_nearly_static = hardly_moves(object, result.displacement);
    if (!object.is_nearly_static && hardly_moves(object, motion_between(object.box, all.box)))
      object.static_cooldown_steps = static_cooldown;
  }
  ReadOutcome outcome{result.changed && !is_copy, result.changed, std::nullopt};
  // After a view, only the next step can tell whether the object moves.
  object.moved = result.changed && !seems_at_rest;
  outcome.changed = outcome.changed || object.frozen == result.taken();
  outcome.accepted = result.taken();
  object.frozen = !outcome.accepted;
  outcome.problem = object.frozen
                        ? bad_vertex(object, result.bad_vertex, result.bad_position, stands_still)
                        : check_promise(object, object.has_surface ? result.displacement
                                                                   : motion_between(object.seen, all.box));
  return outcome;
}

void write_part(Object& object, std::uint32_t begin, std::uint32_t end) {
  Surface& surface = object.surface_to_write();
  if (is_posed(object)) return surface.write_pose(pose_of(object), begin, end);
  surface.write_positions(*object.bound, begin, end);
}

void finish_read(Object& object, bool accepted) {
  if (object.to_survey || !accepted) return;
  if (is_posed(object)) return finish_pose(object);
  if (object.bound) object.is_notified = false;
  object.positions.reset();  // now, so that the buffer can be lent again at once
  object.promised = 0;
  note_read(object);
}

void view_memory(Object& object) {
  Surface& surface = object.surface_to_write();
  surface.view(positions_of(object), object.box);
  // A copy stays valid; the caller's memory may go after the step.
  object.viewed = !object.positions;
  object.standing_positions = std::move(object.positions);
  object.unread = object.surveyed = object.stays_unread = object.to_view = false;
  object.version = surface.version();
  if (!object.in_parts) surface.make_blocks();
}

ReadOutcome read_whole(Object& object) {
  if (is_posed(object)) return read_pose(object);
  if (object.to_view) {
    view_memory(object);
    return {};
  }
  const std::uint32_t count = object.mesh->vertex_count();
  Surface::PartSeen all;
  if (object.to_survey && object.positions)
    all.box = object.box_of_positions;
  else
    all = scan_part(object, 0, count);
  ReadOutcome outcome = accept_scan(object, all);
  if (outcome.to_write) write_part(object, 0, count);
  if (object.to_survey && object.to_block && !object.frozen && can_be_viewed(object)) view_memory(object);
  finish_read(object, outcome.accepted);
  return outcome;
}

}  // namespace graze
