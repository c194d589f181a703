#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace graze {

class IndexedMesh;

/// Says of each edge of a mesh whether it is a crease at rest. An edge is one if it does not have exactly two
/// faces. It is one, too, if the normals n and m of its two triangles have n·m < 0 or (n·m)² < 127/128 n² m².
/// That is an angle of more than 5.07°. A quad counts by its triangle that has the edge. A triangle without
/// area bends nothing. All of it is decided exactly.
[[nodiscard]] std::vector<bool> find_creases(const IndexedMesh& mesh);

/// Whether an edge would be a crease if it had these two of its faces alone.
[[nodiscard]] bool is_crease_between(const IndexedMesh& mesh, std::uint32_t edge,
                                     const std::array<std::uint32_t, 2>& faces);

}  // namespace graze
