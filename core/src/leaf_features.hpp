#pragma once

#include <graze/box.hpp>
#include <graze/pair_query.hpp>
#include <graze/region_tree.hpp>
#include <graze/surface.hpp>
#include <vector>

#include "float_filter.hpp"
#include "working_memory.hpp"

namespace graze {

/// A leaf of a surface and its box now.
struct LeafOf {
  const Region& region;
  const Box& box;
};

/// The features that a leaf owns and that may be near another leaf.
class LeafFeatures {
 public:
  PointBlock vertices{Part::vertex};
  SegmentBlock edges{Part::edge};
  TriangleBlock triangles{Part::face};  ///< a quad's two one after the other
  SegmentBlock folds{Part::fold};       ///< diagonals of quads that no edge joins, by the quad's number

  /// Takes the features of `leaf` that are not certainly further than `limit` from `other`; whether there are
  /// more.
  bool collect(const Surface& surface, const Region& leaf, const Box& other, const FilterFrame& frame,
               double limit);
  /// The same for its vertices alone.
  bool collect_vertices(const Surface& surface, const Region& leaf, const Box& other,
                        const FilterFrame& frame, double limit);

  /// Whether the diagonal `fold` of the block is a fold (see `is_folded`); asked of few, so decided when
  /// asked.
  bool is_fold(std::size_t fold, DecisionCount& count);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.vertices, self.edges, self.triangles, self.folds, self.folded_);
  }
  void reserve(const PairRoom& room) {
    vertices.reserve(room.leaf_vertices);
    edges.reserve(room.leaf_edges);
    triangles.reserve(2 * room.leaf_faces);
    folds.reserve(room.leaf_faces);
    folded_.reserve(room.leaf_faces);
  }

 private:
  enum class Folded : std::uint8_t { unknown, no, yes };

  void prepare();

  const Surface* surface_ = nullptr;
  std::vector<Folded> folded_;  ///< of each diagonal
};

}  // namespace graze
