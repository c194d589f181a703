#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <vector>

#include "core/surface/surface.hpp"

namespace graze {

/// A leaf of a surface, and at most how far its faces and edges are from another surface.
struct NearLeaf {
  std::uint32_t leaf = 0;
  double lower = 0;
};

/// Appends the leaves of a surface of which a face may be within `radius` of another one, in no order that
/// means anything. Each leaf comes once. Both surfaces have been refitted for faces at their positions.
///
/// With `about_is_solid` leaves inside of `about` count as near. All leaves whose boxes meet its box do then.
GRAZE_API void list_near_leaves(const Surface& about, bool about_is_solid, const Surface& surface,
                                double radius, std::vector<NearLeaf>& near);

}  // namespace graze
