// A leaf's features are laid out from its vertices, each brought into the frame once. Here every corner is
// brought there by itself.

#include "leaves/layout/leaf_features.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include "closest_features/closest_features.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;

/// Features of a block in the order in which they are expected.
template <typename Block>
class ExpectedBlock {
 public:
  ExpectedBlock(const Block& block, const Surface& surface, const FilterFrame& frame)
      : block_(block), surface_(surface), frame_(frame) {}
  ExpectedBlock(const ExpectedBlock&) = delete;
  ExpectedBlock& operator=(const ExpectedBlock&) = delete;
  ~ExpectedBlock() { CHECK(block_.count() == next_); }

  void next(std::uint32_t owner, const std::vector<std::uint32_t>& corners) {
    REQUIRE(next_ < block_.count());
    REQUIRE(block_.owner(next_) == owner);
    double size = kernels::least_size;
    for (const std::uint32_t corner : corners) size = std::max(size, local(corner).cwiseAbs().maxCoeff());
    const bool fits = size <= kernels::largest_size;
    std::size_t component = 0;
    for (const std::uint32_t corner : corners)
      for (int axis = 0; axis < 3; ++axis, ++component)
        REQUIRE(block_.component(component, next_) ==
                (fits ? static_cast<float>(local(corner)[axis]) : 0.0F));
    REQUIRE(block_.component(component, next_) ==
            (fits ? static_cast<float>(size) : std::numeric_limits<float>::infinity()));
    if (fits) check_box(corners.size(), static_cast<float>(size));
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (std::size_t axis = 0; fits && axis < 3; ++axis)
        REQUIRE(block_.corners(next_)[i].position[axis] == block_.component(3 * i + axis, next_));
    ++next_;
    ++(fits ? fitting : unfit);
  }

  inline static std::size_t fitting = 0;
  inline static std::size_t unfit = 0;

 private:
  [[nodiscard]] Vector3d local(std::uint32_t vertex) const {
    return frame_.to_local(surface_.position(vertex));
  }
  void check_box(std::size_t corners, float size) const {
    const float grown = kernels::margin * size;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float low = std::numeric_limits<float>::infinity();
      float high = -low;
      for (std::size_t corner = 0; corner < corners; ++corner) {
        low = std::min(low, block_.component(3 * corner + axis, next_));
        high = std::max(high, block_.component(3 * corner + axis, next_));
      }
      const std::size_t box = 3 * corners + 1;
      REQUIRE(block_.component(box + axis, next_) == low - grown);
      REQUIRE(block_.component(box + 3 + axis, next_) == high + grown);
    }
  }

  const Block& block_;
  const Surface& surface_;
  const FilterFrame& frame_;
  std::size_t next_ = 0;
};

void check_leaf(const Surface& surface, const Region& leaf, const FilterFrame& frame, LeafVertices& corners) {
  const IndexedMesh& mesh = surface.mesh();
  const RegionTree& tree = mesh.regions();
  LeafFeatures all;
  all.collect(surface, leaf, frame, corners);
  ExpectedBlock vertices(all.vertices, surface, frame);
  for (const std::uint32_t vertex : tree.vertices(leaf)) vertices.next(vertex, {vertex});
  ExpectedBlock edges(all.edges, surface, frame);
  for (const std::uint32_t edge : tree.edges(leaf))
    edges.next(edge, {mesh.edge(edge)[0], mesh.edge(edge)[1]});
  ExpectedBlock triangles(all.triangles, surface, frame);
  ExpectedBlock folds(all.folds, surface, frame);
  for (const std::uint32_t face : tree.faces(leaf)) {
    const auto c = mesh.face(face);
    triangles.next(face, {c[0], c[1], c[2]});
    if (c.size() == 3) continue;
    triangles.next(face, {c[0], c[2], c[3]});
    if (diagonal_of(mesh, face).feature.kind == FeatureKind::face) folds.next(face, {c[0], c[2]});
  }
}

}  // namespace

TEST_CASE("leaf features: each corner is what it is by itself in the frame, whatever else it is part of") {
  LeafVertices corners;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    oracle::Shape shape = random_soup(seed, 150, 260);
    const auto mesh = mesh_of(shape);
    Surface surface(mesh);
    // A vertex that float does not reach, in every other scene.
    if (seed % 2 == 1) shape.positions[mesh->face(7)[0]].y() = 1e9;
    surface.set_positions(shape.positions);
    for (const Region& region : indexed(*mesh).regions().regions()) {
      if (!region.is_leaf()) continue;
      Box box;
      box.add(Vector3d(0.1, 0.2, 0.3));
      box.add(Vector3d(0.3, 0.5, 0.4));
      check_leaf(surface, region, FilterFrame(box, box), corners);
    }
  }
  const std::size_t fitting = ExpectedBlock<TriangleBlock>::fitting + ExpectedBlock<SegmentBlock>::fitting;
  const std::size_t unfit = ExpectedBlock<TriangleBlock>::unfit + ExpectedBlock<SegmentBlock>::unfit;
  CHECK(fitting > 10'000);
  CHECK(unfit > 20);
  std::cout << "compared " << fitting + unfit << " triangles and segments, " << unfit
            << " of which float does not reach\n";
}

}  // namespace graze::tests
