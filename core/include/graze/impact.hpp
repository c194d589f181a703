#pragma once

#include <cstdint>
#include <graze/contact.hpp>

namespace graze {

/// @addtogroup report
/// @{

/// Says how certain it is that two features meet between two steps.
enum class ImpactStatus : std::uint8_t {
  certain,   ///< They meet, and the first time of contact lies between the two bounds.
  possible,  ///< The budget of exact work ran out before it was decided whether they meet.
  at_start,  ///< They touch at time 0, so both bounds are 0.
};

/// Two features that come to distance 0 between two steps. Every vertex moves along a straight line. Time
/// runs from 0, where the last step saw the vertices, to 1, where this step sees them.
struct Impact {
  /// VF or EE. A face is a triangle or a quad with its border, and an edge has its ends.
  ContactKind kind = ContactKind::VF;
  /// The feature of object a.
  Feature feature_a;
  /// The feature of object b.
  Feature feature_b;
  /// The first time of contact is not less than this.
  double lower = 0;
  /// The first time of contact is not more than this. If #status is `possible`, there may be no contact.
  double upper = 0;
  /// Whether the features meet for certain.
  ImpactStatus status = ImpactStatus::certain;

  /// Compares all members.
  friend bool operator==(const Impact&, const Impact&) = default;
};

/// @}

}  // namespace graze
