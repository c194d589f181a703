#pragma once

#include <cstdint>

#include "response/feature_points.hpp"

namespace graze {

/// The triangle of a face that a segment passes through, or -1, decided exactly as in reports. It asks plain
/// double first. Coordinates that no report has are not decided.
std::int8_t pierced_triangle_of(const Segment& segment, const PlacedMesh& placed, std::uint32_t face);

/// Whether a segment passes through the inside of any face of a mesh. It looks at the faces in their order,
/// and takes no memory.
bool pierces_any_face(const Segment& segment, const PlacedMesh& placed);

}  // namespace graze
