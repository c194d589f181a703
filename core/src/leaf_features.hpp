#pragma once

#include <graze/box.hpp>
#include <graze/pair_query.hpp>
#include <graze/region_tree.hpp>
#include <graze/surface.hpp>
#include <vector>

#include "float_filter.hpp"
#include "reserve_as.hpp"

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

  void reserve_as(const LeafFeatures& other) {
    vertices.reserve_as(other.vertices);
    edges.reserve_as(other.edges);
    triangles.reserve_as(other.triangles);
    folds.reserve_as(other.folds);
    graze::reserve_as(folded_, other.folded_);
  }
  void reserve(const PairRoom& room) {
    vertices.reserve(room.leaf_vertices);
    edges.reserve(room.leaf_edges);
    triangles.reserve(2 * room.leaf_faces);
    folds.reserve(room.leaf_faces);
    folded_.reserve(room.leaf_faces);
  }
  [[nodiscard]] std::size_t byte_count() const {
    return vertices.byte_count() + edges.byte_count() + triangles.byte_count() + folds.byte_count() +
           bytes_of(folded_);
  }

 private:
  enum class Folded : std::uint8_t { unknown, no, yes };

  void prepare();

  const Surface* surface_ = nullptr;
  std::vector<Folded> folded_;  ///< of each diagonal
};

}  // namespace graze
