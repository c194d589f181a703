#include "staging.hpp"

#include <cmath>
#include <cstdint>
#include <graze/error.hpp>
#include <graze/floating_point_scope.hpp>
#include <limits>
#include <utility>

#include "object_name.hpp"
#include "pose.hpp"
#include "settings_check.hpp"

namespace graze {
namespace {

/// The first vertex a face uses whose position is not finite or beyond 2^120; copies the used positions on
/// the way.
std::uint32_t copy_used(const Mesh& mesh, const PositionView& view, std::vector<Eigen::Vector3d>& positions) {
  positions.assign(mesh.vertex_count(), Eigen::Vector3d::Zero());
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex) {
    if (!mesh.is_used(vertex)) continue;
    positions[vertex] = view[vertex];
    if (!Surface::is_within_limits(positions[vertex])) return vertex;
  }
  return Surface::ReadResult::no_vertex;
}

}  // namespace

ObjectId Staging::add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings) {
  if (mesh == nullptr) throw Error("object '" + settings.name + "': there is no mesh");
  if (const auto problem = problem_of(settings)) throw Error(*problem);
  const FloatingPointScope scope;
  auto surface = std::make_unique<Surface>(mesh);
  const std::lock_guard lock(mutex_);
  std::uint32_t index = 0;
  if (free_.empty()) {
    index = static_cast<std::uint32_t>(entries_.size());
    entries_.emplace_back();
  } else {
    index = free_.back();
    free_.pop_back();
  }
  entries_[index].named = {std::move(mesh), settings};
  ++object_count_;
  const ObjectId object{index, entries_[index].generation};
  commands_.emplace_back(AddObject{object, std::move(surface), settings});
  return object;
}

void Staging::remove(ObjectId object) {
  if (!find_or_report(object, "remove")) return;
  const std::lock_guard lock(mutex_);
  if (entry_of(object) == nullptr) {
    commands_.emplace_back(
        Diagnostic{object, DiagnosticKind::stale_id, "remove: another thread has just removed the object"});
    return;
  }
  Entry& entry = entries_[object.index];
  entry.named = {};
  // An index whose generations are used up is never given again.
  if (entry.generation != std::numeric_limits<std::uint32_t>::max()) free_.push_back(object.index);
  ++entry.generation;
  --object_count_;
  commands_.emplace_back(RemoveObject{object});
}

void Staging::set_pose(ObjectId object, const std::array<double, 12>& rows) {
  const auto named = find_or_report(object, "set_pose");
  if (!named) return;
  if (named->settings.motion == Motion::deformable)
    return push_problem(object, DiagnosticKind::wrong_motion,
                        name_of(object, *named) + " is deformable; give it positions, not a pose");
  const FloatingPointScope scope;
  if (const auto problem = problem_of_pose(rows))
    return push_problem(object, DiagnosticKind::bad_pose,
                        name_of(object, *named) + ": " + *problem + "; the pose was not taken");
  push(SetPose{object, rows});
}

void Staging::set_positions(ObjectId object, const PositionView& positions, double max_displacement) {
  const auto named = find_deformable(object, "set_positions");
  if (!named || !check_view(object, *named, positions, "set_positions")) return;
  const FloatingPointScope scope;
  SetPositions command{object, {}, promise_of(object, *named, max_displacement, "set_positions")};
  const std::uint32_t bad = copy_used(*named->mesh, positions, command.positions);
  if (bad != Surface::ReadResult::no_vertex) {
    const bool finite = command.positions[bad].allFinite();
    return push_problem(object, finite ? DiagnosticKind::too_large : DiagnosticKind::not_finite,
                        name_of(object, *named) + ": vertex " + std::to_string(bad) +
                            (finite ? " has a coordinate beyond 2^120" : " is not finite") +
                            "; the old positions stand");
  }
  push(std::move(command));
}

void Staging::bind_positions(ObjectId object, const PositionView& positions, BindPolicy policy) {
  const auto named = find_deformable(object, "bind_positions");
  if (!named || !check_view(object, *named, positions, "bind_positions")) return;
  push(BindPositions{object, positions, policy});
}

void Staging::unbind_positions(ObjectId object) {
  if (find_deformable(object, "unbind_positions")) push(UnbindPositions{object});
}

