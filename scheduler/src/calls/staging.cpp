#include "calls/staging.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <graze/error.hpp>
#include <limits>
#include <optional>
#include <utility>

#include "base/object_name.hpp"
#include "base/pose.hpp"
#include "base/settings_check.hpp"
#include "core/base/bad_vertex_text.hpp"
#include "core/base/floating_point_scope.hpp"
#include "core/base/view_check.hpp"
#include "core/mesh/closed.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/search/rest_gaps.hpp"
#include "core/surface/surface.hpp"

namespace graze {
namespace {

void add_problem(CallQueue::Chain& calls, ObjectId object, DiagnosticKind kind, std::string message) {
  calls.add(Diagnostic{object, kind, std::move(message)});
}

void add_stale(CallQueue::Chain& calls, ObjectId object, const char* what) {
  add_problem(calls, object, DiagnosticKind::stale_id,
              std::string(what) + ": id " + std::to_string(object.index) + ":" +
                  std::to_string(object.generation) + " names no object of this scene");
}

/// The name of a call that takes a pair out or puts it back.
const char* name_of_call(bool ignored) {
  return ignored ? "ignore" : "watch";
}

/// Returns the groups of a mesh's faces, or null if all are in group 0 and none is hidden. Throws Error if
/// they are not one for each face.
std::shared_ptr<const FaceGroups> face_groups_of(const IndexedMesh& mesh,
                                                 std::span<const std::uint8_t> groups,
                                                 std::span<const std::uint8_t> hidden,
                                                 const std::string& who) {
  if (groups.empty() && std::find(hidden.begin(), hidden.end(), 0) == hidden.end()) return nullptr;
  if (!groups.empty() && groups.size() != mesh.face_count())
    throw Error(who + ": face_groups has " + std::to_string(groups.size()) + " groups for " +
                std::to_string(mesh.face_count()) + " faces; give one for each face, or none");
  return std::make_shared<const FaceGroups>(mesh, groups, hidden);
}

/// Returns what is left out where a surface is tested against itself, or null if it is not.
std::shared_ptr<const SelfExclusion> self_exclusion_of(const Surface& surface,
                                                       const ObjectSettings& settings) {
  if (!settings.self) return nullptr;
  return make_self_exclusion(surface.shared_mesh(), settings.self_rings);
}

/// Throws Error if the surface of a solid is not closed.
void check_solid(const Mesh& mesh, const ObjectSettings& settings, const std::string& who) {
  if (!settings.solid) return;
  if (const auto problem = why_not_closed(indexed(mesh)))
    throw Error(who + ": a solid has a closed surface; " + *problem);
}

DiagnosticKind diagnostic_kind_of(const ViewProblem& problem) {
  switch (problem.kind) {
    case ViewProblem::Kind::wrong_count:
      return DiagnosticKind::wrong_count;
    case ViewProblem::Kind::null_memory:
      return DiagnosticKind::null_memory;
    case ViewProblem::Kind::misaligned_memory:
      break;
  }
  return DiagnosticKind::misaligned_memory;
}

/// Returns whether a view can be the positions of an object, and adds a diagnostic if not.
bool check_view(CallQueue::Chain& calls, ObjectId object, const NamedObject& named, const Mesh& mesh,
                const PositionView& view, const char* what) {
  const auto problem = problem_of_view(view, mesh.vertex_count());
  if (!problem) return true;
  add_problem(calls, object, diagnostic_kind_of(*problem),
              std::string(what) + ": " + name_of(object, named) + " got " + problem->got);
  return false;
}

/// The number of vertices that one pass copies and a second pass reads while they are in a cache.
constexpr std::uint32_t vertices_of_pass = 1024;

/// Copies the positions that faces use from `begin` to `end`.
void copy_some(const IndexedMesh& mesh, const PositionView& view, CopiedPositions& positions,
               std::uint32_t begin, std::uint32_t end) {
  const std::size_t each = positions.view().stride_bytes();
  const auto* const from = static_cast<const std::byte*>(view.data());
  std::byte* const to = positions.data();
  if (mesh.uses_all_vertices() && view.has_joined_coordinates() && view.stride_bytes() == each) {
    std::memcpy(to + begin * each, from + begin * each, (end - begin) * each);
    return;
  }
  const std::size_t piece = view.has_joined_coordinates() ? each : each / 3;
  for (std::size_t vertex = begin; vertex < end; ++vertex) {
    if (!mesh.is_used(static_cast<std::uint32_t>(vertex))) continue;
    const std::byte* const point = from + vertex * view.stride_bytes();
    for (std::size_t done = 0, axis = 0; done < each; done += piece, ++axis)
      std::memcpy(to + vertex * each + done, point + axis * view.coordinate_stride_bytes(), piece);
  }
}

/// Copies the positions that faces use and finds their box. Ends where one is not finite or beyond 2^120.
Surface::PartSeen copy_used(const IndexedMesh& mesh, const PositionView& view, CopiedPositions& positions) {
  Surface::PartSeen all;
  const std::uint32_t count = mesh.vertex_count();
  for (std::uint32_t begin = 0; begin < count; begin += vertices_of_pass) {
    const std::uint32_t end = std::min(begin + vertices_of_pass, count);
    copy_some(mesh, view, positions, begin, end);
    all.add(Surface::survey(mesh, positions.view(), begin, end));
    if (all.bad_vertex != Surface::ReadResult::no_vertex) break;
  }
  return all;
}

}  // namespace

// ---- What is lost

void Staging::lose(ObjectId object, std::uint8_t lost) noexcept {
  if (const ObjectIds::Pin pinned = ids_.pin(object))
    ids_.lose(object.index, lost);
  else
    unnamed_lost_.store(true, std::memory_order_relaxed);
}

template <typename Make>
void Staging::make_or_lose(ObjectId object, std::uint8_t lost, const Make& make) noexcept {
  try {
    make();
  } catch (...) {
    lose(object, lost);
  }
}

void Staging::lose_binding(ObjectId object) noexcept {
  if (const ObjectIds::Pin named = ids_.pin(object)) named->binding.stands = false;
  lose(object, LostCalls::any | LostCalls::motion | LostCalls::binding);
}

Diagnostic Staging::lost_call(ObjectId object) {
  const bool has_object = contains(object);
  return {object, DiagnosticKind::out_of_memory,
          (has_object ? name(object) + ": there was" : std::string("there was")) +
              " no memory for a call, which was not taken up as it was made"};
}

void Staging::step_failed() noexcept {
  const std::lock_guard lock(bindings_);
  ids_.return_lost();
  if (failed_ + 1 != steps_) failed_after_ = steps_ - 1;
  failed_ = steps_;
}

bool Staging::has_step_read(const Binding& binding) const {
  return binding.steps_before < (failed_ == steps_ ? failed_after_ : steps_);
}

// ---- Calls

AddObject addition_of(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings) {
  const FloatingPointScope scope;
  if (mesh == nullptr) throw Error("object '" + settings.name + "': there is no mesh");
  if (const auto problem = problem_of(settings)) throw Error(*problem);
  const std::string who = "object '" + settings.name + "'";
  check_solid(*mesh, settings, who);
  AddObject call{{},       std::make_unique<Surface>(mesh),
                 settings, face_groups_of(indexed(*mesh), settings.face_groups, settings.hidden_groups, who),
                 {},       std::move(mesh)};
  call.self = self_exclusion_of(*call.surface, settings);
  return call;
}

ObjectId Staging::add(AddObject call) {
  const ObjectId object = call.object = ids_.allocate(call.mesh, call.settings);
  Calls calls(queue_);
  try {
    calls.add(std::move(call));
  } catch (...) {
    ids_.cancel(object);
    throw;
  }
  // The id becomes valid once the object's addition is queued, so that no call about it comes before.
  calls.push();
  ids_.publish(object);
  return object;
}

namespace {

/// Throws Error unless the map of a replacement fits the new mesh.
void check_map(const Mesh& mesh, std::span<const std::uint32_t> new_of_old) {
  for (std::size_t old = 0; old < new_of_old.size(); ++old)
    if (new_of_old[old] >= mesh.vertex_count() && new_of_old[old] != Mesh::no_vertex)
      throw Error("replace_mesh: new_of_old maps vertex " + std::to_string(old) + " to " +
                  std::to_string(new_of_old[old]) + ", but the new mesh has " +
                  std::to_string(mesh.vertex_count()) + " vertices");
}

}  // namespace

void Staging::replace_mesh(ObjectId object, std::shared_ptr<const Mesh> mesh,
                           std::span<const std::uint32_t> new_of_old,
                           std::span<const std::uint8_t> face_groups) {
  if (mesh == nullptr) throw Error("replace_mesh: there is no mesh");
  check_map(*mesh, new_of_old);
  ObjectSettings settings;
  if (const ObjectIds::Pin named = ids_.pin(object)) {
    check_solid(*mesh, named->settings, "replace_mesh");
    settings = named->settings;
  }
  const FloatingPointScope scope;
  ReplaceMesh call{object,
                   std::make_unique<Surface>(mesh),
                   {new_of_old.begin(), new_of_old.end()},
                   {face_groups.begin(), face_groups.end()},
                   face_groups_of(indexed(*mesh), face_groups, settings.hidden_groups, "replace_mesh"),
                   {},
                   mesh};
  call.self = self_exclusion_of(*call.surface, settings);
  const std::lock_guard lock(bindings_);
  Calls calls(queue_);
  const ObjectIds::Pin named = ids_.pin(object);
  if (!named) return add_stale(calls, object, "replace_mesh");
  const std::uint32_t old_count = named->mesh.get().mesh->vertex_count();
  if (new_of_old.size() != old_count)
    throw Error("replace_mesh: " + name_of(object, *named) + " has " + std::to_string(old_count) +
                " vertices, but new_of_old has " + std::to_string(new_of_old.size()) + " entries");
  calls.add(std::move(call));
  calls.push();
  // Whoever knows the new mesh from here on makes calls that come after this one.
  named->mesh.replace(std::move(mesh));
  named->binding.stands = false;
}

void Staging::remove(ObjectId object) {
  ObjectIds::Pin pinned = ids_.pin(object);
  Calls calls(queue_);
  if (!pinned || !ids_.remove(object))
    return make_or_lose(object, LostCalls::any, [&] { add_stale(calls, object, "remove"); });
  end_binding(*pinned);
  // The removal is queued while the object is pinned, so before the index is allocated again. So it comes
  // before the next addition with this index.
  try {
    calls.add(RemoveObject{object});
  } catch (...) {
    const std::lock_guard lock(
        bindings_);  // so that a step that collects this loss has collected the addition
    ids_.lose(object.index, LostCalls::removal);
    pinned.keep();
  }
}

ObjectId Staging::name_ghost(const AddObject& ghost) {
  const ObjectId id = ids_.allocate(ghost.mesh, ghost.settings);
  ids_.publish(id);
  return id;
}

void Staging::forget_ghost(ObjectId ghost) {
  const ObjectIds::Pin pinned = ids_.pin(ghost);
  if (pinned) (void)ids_.remove(ghost);
}

SparePositions::Loan Staging::copy_for_ghost(ObjectId ghost, const PositionView& positions) {
  const ObjectIds::Pin pinned = ids_.pin(ghost);
  SparePositions::Loan copy = ids_.lend_positions(*pinned, positions.size(), positions.is_double());
  std::memcpy(copy->data(), positions.data(), positions.size() * positions.stride_bytes());
  return copy;
}

/// Adds that an object jumps, where it is one of the scene.
void Staging::try_jump(Calls& calls, ObjectId object) noexcept {
  make_or_lose(object, LostCalls::any, [&] {
    if (contains(object)) calls.add(MarkTeleport{object});
  });
}

void Staging::set_pose(ObjectId object, const std::array<double, 12>& rows, bool jumps) {
  const FloatingPointScope scope;
  Calls calls(queue_);
  if (jumps) try_jump(calls, object);
  make_or_lose(object, LostCalls::any, [&] { add_pose(calls, object, rows); });
}

void Staging::set_pose(ObjectId object, const std::array<double, 16>& rows) {
  const FloatingPointScope scope;
  Calls calls(queue_);
  std::array<double, 12> upper;
  std::copy_n(rows.begin(), upper.size(), upper.begin());
  make_or_lose(object, LostCalls::any, [&] {
    add_pose(calls, object, upper, {rows[12], rows[13], rows[14], rows[15]});
  });
}

void Staging::set_poses(std::span<const ObjectId> objects, std::span<const double> matrices, bool jumps) {
  const FloatingPointScope scope;
  Calls calls(queue_);
  if (!check_sizes(calls, objects.size(), matrices.size() / 16, "set_poses", "poses")) return;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (jumps) try_jump(calls, objects[i]);
    make_or_lose(objects[i], LostCalls::any,
                 [&] { add_pose(calls, objects[i], rows_of(matrices.subspan(16 * i).first<16>())); });
  }
}

