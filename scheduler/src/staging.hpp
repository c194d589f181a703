#pragma once

#include <array>
#include <graze/mesh.hpp>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <graze/surface.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <variant>
#include <vector>

namespace graze {

/// The calls on a scene, as they wait for the next step. All were found good when they were made.
struct AddObject {
  ObjectId object;
  std::unique_ptr<Surface> surface;  ///< made on the caller's thread
  ObjectSettings settings;
};
struct RemoveObject {
  ObjectId object;
};
struct SetPose {
  ObjectId object;
  std::array<double, 12> rows;
};
struct SetPositions {
  ObjectId object;
  std::vector<Eigen::Vector3d> positions;
  double max_displacement;
};
struct BindPositions {
  ObjectId object;
  PositionView view;
  BindPolicy policy;
};
struct UnbindPositions {
  ObjectId object;
};
struct PositionsChanged {
  ObjectId object;
  double max_displacement;
};
struct IgnorePair {
  ObjectId a;
  ObjectId b;
  bool ignored;
};
struct SetRule {
  std::uint32_t kind_a;
  std::uint32_t kind_b;
  PairRule rule;
};
using Command = std::variant<AddObject, RemoveObject, SetPose, SetPositions, BindPositions, UnbindPositions,
                             PositionsChanged, IgnorePair, SetRule, Diagnostic>;

/// Takes the calls on a scene from any thread and keeps them, in the order in which they were made, until a
/// step takes them up. Ids are given and checked here, so an id is good or stale at the moment of the call.
///
/// One mutex guards the table of ids and the queue; it is held for a push or a look-up, never while data is
/// copied or a step runs.
class Staging {
 public:
  /// Throws Error for no mesh or bad settings.
  ObjectId add(std::shared_ptr<const Mesh> mesh, const ObjectSettings& settings);
  void remove(ObjectId object);
  void set_pose(ObjectId object, const std::array<double, 12>& rows);
  void set_positions(ObjectId object, const PositionView& positions, double max_displacement);
  void bind_positions(ObjectId object, const PositionView& positions, BindPolicy policy);
  void unbind_positions(ObjectId object);
  void positions_changed(ObjectId object, double max_displacement);
  void set_ignored(ObjectId a, ObjectId b, bool ignored);
  void set_rule(std::uint32_t kind_a, std::uint32_t kind_b, const PairRule& rule);

  /// What an id names now; a null mesh where it names nothing.
  struct Named {
    std::shared_ptr<const Mesh> mesh;
    ObjectSettings settings;
  };
  [[nodiscard]] Named find(ObjectId object) const;
  [[nodiscard]] std::size_t object_count() const;

  /// Moves the waiting calls into `commands`, which is emptied first.
  void take(std::vector<Command>& commands);

 private:
  struct Entry {
    std::uint32_t generation = 1;
    Named named;
  };

  void push(Command command);
  void push_problem(ObjectId object, DiagnosticKind kind, std::string message);
  /// The object, or nothing and a diagnostic; `what` is the call's name.
  std::optional<Named> find_or_report(ObjectId object, const char* what);
  std::optional<Named> find_deformable(ObjectId object, const char* what);
  bool check_view(ObjectId object, const Named& named, const PositionView& view, const char* what);
  /// `max_displacement`, or no promise and a diagnostic where it is none.
  double promise_of(ObjectId object, const Named& named, double max_displacement, const char* what);
  [[nodiscard]] const Entry* entry_of(ObjectId object) const;

  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> free_;  ///< indices whose generation has moved on, last freed first
  std::size_t object_count_ = 0;
  std::vector<Command> commands_;
};

}  // namespace graze
