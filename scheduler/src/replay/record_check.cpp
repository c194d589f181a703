#include "replay/record_check.hpp"

#include <cmath>
#include <graze/error.hpp>
#include <span>
#include <utility>

#include "base/pose.hpp"
#include "base/settings_check.hpp"
#include "core/base/bad_vertex_text.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/mesh/closed.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/surface/surface.hpp"

namespace graze {
namespace {

/// Objects are called by their serials, as in `graze info`. Their names are any bytes of a stranger's file.
std::string object_text(std::uint64_t serial) {
  return "object " + std::to_string(serial);
}

/// Throws Error unless there is one position for each vertex.
void check_count(std::uint64_t serial, const PositionView& positions, const Mesh& mesh) {
  if (positions.size() != mesh.vertex_count())
    throw Error(object_text(serial) + " gets " + std::to_string(positions.size()) + " positions for " +
                std::to_string(mesh.vertex_count()) + " vertices");
}

/// Throws Error where a scene would refuse a copy of positions.
void check_copy(std::uint64_t serial, const PositionView& positions, const Mesh& mesh) {
  check_count(serial, positions, mesh);
  const FloatingPointScope scope;
  const auto seen = Surface::survey(indexed(mesh), positions, 0, mesh.vertex_count());
  if (seen.bad_vertex != Surface::ReadResult::no_vertex)
    throw Error(object_text(serial) +
                " gets bad positions: " + bad_vertex_text(seen.bad_vertex, seen.bad_position));
}

void check_promise(std::uint64_t serial, double max_displacement) {
  if (!std::isgreaterequal(max_displacement, 0.0))
    throw Error(object_text(serial) + " gets a max_displacement that is negative or NaN");
}

void check_groups(std::uint64_t serial, std::span<const std::uint8_t> groups, const Mesh& mesh) {
  if (!groups.empty() && groups.size() != mesh.face_count())
    throw Error(object_text(serial) + " gets " + std::to_string(groups.size()) + " groups for " +
                std::to_string(mesh.face_count()) + " faces");
}

void check_solid(std::uint64_t serial, const Mesh& mesh) {
  if (const auto problem = why_not_closed(indexed(mesh)))
    throw Error(object_text(serial) + " is a solid whose surface is not closed; " + *problem);
}

/// Throws Error unless each vertex of the old mesh has a vertex of the new one, or none.
void check_vertex_map(std::uint64_t serial, std::span<const std::uint32_t> new_of_old, const Mesh& before,
                      const Mesh& after) {
  if (new_of_old.size() != before.vertex_count())
    throw Error(object_text(serial) + " gets new vertices for " + std::to_string(new_of_old.size()) +
                " old ones, and its mesh has " + std::to_string(before.vertex_count()));
  for (const std::uint32_t vertex : new_of_old)
    if (vertex >= after.vertex_count() && vertex != Mesh::no_vertex)
      throw Error(object_text(serial) + " gets the new vertex " + std::to_string(vertex) +
                  ", and its new mesh has " + std::to_string(after.vertex_count()) + " vertices");
}

}  // namespace

void RecordCheck::clear() {
  objects_.clear();
  given_.clear();
  last_serial_.reset();
}

RecordCheck::Object* RecordCheck::find(ObjectId id) {
  const auto found = objects_.find(id);
  return found == objects_.end() ? nullptr : &found->second;
}

RecordCheck::Object* RecordCheck::find_deformable(ObjectId id, const char* what) {
  Object* const object = find(id);
  if (object != nullptr && !object->is_deformable)
    throw Error(object_text(object->serial) + " gets " + what + ", and is not deformable");
  return object;
}

RecordCheck::Object* RecordCheck::find_posed(ObjectId id, const char* what) {
  Object* const object = find(id);
  if (object != nullptr && object->is_deformable)
    throw Error(object_text(object->serial) + " gets " + what + ", and is deformable");
  return object;
}

void RecordCheck::take(const AddRecord& record) {
  const std::string who = object_text(record.serial);
  if (record.object.generation == 0) throw Error(who + " is added with an id that no scene gives");
  if (!given_.insert(record.object).second)
    throw Error(who + " is added with the id of an object that was added before");
  if (last_serial_ && record.serial <= *last_serial_)
    throw Error(who + " is added after object " + std::to_string(*last_serial_) +
                "; the numbers of objects ascend");
  last_serial_ = record.serial;
  ObjectSettings settings = record.settings;
  settings.name = std::to_string(record.serial);
  if (const auto problem = problem_of(settings)) throw Error(*problem);
  Object object{record.serial,
                mesh_of_(record.mesh),
                record.settings.motion == Motion::deformable,
                record.settings.solid,
                {}};
  if (object.is_solid) check_solid(record.serial, *object.mesh);
  check_groups(record.serial, record.settings.face_groups, *object.mesh);
  objects_.insert_or_assign(record.object, std::move(object));
}

void RecordCheck::take(const ReplaceRecord& record) {
  Object* const object = find(record.object);
  if (object == nullptr) return;
  std::shared_ptr<const Mesh> mesh = mesh_of_(record.mesh);
  check_vertex_map(object->serial, record.new_of_old, *object->mesh, *mesh);
  check_groups(object->serial, record.face_groups, *mesh);
  if (object->is_solid) check_solid(object->serial, *mesh);
  object->mesh = std::move(mesh);
  object->bound_in_double.reset();
}

void RecordCheck::take(const SetPose& record) {
  const Object* const object = find_posed(record.object, "a pose");
  if (object == nullptr) return;
  const FloatingPointScope scope;
  if (const auto problem = problem_of_pose(record.rows))
    throw Error(object_text(object->serial) + " gets a bad pose: " + *problem);
}

void RecordCheck::take(const RefusePose& record) {
  const Object* const object = find_posed(record.problem.object, "a refused pose");
  if (object != nullptr && record.problem.kind != DiagnosticKind::bad_pose)
    throw Error(object_text(object->serial) + " gets a refused pose for a reason that is none");
}

void RecordCheck::take(const PositionsRecord& record) {
  Object* const object = find_deformable(record.object, "positions");
  if (object == nullptr) return;
  check_promise(object->serial, record.max_displacement);
  check_copy(object->serial, record.positions, *object->mesh);
  object->bound_in_double.reset();
}

void RecordCheck::take(const BindRecord& record) {
  if (Object* const object = find_deformable(record.object, "bound memory"))
    object->bound_in_double = record.is_double;
}

/// Bound memory may hold anything: bad numbers are the scene's to find.
void RecordCheck::take(const MemoryRecord& record) {
  const Object* const object = find_deformable(record.object, "memory");
  if (object == nullptr) return;
  if (!object->bound_in_double) throw Error(object_text(object->serial) + " gets memory without a binding");
  check_count(object->serial, record.positions, *object->mesh);
  if (record.positions.is_double() != *object->bound_in_double)
    throw Error(object_text(object->serial) + " gets memory of another form than its binding");
}

/// Where two threads ended a binding at the same time, positions may come without one.
void RecordCheck::take(const UnbindRecord& record) {
  Object* const object = find_deformable(record.object, "the end of a binding");
  if (object == nullptr) return;
  if (record.problem != DiagnosticKind::stale_id && record.problem != DiagnosticKind::not_finite &&
      record.problem != DiagnosticKind::too_large)
    throw Error(object_text(object->serial) + " gets the end of a binding for a reason that is none");
  const auto bound_in_double = std::exchange(object->bound_in_double, {});
  if (record.positions.size() == 0) return;
  check_copy(object->serial, record.positions, *object->mesh);
  if (bound_in_double && record.positions.is_double() != *bound_in_double)
    throw Error(object_text(object->serial) + " gets positions of another form than its binding");
}

void RecordCheck::take(const PositionsChanged& record) {
  if (const Object* const object = find_deformable(record.object, "a change of positions"))
    check_promise(object->serial, record.max_displacement);
}

void RecordCheck::take(const IgnorePair& record) {
  if (record.a == record.b) throw Error("a pair is of one object with itself");
}

void RecordCheck::take(const SetRule& record) {
  if (const auto problem = problem_of(record.kind_a, record.kind_b, record.rule)) throw Error(*problem);
}

}  // namespace graze
