#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// The vertex whose region owns a face or an edge. It is the first corner or the lower end, unless that is a
/// hub, where very many faces meet. Then it is the first of the other corners that is no hub, so that the
/// leaf of a hub does not own a large part of the mesh.
class FeatureOwners {
 public:
  /// For a mesh that has its edges.
  explicit FeatureOwners(const IndexedMesh& mesh) : mesh_(mesh), faces_(mesh.vertex_count(), 0) {
    for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
      for (const std::uint32_t corner : mesh.face(face)) ++faces_[corner];
    if (*std::max_element(faces_.begin(), faces_.end()) <= most_faces)
      std::vector<std::uint32_t>().swap(faces_);
  }

  [[nodiscard]] std::uint32_t of_face(std::uint32_t face) const { return first_of(mesh_.face(face)); }
  [[nodiscard]] std::uint32_t of_edge(std::uint32_t edge) const { return first_of(mesh_.edge(edge)); }

 private:
  /// A vertex of more faces is a hub.
  static constexpr std::uint32_t most_faces = 512;

  template <typename Corners>
  [[nodiscard]] std::uint32_t first_of(const Corners& corners) const {
    if (faces_.empty()) return corners[0];
    const auto found = std::find_if(corners.begin(), corners.end(),
                                    [&](std::uint32_t corner) { return faces_[corner] <= most_faces; });
    return found == corners.end() ? corners[0] : *found;
  }

  const IndexedMesh& mesh_;
  std::vector<std::uint32_t>
      faces_;  ///< how many there are of each vertex. It is empty if no vertex is a hub
};

}  // namespace graze
