#pragma once

#include <cstdint>
#include <vector>

namespace graze {

class IndexedMesh;

/// Says of each edge of a mesh whether it is a crease at rest: it does not have exactly two faces, or the
/// normals n and m of its two triangles have n·m < 0 or (n·m)² < 127/128 n² m², which is an angle of 5.07°. A
/// quad counts by its triangle that has the edge. A triangle without area bends nothing. It is decided
/// exactly.
[[nodiscard]] std::vector<bool> find_creases(const IndexedMesh& mesh);

}  // namespace graze