void Staging::add_pose(Calls& calls, ObjectId object, const std::array<double, 12>& rows,
                       const std::array<double, 4>& last_row) {
  const ObjectIds::Standing standing = ids_.standing(object);
  if (standing == ObjectIds::Standing::stale) return add_stale(calls, object, "set_pose");
  if (standing == ObjectIds::Standing::deformable)
    return add_problem(calls, object, DiagnosticKind::wrong_motion,
                       name(object) + " is deformable; give it positions, not a pose");
  if (const auto problem = problem_of_pose(rows, last_row))
    return calls.add(RefusePose{
        {object, DiagnosticKind::bad_pose, name(object) + ": " + *problem + "; the pose was not taken"}});
  calls.add(SetPose{object, rows});
}

void Staging::set_positions(ObjectId object, const PositionView& positions, double max_displacement,
                            bool jumps) {
  const FloatingPointScope scope;
  Calls calls(queue_);
  if (jumps) try_jump(calls, object);
  try_positions(calls, object, positions, max_displacement);
}

void Staging::set_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                            double max_displacement, bool jumps) {
  const FloatingPointScope scope;
  Calls calls(queue_);
  if (!check_sizes(calls, objects.size(), positions.size(), "set_positions", "views of positions")) return;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (jumps) try_jump(calls, objects[i]);
    try_positions(calls, objects[i], positions[i], max_displacement);
  }
}

