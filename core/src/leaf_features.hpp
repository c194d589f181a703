#pragma once

#include <graze/box.hpp>
#include <graze/pair_query.hpp>
#include <graze/region_tree.hpp>
#include <graze/surface.hpp>
#include <vector>

#include "float_filter.hpp"
#include "leaf_vertices.hpp"
#include "working_memory.hpp"

namespace graze {

/// A leaf of a surface and its box now.
struct LeafOf {
  const Region& region;
  const Box& box;
};

/// Features that a leaf owns, in a frame.
class LeafFeatures {
 public:
  PointBlock vertices{Part::vertex};
  SegmentBlock edges{Part::edge};
  TriangleBlock triangles{Part::face};  ///< a quad's two one after the other
  SegmentBlock folds{Part::fold};       ///< diagonals of quads that no edge joins, by the quad's number

  /// All features of a leaf, laid out. `corners` is working memory.
  void collect(const Surface& surface, const Region& leaf, const FilterFrame& frame, LeafVertices& corners);
  /// Its vertices alone.
  void collect_vertices(const Surface& surface, const Region& leaf, const FilterFrame& frame,
                        LeafVertices& corners);

  /// The box of those that `by` keeps.
  [[nodiscard]] kernels::BoxInFrame near_box(const kernels::ClipBy& by) const;
  [[nodiscard]] kernels::BoxInFrame near_box_of_vertices(const kernels::ClipBy& by) const;
  /// Takes those of `all` that `by` keeps, and extends `found`, where there is one, by their box.
  void take(const LeafFeatures& all, const kernels::ClipBy& by, kernels::BoxInFrame* found);
  void take_vertices(const LeafFeatures& all, const kernels::ClipBy& by, kernels::BoxInFrame* found);

  [[nodiscard]] std::size_t count() const {
    return vertices.count() + edges.count() + triangles.count() + folds.count();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.vertices, self.edges, self.triangles, self.folds);
  }
  void reserve(const PairRoom& room) {
    vertices.reserve(room.leaf_vertices);
    edges.reserve(room.leaf_edges);
    triangles.reserve(2 * room.leaf_faces);
    folds.reserve(room.leaf_faces);
  }

 private:
  void lay_out_vertices(const Surface& surface, const Region& leaf, LeafVertices& from);
  void lay_out_edges(const Surface& surface, const Region& leaf, LeafVertices& from);
  void lay_out_faces(const Surface& surface, const Region& leaf, LeafVertices& from);
};

/// Whether diagonals of quads are folds (see `is_folded`); asked of few, so decided when asked.
class FoldAnswers {
 public:
  void begin(const Surface& surface, const SegmentBlock& diagonals);
  bool is_fold(std::size_t diagonal, DecisionCount& count);

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.answers_);
  }
  void reserve(const PairRoom& room) { answers_.reserve(room.leaf_faces); }

 private:
  enum class Folded : std::uint8_t { unknown, no, yes };

  const Surface* surface_ = nullptr;
  const SegmentBlock* diagonals_ = nullptr;
  std::vector<Folded> answers_;
};

}  // namespace graze
