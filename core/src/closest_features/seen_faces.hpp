#pragma once

#include <cstddef>
#include <cstdint>

#include "base/inplace_vector.hpp"
#include "core/mesh/face_groups.hpp"
#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// The faces of an edge that are not hidden, as far as rules about edges ask for them.
struct SeenFaces {
  InplaceVector<std::uint32_t, 3> faces;  ///< three stand for any more
  bool hides_some = false;

  /// Whether the edge is a seam: hidden faces and one that is seen have it. The seen face goes on behind it.
  [[nodiscard]] bool are_at_seam() const { return hides_some && faces.size() == 1; }
};

inline SeenFaces seen_faces(const FaceGroups& groups, const IndexedMesh& mesh, std::uint32_t edge) {
  SeenFaces seen;
  for (const std::uint32_t face : mesh.edge_faces(edge))
    if (groups.hides(face))
      seen.hides_some = true;
    else
      seen.faces.push_back(face);
  return seen;
}

}  // namespace graze
