#pragma once

#include <array>
#include <vector>

#include "base/working_memory.hpp"
#include "core/base/box.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/mesh/region_tree.hpp"
#include "core/surface/surface.hpp"
#include "leaves/layout/float_filter.hpp"
#include "leaves/layout/leaf_vertices.hpp"

namespace graze {

/// A leaf of a surface and its box now.
struct LeafOf {
  const Region& region;
  const Box& box;
  const OrientedBox* oriented = nullptr;  ///< its box along its faces, if it is long
};

/// Makes room for the features of a leaf, in what holds those of each kind.
template <typename Features>
void reserve_features(Features& features, const PairRoom& room) {
  features.vertices.reserve(room.leaf_vertices);
  features.edges.reserve(room.leaf_edges);
  features.triangles.reserve(2 * room.leaf_faces);
  features.folds.reserve(room.leaf_faces);
}

/// Features that a leaf owns, in a frame.
class LeafFeatures {
 public:
  PointBlock vertices{FeatureRefKind::vertex};
  SegmentBlock edges{FeatureRefKind::edge};
  TriangleBlock triangles{FeatureRefKind::face};  ///< a quad's two one after the other
  SegmentBlock folds{FeatureRefKind::fold};  ///< diagonals of quads that no edge joins, by the quad's number

  /// All features of a leaf, laid out. `corners` is working memory.
  void collect(const Surface& surface, const Region& leaf, const FilterFrame& frame, LeafVertices& corners);
  /// Its vertices alone.
  void collect_vertices(const Surface& surface, const Region& leaf, const FilterFrame& frame,
                        LeafVertices& corners);

  [[nodiscard]] std::size_t count() const {
    return vertices.count() + edges.count() + triangles.count() + folds.count();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.vertices, self.edges, self.triangles, self.folds);
  }
  void reserve(const PairRoom& room) { reserve_features(*this, room); }

 private:
  void lay_out_vertices(const Surface& surface, const Region& leaf, LeafVertices& from);
  void lay_out_edges(const Surface& surface, const Region& leaf, const LeafVertices& from);
  void lay_out_faces(const Surface& surface, const Region& leaf, LeafVertices& from);
  void lay_out_folds(const IndexedMesh& mesh, const Region& leaf, LeafVertices& from);
};

/// The features of a leaf that are near the other leaf.
class SelectedLeaf {
 public:
  SelectedFeatures<1> vertices;
  SelectedFeatures<2> edges;
  SelectedFeatures<3> triangles;
  SelectedFeatures<2> folds;

  /// Takes those that `by` keeps, and extends `found`, where there is one, by their box. What they are taken
  /// from stays.
  void select_near(const LeafFeatures& all, const kernels::ClipBy& by, kernels::BoxInFrame* found);
  void select_near_vertices(const LeafFeatures& all, const kernels::ClipBy& by, kernels::BoxInFrame* found);

  [[nodiscard]] std::size_t count() const {
    return vertices.count() + edges.count() + triangles.count() + folds.count();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.vertices, self.edges, self.triangles, self.folds);
  }
  void reserve(const PairRoom& room) { reserve_features(*this, room); }
};

/// Whether diagonals of quads are folds (see `is_folded`). Few are asked, again and again. So each is decided
/// when asked, and kept for a while.
class FoldAnswers {
 public:
  /// Forgets all, so that what is decided does not depend on earlier queries.
  void begin() {
    if (any_) answers_.fill({});
    any_ = false;
  }
  bool is_fold(const Surface& surface, std::uint32_t face, DecisionCount& count);

 private:
  struct Answer {
    const Surface* surface = nullptr;
    std::uint32_t face = 0;
    bool is_fold = false;
  };
  std::array<Answer, 64> answers_;
  bool any_ = false;
};

}  // namespace graze
