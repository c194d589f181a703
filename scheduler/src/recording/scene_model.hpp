#pragma once

#include <array>
#include <cstdint>
#include <graze/settings.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "recording/byte_buffer.hpp"
#include "recording/records.hpp"

namespace graze {

/// Positions that a model keeps, packed, as the caller gave them.
class KeptPositions {
 public:
  [[nodiscard]] bool is_empty() const { return count_ == 0; }
  [[nodiscard]] PositionView view() const;
  /// Whether these are the same numbers, by their bits.
  [[nodiscard]] bool is_same(const PositionView& packed) const;
  /// Copies packed positions, such as those of a record that was read.
  void take(const PositionView& packed);
  /// A copy, or the rest shape where these are none or of the other precision.
  [[nodiscard]] KeptPositions in_form(std::span<const Eigen::Vector3d> rest, bool is_double) const;
  void clear() { count_ = 0; }
  /// Gives all coordinates one value.
  void fill(double coordinate);

 private:
  ByteBuffer bytes_;
  std::size_t count_ = 0;
  bool is_double_ = true;
};

/// One object of a scene, as the calls so far say.
struct ModelObject {
  std::uint64_t serial = 0;  ///< ascends in the order of addition
  std::uint32_t mesh = 0;
  ObjectSettings settings;
  std::optional<std::array<double, 12>> pose;
  std::optional<std::array<double, 12>> last_pose;  ///< before this frame, if `is_posed`
  bool is_posed = false;                            ///< by this frame
  bool was_seen = false;                            ///< it was not frozen when a frame ended
  KeptPositions positions;                          ///< empty where it stands at rest
  std::optional<BindRecord> binding;
  /// The call that froze it, where it has no binding whose bad memory does so.
  std::optional<std::variant<RefusePose, UnbindRecord>> frozen_by;
};

/// A scene's input, made from the calls on it: where each object is, and which pairs are tested. It says
/// nothing of what steps remember.
class SceneModel {
 public:
  SceneModel() = default;

  /// Takes up one record. Records about an object that is not there change nothing.
  void apply(const Record& record);
  /// Ends the records of a frame.
  void end_frame();
  /// Whether memory that an object is bound to is known to hold these positions.
  [[nodiscard]] bool holds(const MemoryRecord& record) const;

  /// Calls `visit(record)` with records that make this scene from an empty one.
  template <typename Visit>
  void rebuild(const Visit& visit) const {
    for (const auto& [serial, id] : by_serial_) rebuild_object(id, objects_.at(id), visit);
    for (const auto& [kinds, rule] : rules_) visit(Record(SetRule{kinds.first, kinds.second, rule}));
    for (const auto& [a, b] : ignored_) visit(Record(IgnorePair{a, b, true}));
    for (const auto& [a, b] : ignored_groups_)
      visit(Record(IgnoreGroups{a.object, a.group, b.object, b.group, true}));
  }

  [[nodiscard]] const ModelObject* find(ObjectId id) const;
  void clear() { *this = SceneModel(); }

 private:
  /// A group of an object's faces.
  struct GroupOf {
    ObjectId object;
    std::uint8_t group = 0;

    friend auto operator<=>(const GroupOf&, const GroupOf&) = default;
  };

  template <typename Visit>
  static void rebuild_object(ObjectId id, const ModelObject& object, const Visit& visit) {
    visit(Record(AddRecord{id, object.serial, object.mesh, object.settings}));
    if (object.pose) visit(Record(SetPose{id, *object.pose}));
    if (object.was_seen && object.settings.motion != Motion::deformable) visit(Record(SettlePose{id}));
    if (object.binding) visit(Record(*object.binding));
    if (!object.positions.is_empty()) {
      if (object.binding)
        visit(Record(MemoryRecord{id, object.positions.view()}));
      else
        visit(Record(PositionsRecord{id, std::numeric_limits<double>::infinity(), object.positions.view()}));
    }
    if (!object.frozen_by) return;
    // Only the end of a binding freezes what moves by positions.
    if (std::holds_alternative<UnbindRecord>(*object.frozen_by)) visit(Record(BindRecord{id}));
    std::visit([&](const auto& call) { visit(Record(call)); }, *object.frozen_by);
  }
  ModelObject* find(ObjectId id) { return const_cast<ModelObject*>(std::as_const(*this).find(id)); }
  void take(const AddRecord& record);
  void take(const ReplaceRecord& record);
  void take(const RemoveObject& record);
  void take(const SetPose& record);
  void take(const RefusePose& record);
  void take(const SettlePose& record);
  void take(const PositionsRecord& record);
  void take(const BindRecord& record);
  void take(const MemoryRecord& record);
  void take(const UnbindRecord& record);
  void take(const PositionsChanged&) {}
  void take(const MarkTeleport&) {}
  void take(const IgnorePair& record);
  void take(const IgnoreGroups& record);
  void take(const SetRule& record);
  void take(const Reserve&) {}
  void take(const Diagnostic&) {}

  std::map<ObjectId, ModelObject> objects_;
  std::map<std::uint64_t, ObjectId> by_serial_;
  std::vector<ObjectId> of_frame_;  ///< objects that this frame has added or posed, or given another mesh
  std::map<std::pair<std::uint32_t, std::uint32_t>, PairRule> rules_;  ///< by kinds, the lower first
  std::set<std::pair<ObjectId, ObjectId>> ignored_;
  std::set<std::pair<GroupOf, GroupOf>> ignored_groups_;
};

}  // namespace graze