void Staging::try_positions(Calls& calls, ObjectId object, const PositionView& positions,
                            double max_displacement) noexcept {
  try {
    add_positions(calls, object, positions, max_displacement);
  } catch (...) {
    const std::lock_guard lock(bindings_);
    lose_binding(object);
  }
}

void Staging::add_positions(Calls& calls, ObjectId object, const PositionView& positions,
                            double max_displacement) {
  if (!check_deformable(calls, object, "set_positions")) return;
  const ObjectIds::Pin named = ids_.pin(object);
  if (!named) return add_stale(calls, object, "set_positions");
  const auto [mesh, mesh_number] = named->mesh.get();
  if (!check_view(calls, object, *named, *mesh, positions, "set_positions")) return;
  const double promise = promise_of(calls, object, max_displacement, "set_positions");
  std::optional<Diagnostic> problem;
  SetPositions call{object, {}, {}, promise, mesh_number};
  call.positions = copy_good(object, *named, *mesh, positions, "the old positions stand", call.box, problem);
  if (problem) return calls.add(std::move(*problem));
  end_binding(*named, mesh_number);
  calls.add(std::move(call));
}

SparePositions::Loan Staging::copy_good(ObjectId object, NamedObject& named, const Mesh& mesh,
                                        const PositionView& view, const char* consequence, Box& box,
                                        std::optional<Diagnostic>& problem) {
  SparePositions::Loan positions = ids_.lend_positions(named, view.size(), view.is_double());
  const Surface::PartSeen all = copy_used(indexed(mesh), view, *positions);
  box = all.box;
  if (all.bad_vertex == Surface::ReadResult::no_vertex) return positions;
  const bool finite = all.bad_position.allFinite();
  problem = Diagnostic{
      object, finite ? DiagnosticKind::too_large : DiagnosticKind::not_finite,
      name_of(object, named) + ": " + bad_vertex_text(all.bad_vertex, all.bad_position) + "; " + consequence};
  return nullptr;
}

