#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/export.hpp>
#include <span>
#include <vector>

namespace graze {

class IndexedMesh;

/// One region R(level, j) of a mesh (paper, section 3.1): a range of the tree's vertex order, and its middle
/// vertex.
struct Region {
  std::uint32_t level = 0;
  std::uint32_t parent = 0;  ///< the root is its own parent
  std::uint32_t first_child = 0;
  std::uint32_t child_count = 0;   ///< 0 for a leaf
  std::uint32_t first_vertex = 0;  ///< into RegionTree::vertices()
  std::uint32_t vertex_count = 0;
  std::uint32_t first_face = 0;  ///< into RegionTree::faces()
  std::uint32_t face_count = 0;
  std::uint32_t first_edge = 0;  ///< into RegionTree::edges()
  std::uint32_t edge_count = 0;
  std::uint32_t first_border = 0;  ///< of a leaf: into RegionTree::border()
  std::uint32_t border_count = 0;
  std::uint32_t middle = 0;  ///< the middle vertex (eq. 1), a vertex of the mesh

  [[nodiscard]] bool is_leaf() const { return child_count == 0; }
};

/// The octree of regions of a mesh's rest shape. Fixed once built: while the object deforms only radii and
/// boxes change (they belong to a Surface). Region 0 is the whole mesh. Regions are stored level by level,
/// children of one parent together, so every child has a higher number than its parent.
///
/// The root box is the box of the used vertices' rest positions. A region of more than `leaf_capacity`
/// vertices is cut into 8 equal boxes about its centre. The centre is computed relative to the root box's
/// minimum. A vertex on a cut goes to the upper side, and empty children are dropped. Coincident vertices or
/// depth `max_level` end the cutting. A face belongs to the region of its first corner, an edge to that of
/// its lower vertex, so that every feature has one owner. A hub, a vertex of very many faces, leaves those
/// that another corner can own to that corner.
class GRAZE_API RegionTree {
 public:
  static constexpr std::uint32_t leaf_capacity = 30;
  static constexpr std::uint32_t max_level = 40;

  RegionTree() = default;
  explicit RegionTree(const IndexedMesh& mesh);

  [[nodiscard]] std::span<const Region> regions() const { return regions_; }
  [[nodiscard]] const Region& region(std::uint32_t index) const { return regions_[index]; }
  /// The number of one of them.
  [[nodiscard]] std::size_t number(const Region& region) const {
    return static_cast<std::size_t>(&region - regions_.data());
  }
  /// The number of levels, L + 1: level 0 is the whole mesh, L the deepest.
  [[nodiscard]] std::uint32_t level_count() const {
    return static_cast<std::uint32_t>(level_begin_.size()) - 1;
  }
  /// The level of the leaf of the median vertex: how deep the tree is, but for where vertices crowd.
  [[nodiscard]] std::uint32_t leaf_level() const { return leaf_level_; }
  [[nodiscard]] std::uint32_t region_count() const { return static_cast<std::uint32_t>(regions_.size()); }
  /// The number of the first region of `level`. `level_count()` gives the number of regions.
  [[nodiscard]] std::uint32_t level_begin(std::uint32_t level) const { return level_begin_[level]; }

  /// All used vertices, faces and edges in tree order. Every region owns a contiguous range of each.
  [[nodiscard]] std::span<const std::uint32_t> vertices() const { return vertices_; }
  [[nodiscard]] std::span<const std::uint32_t> faces() const { return faces_; }
  [[nodiscard]] std::span<const std::uint32_t> edges() const { return edges_; }
  [[nodiscard]] std::span<const std::uint32_t> vertices(const Region& region) const {
    return vertices().subspan(region.first_vertex, region.vertex_count);
  }
  [[nodiscard]] std::span<const std::uint32_t> faces(const Region& region) const {
    return faces().subspan(region.first_face, region.face_count);
  }
  [[nodiscard]] std::span<const std::uint32_t> edges(const Region& region) const {
    return edges().subspan(region.first_edge, region.edge_count);
  }
  /// The other corners of the faces and edges that a leaf owns: vertices of other leaves, each once.
  [[nodiscard]] std::span<const std::uint32_t> border(const Region& leaf) const {
    return std::span(border_).subspan(leaf.first_border, leaf.border_count);
  }
  /// The ends of a leaf's edges and the corners of its triangles, in the order of `edges(leaf)` and
  /// `faces(leaf)`. A quad's triangles are (0,1,2) and (0,2,3). Each number is an index into `vertices(leaf)`
  /// followed by `border(leaf)`. The memory behind the lists, up to a multiple of 4 edges or triangles, holds
  /// valid indices, too.
  [[nodiscard]] std::span<const std::uint32_t> edge_ends(const Region& leaf) const {
    return std::span(local_indices_)
        .subspan(local_begin_[number(leaf)].ends, 2 * std::size_t{leaf.edge_count});
  }
  [[nodiscard]] std::span<const std::uint32_t> triangle_corners(const Region& leaf) const {
    const LocalBegin& begin = local_begin_[number(leaf)];
    return std::span(local_indices_).subspan(begin.corners, begin.corner_count);
  }

  /// Three corners of a leaf's features that are far apart at rest: about its plane, where it is nearly flat.
  [[nodiscard]] const std::array<std::uint32_t, 3>& spread(const Region& leaf) const {
    return spread_[number(leaf)];
  }

  /// Bytes held.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The positions in `local_indices_` where a leaf's lists begin.
  struct LocalBegin {
    std::uint32_t ends = 0;
    std::uint32_t corners = 0;
    std::uint32_t corner_count = 0;
  };

  void list_borders(const IndexedMesh& mesh);
  void list_places(const IndexedMesh& mesh);
  void choose_spread(const IndexedMesh& mesh);

  std::vector<Region> regions_;
  std::uint32_t leaf_level_ = 0;
  std::vector<std::uint32_t> level_begin_;
  std::vector<std::uint32_t> vertices_;
  std::vector<std::uint32_t> faces_;
  std::vector<std::uint32_t> edges_;
  std::vector<std::uint32_t> border_;
  std::vector<std::uint32_t> local_indices_;
  std::vector<LocalBegin> local_begin_;               ///< by region, for leaves only
  std::vector<std::array<std::uint32_t, 3>> spread_;  ///< by region, for leaves only
};

}  // namespace graze
