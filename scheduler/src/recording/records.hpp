#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/settings_fields.hpp>
#include <limits>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "calls/calls.hpp"

namespace graze {

// The calls on a scene, as a recording holds them. This is the one list of them: the writer, the reader, the
// model of the scene and the replay are made from it. A new kind of call does not compile until it stands
// here.
//
// Positions of a record are viewed and not owned. Positions of size 0 are left out.

struct AddRecord {
  ObjectId object;
  std::uint64_t serial = 0;  ///< ascends in the order of addition
  std::uint32_t mesh = 0;    ///< the number of a mesh in the recording
  ObjectSettings settings;
};
struct PositionsRecord {
  ObjectId object;
  double max_displacement = std::numeric_limits<double>::infinity();
  PositionView positions;
};
struct BindRecord {
  ObjectId object;
  BindPolicy policy = BindPolicy::every_step;
  bool is_double = true;
};
/// The content of bound memory when a step began, where it is not what the recording says last.
struct MemoryRecord {
  ObjectId object;
  PositionView positions;
};
struct UnbindRecord {
  ObjectId object;
  bool is_lost = false;
  bool is_frozen = false;  ///< the object is frozen without a binding from now on
  /// Why the memory was refused. `stale_id` says that it was not.
  DiagnosticKind problem = DiagnosticKind::stale_id;
  PositionView positions;  ///< what the memory said last
};

struct ReplaceRecord {
  ObjectId object;
  std::uint32_t mesh = 0;                 ///< the number of a mesh in the recording
  std::vector<std::uint32_t> new_of_old;  ///< as in ReplaceMesh
  std::vector<std::uint8_t> face_groups;  ///< as in ReplaceMesh
};

/// Any record. The number of a kind in a recording is its place here, so kinds are added at the end.
using Record = std::variant<AddRecord, RemoveObject, SetPose, RefusePose, PositionsRecord, BindRecord,
                            MemoryRecord, UnbindRecord, PositionsChanged, IgnorePair, SetRule, Reserve,
                            Diagnostic, IgnoreGroups, ReplaceRecord, MarkTeleport, SettlePose>;

/// `Type`, or a constant of it.
template <typename Candidate, typename Type>
concept Is = std::same_as<std::remove_const_t<Candidate>, Type>;

// The fields of each record and of what records are made of, in the order in which they stand in a recording.

/// Every field of settings, in the order of their lists.
template <typename T>
requires HasSettingsFields<std::remove_const_t<T>>
auto fields(T& r) {
  return std::apply([&](const auto&... field) { return std::tie(r.*field.member...); },
                    settings_fields<std::remove_const_t<T>>);
}
template <Is<Diagnostic> T>
auto fields(T& r) {
  return std::tie(r.object, r.kind, r.message);
}
template <Is<AddRecord> T>
auto fields(T& r) {
  return std::tie(r.object, r.serial, r.mesh, r.settings);
}
template <Is<RemoveObject> T>
auto fields(T& r) {
  return std::tie(r.object);
}
template <Is<SetPose> T>
auto fields(T& r) {
  return std::tie(r.object, r.rows);
}
template <Is<RefusePose> T>
auto fields(T& r) {
  return std::tie(r.problem);
}
template <Is<PositionsRecord> T>
auto fields(T& r) {
  return std::tie(r.object, r.max_displacement, r.positions);
}
template <Is<BindRecord> T>
auto fields(T& r) {
  return std::tie(r.object, r.policy, r.is_double);
}
template <Is<MemoryRecord> T>
auto fields(T& r) {
  return std::tie(r.object, r.positions);
}
template <Is<UnbindRecord> T>
auto fields(T& r) {
  return std::tie(r.object, r.is_lost, r.is_frozen, r.problem, r.positions);
}
template <Is<PositionsChanged> T>
auto fields(T& r) {
  return std::tie(r.object, r.max_displacement);
}
template <Is<IgnorePair> T>
auto fields(T& r) {
  return std::tie(r.a, r.b, r.ignored);
}
template <Is<IgnoreGroups> T>
auto fields(T& r) {
  return std::tie(r.a, r.group_a, r.b, r.group_b, r.ignored);
}
template <Is<SetRule> T>
auto fields(T& r) {
  return std::tie(r.kind_a, r.kind_b, r.rule);
}
template <Is<ReplaceRecord> T>
auto fields(T& r) {
  return std::tie(r.object, r.mesh, r.new_of_old, r.face_groups);
}
template <Is<MarkTeleport> T>
auto fields(T& r) {
  return std::tie(r.object);
}
template <Is<SettlePose> T>
auto fields(T& r) {
  return std::tie(r.object);
}
template <Is<Reserve> T>
auto fields(T& r) {
  return std::tie(r.capacity);
}

}  // namespace graze