void Staging::bind_positions(ObjectId object, const PositionView& positions, BindPolicy policy) {
  const std::lock_guard lock(bindings_);
  Calls calls(queue_);
  try_binding(calls, object, positions, policy);
}

void Staging::bind_positions(std::span<const ObjectId> objects, std::span<const PositionView> positions,
                             BindPolicy policy) {
  const std::lock_guard lock(bindings_);
  Calls calls(queue_);
  if (!check_sizes(calls, objects.size(), positions.size(), "bind_positions", "views of positions")) return;
  for (std::size_t i = 0; i < objects.size(); ++i) try_binding(calls, objects[i], positions[i], policy);
}

void Staging::try_binding(Calls& calls, ObjectId object, const PositionView& positions,
                          BindPolicy policy) noexcept {
  try {
    add_binding(calls, object, positions, policy);
  } catch (...) {
    lose_binding(object);
  }
}

void Staging::add_binding(Calls& calls, ObjectId object, const PositionView& positions, BindPolicy policy) {
  if (!check_deformable(calls, object, "bind_positions")) return;
  const ObjectIds::Pin named = ids_.pin(object);
  if (!named) return add_stale(calls, object, "bind_positions");
  if (!check_view(calls, object, *named, *named->mesh.get().mesh, positions, "bind_positions")) return;
  calls.add(BindPositions{object, positions, policy});
  named->binding.view = positions;
  named->binding.policy = policy;
  named->binding.steps_before = steps_;
  named->binding.stands = true;
}

