#pragma once

#include <graze/export.hpp>

#include "core/base/box.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Whether any face of a surface has a point in a box, its border included. Decided exactly. Faces that
/// `groups` hides do not count. A null pointer hides none. The surface has been refitted for faces now.
GRAZE_API bool meets_box(const Box& box, const Surface& surface, const FaceGroups* groups);

}  // namespace graze
