#pragma once

#include <cstddef>
#include <graze/export.hpp>

namespace graze {

class IndexedMesh;

/// How large the pairs are that working memory makes room for ahead of time. Pairs that need more take it
/// when they are met.
struct GRAZE_API PairRoom {
  // Counts for one pair:
  std::size_t contacts = 0;
  std::size_t leaf_pairs = 0;        ///< that may be near
  std::size_t ties = 0;              ///< keys at the least distance, and features about them
  std::size_t region_distances = 0;  ///< listed
  // Of the largest of the meshes:
  std::size_t vertices = 0;
  std::size_t regions = 0;
  std::size_t long_regions = 0;
  std::size_t leaf_vertices = 0;
  std::size_t leaf_edges = 0;
  std::size_t leaf_faces = 0;

  /// Takes up how large a mesh's regions are.
  void include(const IndexedMesh& mesh);
};

}  // namespace graze