void Staging::unbind_positions(ObjectId object) {
  const FloatingPointScope scope;
  const std::lock_guard lock(bindings_);
  Calls calls(queue_);
  try {
    add_unbinding(calls, object);
  } catch (...) {
    lose_binding(object);
  }
}

void Staging::add_unbinding(Calls& calls, ObjectId object) {
  if (!check_deformable(calls, object, "unbind_positions")) return;
  const ObjectIds::Pin named = ids_.pin(object);
  if (!named) return add_stale(calls, object, "unbind_positions");
  UnbindPositions call;
  call.object = object;
  Binding& binding = named->binding;
  if (binding.stands.exchange(false)) {
    call.is_due = binding.policy == BindPolicy::every_step || !has_step_read(binding);
    call.positions = copy_good(object, *named, *named->mesh.get().mesh, binding.view,
                               "it stands still until it is given good positions", call.box, call.problem);
  }
  calls.add(std::move(call));
}

void Staging::end_binding(NamedObject& object) {
  if (!object.binding.stands) return;
  const std::lock_guard lock(bindings_);
  object.binding.stands = false;
}

/// Positions of a mesh that was replaced meanwhile count as given before, and end no binding of the new mesh.
void Staging::end_binding(NamedObject& object, std::uint64_t mesh_number) {
  if (!object.binding.stands) return;
  const std::lock_guard lock(bindings_);
  if (object.mesh.get().number == mesh_number) object.binding.stands = false;
}

void Staging::positions_changed(ObjectId object, double max_displacement, bool jumps) {
  Calls calls(queue_);
  if (jumps) try_jump(calls, object);
  try_change(calls, object, max_displacement);
}

void Staging::positions_changed(std::span<const ObjectId> objects, double max_displacement, bool jumps) {
  Calls calls(queue_);
  for (const ObjectId object : objects) {
    if (jumps) try_jump(calls, object);
    try_change(calls, object, max_displacement);
  }
}

void Staging::positions_changed(std::span<const ObjectId> objects,
                                std::span<const double> max_displacements) {
  Calls calls(queue_);
  if (!check_sizes(calls, objects.size(), max_displacements.size(), "positions_changed", "promises")) return;
  for (std::size_t i = 0; i < objects.size(); ++i) try_change(calls, objects[i], max_displacements[i]);
}