void Staging::positions_changed(ObjectId object, double max_displacement) {
  const auto named = find_deformable(object, "positions_changed");
  if (named)
    push(PositionsChanged{object, promise_of(object, *named, max_displacement, "positions_changed")});
}

void Staging::set_ignored(ObjectId a, ObjectId b, bool ignored) {
  const char* const what = ignored ? "ignore" : "watch";
  const auto named = find_or_report(a, what);
  if (!named || !find_or_report(b, what)) return;
  if (a == b)
    return push_problem(a, DiagnosticKind::bad_pair,
                        std::string(what) + ": " + name_of(a, *named) + " makes no pair with itself");
  push(IgnorePair{a, b, ignored});
}

void Staging::set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule) {
  if (const auto problem = problem_of(kind_a, kind_b, rule))
    return push_problem({}, DiagnosticKind::bad_rule, *problem + "; the rule was not taken");
  push(SetRule{kind_a, kind_b, rule});
}

Staging::Named Staging::find(ObjectId object) const {
  const std::lock_guard lock(mutex_);
  const Entry* const entry = entry_of(object);
  return entry == nullptr ? Named{} : entry->named;
}

std::size_t Staging::object_count() const {
  const std::lock_guard lock(mutex_);
  return object_count_;
}

void Staging::take(std::vector<Command>& commands) {
  commands.clear();
  const std::lock_guard lock(mutex_);
  commands.swap(commands_);
}

void Staging::push(Command command) {
  const std::lock_guard lock(mutex_);
  commands_.push_back(std::move(command));
}

void Staging::push_problem(ObjectId object, DiagnosticKind kind, std::string message) {
  push(Diagnostic{object, kind, std::move(message)});
}

std::optional<Staging::Named> Staging::find_or_report(ObjectId object, const char* what) {
  Named named = find(object);
  if (named.mesh != nullptr) return named;
  push_problem(object, DiagnosticKind::stale_id,
               std::string(what) + ": id " + std::to_string(object.index) + ":" +
                   std::to_string(object.generation) + " names no object of this scene");
  return std::nullopt;
}

std::optional<Staging::Named> Staging::find_deformable(ObjectId object, const char* what) {
  auto named = find_or_report(object, what);
  if (!named || named->settings.motion == Motion::deformable) return named;
  push_problem(
      object, DiagnosticKind::wrong_motion,
      std::string(what) + ": " + name_of(object, *named) + " is not deformable; move it by set_pose");
  return std::nullopt;
}

bool Staging::check_view(ObjectId object, const Named& named, const PositionView& view, const char* what) {
  const std::string call = std::string(what) + ": " + name_of(object, named);
  if (view.size() != named.mesh->vertex_count()) {
    push_problem(object, DiagnosticKind::wrong_count,
                 call + " got " + std::to_string(view.size()) + " positions for " +
                     std::to_string(named.mesh->vertex_count()) + " vertices");
    return false;
  }
  if (view.data() == nullptr) {
    push_problem(object, DiagnosticKind::null_memory, call + " got null memory");
    return false;
  }
  const std::size_t alignment = view.is_double() ? alignof(double) : alignof(float);
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the address is looked at, not used
  if (reinterpret_cast<std::uintptr_t>(view.data()) % alignment != 0 ||
      view.stride_bytes() % alignment != 0) {
    push_problem(object, DiagnosticKind::misaligned_memory,
                 call + " got memory that is not aligned to its numbers");
    return false;
  }
  return true;
}

double Staging::promise_of(ObjectId object, const Named& named, double max_displacement, const char* what) {
  // A quiet comparison: NaN must not trap where the caller has traps enabled.
  if (std::isgreaterequal(max_displacement, 0.0)) return max_displacement;
  push_problem(object, DiagnosticKind::broken_promise,
               std::string(what) + ": " + name_of(object, named) +
                   " got a max_displacement that is negative or NaN; it counts as no promise");
  return std::numeric_limits<double>::infinity();
}

const Staging::Entry* Staging::entry_of(ObjectId object) const {
  if (object.index >= entries_.size()) return nullptr;
  const Entry& entry = entries_[object.index];
  return entry.generation == object.generation && entry.named.mesh != nullptr ? &entry : nullptr;
}

}  // namespace graze
