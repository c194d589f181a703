#pragma once

#include <cstdint>
#include <functional>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "recording/records.hpp"

namespace graze {

/// Checks the records of a recording, one after the other, before anything uses them. Each has to fit the
/// objects that the records before it made, so that a scene takes it up.
///
/// A recorder writes the calls that its scene took up. What the scene refused stands in the recording as a
/// Diagnostic. So a record that does not fit was not written by a recorder. A record about an object that is
/// not there is fine: two threads of the recorded program may have removed and moved it at the same time.
class RecordCheck {
 public:
  /// Gives the mesh of a number in the recording, or throws Error.
  using MeshOf = std::function<std::shared_ptr<const Mesh>(std::uint32_t)>;

  explicit RecordCheck(MeshOf mesh_of) : mesh_of_(std::move(mesh_of)) {}

  /// Begins again with a scene that has no object.
  void clear();
  /// Throws Error, which says what does not fit.
  // NOLINTNEXTLINE(readability-convert-member-functions-to-static): only some that it calls are
  void check(const Record& record) {
    std::visit([&](const auto& one) { take(one); }, record);
  }

 private:
  struct Object {
    std::uint64_t serial = 0;
    std::shared_ptr<const Mesh> mesh;
    bool is_deformable = true;
    bool is_solid = false;
    std::optional<bool> bound_in_double;  ///< the form of the memory that it is bound to
  };
  [[nodiscard]] Object* find(ObjectId id);
  /// The object that a record moves by positions or by poses. Null if it is not there.
  [[nodiscard]] Object* find_deformable(ObjectId id, const char* what);
  [[nodiscard]] Object* find_posed(ObjectId id, const char* what);

  void take(const AddRecord& record);
  void take(const ReplaceRecord& record);
  void take(const RemoveObject& record) { objects_.erase(record.object); }
  static void take(const MarkTeleport&) {}
  void take(const SetPose& record);
  void take(const RefusePose& record);
  void take(const SettlePose& record) { (void)find_posed(record.object, "a place"); }
  void take(const PositionsRecord& record);
  void take(const BindRecord& record);
  void take(const MemoryRecord& record);
  void take(const UnbindRecord& record);
  void take(const PositionsChanged& record);
  static void take(const IgnorePair& record);
  static void take(const IgnoreGroups&) {}
  static void take(const SetRule& record);
  static void take(const Reserve&) {}     // a replay reserves nothing
  static void take(const Diagnostic&) {}  // any text of any object

  MeshOf mesh_of_;
  std::unordered_map<ObjectId, Object> objects_;
  std::unordered_set<ObjectId> given_;  ///< every id so far, since no id is given twice
  std::optional<std::uint64_t> last_serial_;
};

}  // namespace graze