/// Adds the call. If there is no memory for it, the next step reads the positions without a promise.
void Staging::try_change(Calls& calls, ObjectId object, double max_displacement) noexcept {
  make_or_lose(object, LostCalls::any | LostCalls::motion, [&] {
    if (check_deformable(calls, object, "positions_changed"))
      calls.add(PositionsChanged{object, promise_of(calls, object, max_displacement, "positions_changed")});
  });
}

void Staging::set_ignored(ObjectId a, ObjectId b, bool ignored) {
  Calls calls(queue_);
  make_or_lose(a, LostCalls::any, [&] { add_ignored(calls, a, b, ignored); });
}

void Staging::set_ignored(ObjectId a, std::uint8_t group_a, ObjectId b, std::uint8_t group_b, bool ignored) {
  Calls calls(queue_);
  make_or_lose(a, LostCalls::any, [&] {
    if (check_both(calls, a, b, ignored)) calls.add(IgnoreGroups{a, group_a, b, group_b, ignored});
  });
}

bool Staging::check_both(Calls& calls, ObjectId a, ObjectId b, bool ignored) const {
  for (const ObjectId object : {a, b}) {
    if (contains(object)) continue;
    add_stale(calls, object, name_of_call(ignored));
    return false;
  }
  return true;
}

void Staging::add_ignored(Calls& calls, ObjectId a, ObjectId b, bool ignored) {
  if (!check_both(calls, a, b, ignored)) return;
  if (a == b)
    return add_problem(calls, a, DiagnosticKind::bad_pair,
                       std::string(name_of_call(ignored)) + ": " + name(a) + " makes no pair with itself");
  calls.add(IgnorePair{a, b, ignored});
}

void Staging::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  const FloatingPointScope scope;
  Calls calls(queue_);
  make_or_lose({}, LostCalls::any, [&] {
    if (const auto problem = problem_of(kind_a, kind_b, rule))
      add_problem(calls, {}, DiagnosticKind::bad_rule, *problem + "; the rule was not taken");
    else
      calls.add(SetRule{kind_a, kind_b, rule});
  });
}

void Staging::reserve(const SceneCapacity& capacity) {
  ids_.reserve(capacity.objects);
  queue_.reserve(capacity.calls_per_step);
  Calls calls(queue_);
  calls.add(Reserve{capacity});
}

bool Staging::check_sizes(Calls& calls, std::size_t objects, std::size_t things, const char* what,
                          const char* name_of_things) noexcept {
  if (objects == things) return true;
  make_or_lose({}, LostCalls::any, [&] {
    add_problem(calls, {}, DiagnosticKind::wrong_count,
                std::string(what) + ": got " + std::to_string(objects) + " objects and " +
                    std::to_string(things) + " " + name_of_things + "; none was taken");
  });
  return false;
}

bool Staging::check_deformable(Calls& calls, ObjectId object, const char* what) {
  const ObjectIds::Standing standing = ids_.standing(object);
  if (standing == ObjectIds::Standing::deformable) return true;
  if (standing == ObjectIds::Standing::stale)
    add_stale(calls, object, what);
  else
    add_problem(calls, object, DiagnosticKind::wrong_motion,
                std::string(what) + ": " + name(object) + " is not deformable; move it by set_pose");
  return false;
}

double Staging::promise_of(Calls& calls, ObjectId object, double max_displacement, const char* what) {
  // This comparison is quiet, since NaN must not trap if the caller has enabled traps.
  if (std::isgreaterequal(max_displacement, 0.0)) return max_displacement;
  add_problem(calls, object, DiagnosticKind::broken_promise,
              std::string(what) + ": " + name(object) +
                  " got a max_displacement that is negative or NaN; it counts as no promise");
  return std::numeric_limits<double>::infinity();
}

std::string Staging::name(ObjectId object) {
  const ObjectIds::Pin named = ids_.pin(object);
  return named ? name_of(object, *named) : number_of(object);
}

}  // namespace graze
