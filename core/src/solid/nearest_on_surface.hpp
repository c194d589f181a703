#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "base/inplace_vector.hpp"
#include "core/mesh/region_tree.hpp"
#include "leaves/leaf_scratch.hpp"
#include "leaves/nearest_of_vertices.hpp"

namespace graze {

/// Finds what is nearest to vertices of one surface on the other one, however far. The other surface has been
/// refitted for faces. Leaves are taken depth first, and the nearest first. Slabs say of most leaves whose
/// boxes are near that they are not, and float says which of their faces may be nearest.
///
/// Vertices beside each other have the same leaves near. So these are listed for some vertices at once.
class NearestOnSurface {
 public:
  /// For vertices of a if `are_of_a`, else of b. `scratch` has memory that no other search uses meanwhile.
  NearestOnSurface(const SurfacePair& pair, bool are_of_a, LeafScratch& scratch);

  /// Begins with some vertices that lie beside each other: the next that are asked for. It need not be
  /// called.
  void begin_some(std::span<const std::uint32_t> vertices);
  /// Returns what is nearest to a vertex, of equally near ones the lowest. There is nothing if no face may be
  /// tested with the vertex. It takes less time if the vertex is near the one before.
  std::optional<VertexNearest> find(std::uint32_t vertex);

 private:
  /// A region, and a lower bound of its squared distance.
  struct Open {
    double lower;
    std::uint32_t region;
  };
  /// A leaf that may be near to some vertices, and a lower bound of its squared distance to any of them.
  struct NearLeaf {
    double lower;
    const Region* leaf;
  };
  /// More leaves than this are not listed.
  static constexpr std::size_t most_leaves = 256;
  /// A face that may be nearest, and a lower bound of its squared distance.
  struct NearFace {
    double lower;
    std::uint32_t face;
  };

  void begin(std::uint32_t vertex);
  void search_listed();
  void search_all();
  [[nodiscard]] bool is_near(const Region& leaf);
  [[nodiscard]] double upper_beside_last(const Eigen::Vector3d& point) const;
  [[nodiscard]] Box box_of(std::size_t region) const;
  [[nodiscard]] double lower_of(std::size_t region) const;
  void open_children(const Region& region);
  void add_leaf(const Region& leaf);
  void add_bounded();
  void offer(std::uint32_t face);
  [[nodiscard]] bool may(std::uint32_t face) const;
  [[nodiscard]] FeaturePairKey key_of(const FeaturePiece& piece) const;
  void shrink_limit(double squared) { limit_ = std::min(limit_, squared); }

  const SurfacePair& pair_;
  const bool are_of_a_;
  const Surface& from_;  ///< of the vertices
  const Surface& to_;
  const double slack_;
  LeafScratch& scratch_;
  LeafCache& leaves_;
  FloatBatch<1, 3>& batch_;

  VertexNearest nearest_;
  bool has_any_ = false;
  Eigen::Vector3d point_;
  double limit_ = std::numeric_limits<double>::infinity();  ///< of the squared distance
  // The vertex as a block of one feature, for the kernels.
  std::array<float, kernels::component_count<1> * kernels::lanes> row_{};
  std::array<kernels::Point, 4> corner_{};
  InplaceVector<NearFace, kernels::lanes> near_;
  InplaceVector<NearLeaf, most_leaves> listed_;  ///< ascending by their bounds
  bool is_listed_ = false;                       ///< all that can be near are listed
  // At most the siblings of one region are open on each level.
  InplaceVector<Open, std::size_t{8} * (RegionTree::max_level + 1)> open_;
};

}  // namespace graze
