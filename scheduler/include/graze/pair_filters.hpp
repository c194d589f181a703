#pragma once

#include <compare>
#include <cstdint>
#include <graze/object_id.hpp>
#include <graze/settings.hpp>
#include <utility>
#include <vector>

/// @file
/// What calls have said of pairs of objects.

namespace graze {

/// @addtogroup recording
/// @{

/// What Scene::ignore(), Scene::watch() and Scene::set_rule() have said of pairs so far. Replay and
/// io::Player have it, and pages take it.
struct PairFilters {
  /// A group of an object's faces.
  struct FaceGroup {
    /// The object.
    ObjectId object;
    /// A number of ObjectSettings::face_groups.
    std::uint8_t group = 0;

    /// Compares by object, then by group.
    friend auto operator<=>(const FaceGroup&, const FaceGroup&) = default;
  };
  /// Thresholds of pairs of two kinds.
  struct KindRule {
    /// ObjectSettings::kind of one object.
    std::uint32_t kind_a = 0;
    /// ObjectSettings::kind of the other object.
    std::uint32_t kind_b = 0;
    /// The thresholds.
    PairRule rule;
  };

  /// The pairs that are ignored whole. The order of the two does not matter.
  std::vector<std::pair<ObjectId, ObjectId>> ignored = {};
  /// The pairs of groups of faces that are ignored.
  std::vector<std::pair<FaceGroup, FaceGroup>> ignored_groups = {};
  /// The rules that are not empty, one for two kinds.
  std::vector<KindRule> rules = {};
};

/// @}

}  // namespace graze
