#pragma once

#include <array>
#include <cstdint>
#include <graze/object_id.hpp>
#include <graze/position_view.hpp>
#include <graze/report.hpp>
#include <graze/settings.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "base/pair_place.hpp"
#include "base/spare_positions.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/pair/self_exclusion.hpp"
#include "core/surface/surface.hpp"

namespace graze {

// The calls on a scene that wait for the next step. All were valid when they were made.

struct AddObject {
  ObjectId object;
  std::unique_ptr<Surface> surface;  ///< made on the caller's thread
  ObjectSettings settings;
  std::shared_ptr<const FaceGroups> face_groups;  ///< null if all faces are in group 0, and none is hidden
  std::shared_ptr<const SelfExclusion> self;      ///< null unless it is tested against itself
  std::shared_ptr<const Mesh> mesh;               ///< the surface's
  /// Object::serial, which no other object has. Without it, the object comes behind all others.
  std::optional<std::uint64_t> serial = {};
  PairPlace place = {};  ///< Object::place
};
struct RemoveObject {
  ObjectId object;
};
/// Another mesh in the place of an object's. Its lists fit each other and both meshes.
struct ReplaceMesh {
  ObjectId object;
  std::unique_ptr<Surface> surface;               ///< of the new mesh, made on the caller's thread
  std::vector<std::uint32_t> new_of_old;          ///< the new vertex of each old one, or Mesh::no_vertex
  std::vector<std::uint8_t> group_of_face;        ///< of the new faces, or empty: all are in group 0
  std::shared_ptr<const FaceGroups> face_groups;  ///< as that of AddObject
  std::shared_ptr<const SelfExclusion> self;      ///< as that of AddObject
  std::shared_ptr<const Mesh> mesh;               ///< the new one
};
struct SetPose {
  ObjectId object;
  std::array<double, 12> rows;
};
/// A refused pose. The object's pairs are stale until a good pose comes.
struct RefusePose {
  Diagnostic problem;  ///< names the object
};
/// A new object stands at the pose that this step has set, or at rest, and counts as seen there. Only what
/// makes a scene anew calls this, of an object that an earlier step has seen.
struct SettlePose {
  ObjectId object;
};
struct SetPositions {
  ObjectId object;
  SparePositions::Loan positions;
  Box box;  ///< of these
  double max_displacement = std::numeric_limits<double>::infinity();
  std::uint64_t mesh_number = 0;  ///< of the mesh that they were checked against (NamedMesh)
};
struct BindPositions {
  ObjectId object;
  PositionView view;
  BindPolicy policy;
};
struct UnbindPositions {
  ObjectId object;
  SparePositions::Loan positions;     ///< what the memory says last
  Box box;                            ///< of these
  std::optional<Diagnostic> problem;  ///< in their place, where they are bad
  bool is_due = false;                ///< the next step would have read the memory
  bool is_lost = false;               ///< there was no memory for the copy
};
struct PositionsChanged {
  ObjectId object;
  double max_displacement;
};
/// The object has come by a jump to where it is at the next step.
struct MarkTeleport {
  ObjectId object;
};
struct IgnorePair {
  ObjectId a;
  ObjectId b;
  bool ignored;
};
/// Faces of one group of a that are ignored or watched against faces of one group of b.
struct IgnoreGroups {
  ObjectId a;
  std::uint8_t group_a;
  ObjectId b;
  std::uint8_t group_b;
  bool ignored;
};
struct SetRule {
  std::uint32_t kind_a;
  std::uint32_t kind_b;
  PairRule rule;
};
struct Reserve {
  SceneCapacity capacity;
};

/// Any call. An applied call is replaced by an empty RemoveObject, which holds no memory.
using Call = std::variant<RemoveObject, AddObject, SetPose, RefusePose, SetPositions, BindPositions,
                          UnbindPositions, PositionsChanged, IgnorePair, IgnoreGroups, SetRule, Reserve,
                          Diagnostic, ReplaceMesh, MarkTeleport, SettlePose>;

}  // namespace graze
