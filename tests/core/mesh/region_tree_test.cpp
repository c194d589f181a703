// The octree of regions, its middle vertices (eq. 1), radii (eq. 2) and level radii (eq. 3), and the boxes,
// against the oracle's tree and plain recomputation.

#include "core/mesh/region_tree.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <tuple>

#include "core/base/box.hpp"
#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using Numbers = std::vector<std::uint32_t>;

Numbers sorted(std::span<const std::uint32_t> values) {
  Numbers result(values.begin(), values.end());
  std::sort(result.begin(), result.end());
  return result;
}

/// A region as the oracle has it, and its number.
struct Listed {
  std::uint32_t level;
  Numbers vertices;
  std::uint32_t middle;
  bool leaf;
  std::uint32_t index;
};

std::vector<Listed> listed(const RegionTree& tree) {
  std::vector<Listed> regions;
  for (std::uint32_t index = 0; index < tree.regions().size(); ++index) {
    const Region& region = tree.region(index);
    regions.push_back({region.level, sorted(tree.vertices(region)), region.middle, region.is_leaf(), index});
  }
  std::sort(regions.begin(), regions.end(), [](const Listed& left, const Listed& right) {
    return std::tie(left.level, left.vertices) < std::tie(right.level, right.vertices);
  });
  return regions;
}

/// Checks how regions lie in the tree's arrays.
void check_structure(const IndexedMesh& mesh) {
  const RegionTree& tree = mesh.regions();
  REQUIRE(tree.level_begin(0) == 0);
  REQUIRE(tree.level_begin(tree.level_count()) == tree.regions().size());
  std::vector<int> leaves_of_vertex(mesh.vertex_count(), 0);
  std::vector<int> leaves_of_face(mesh.face_count(), 0);
  std::vector<int> leaves_of_edge(mesh.edge_count(), 0);
  for (std::uint32_t index = 0; index < tree.regions().size(); ++index) {
    const Region& region = tree.region(index);
    CHECK(index >= tree.level_begin(region.level));
    CHECK(index < tree.level_begin(region.level + 1));
    const Numbers vertices = sorted(tree.vertices(region));
    const auto owns = [&](std::uint32_t vertex) {
      return std::binary_search(vertices.begin(), vertices.end(), vertex);
    };
    for (const std::uint32_t face : tree.faces(region)) CHECK(owns(mesh.face(face)[0]));
    for (const std::uint32_t edge : tree.edges(region)) CHECK(owns(mesh.edge(edge)[0]));
    if (region.is_leaf()) {
      for (const std::uint32_t vertex : vertices) ++leaves_of_vertex[vertex];
      for (const std::uint32_t face : tree.faces(region)) ++leaves_of_face[face];
      for (const std::uint32_t edge : tree.edges(region)) ++leaves_of_edge[edge];
      continue;
    }
    CHECK(region.child_count <= 8);
    Numbers of_children;
    for (std::uint32_t i = 0; i < region.child_count; ++i) {
      const Region& child = tree.region(region.first_child + i);
      CHECK(child.parent == index);
      CHECK(child.level == region.level + 1);
      CHECK(child.vertex_count > 0);
      const auto members = tree.vertices(child);
      of_children.insert(of_children.end(), members.begin(), members.end());
    }
    CHECK(sorted(of_children) == vertices);
  }
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
    CHECK(leaves_of_vertex[vertex] == (mesh.is_used(vertex) ? 1 : 0));
  CHECK(std::all_of(leaves_of_face.begin(), leaves_of_face.end(), [](int count) { return count == 1; }));
  CHECK(std::all_of(leaves_of_edge.begin(), leaves_of_edge.end(), [](int count) { return count == 1; }));
}

bool same(const Box& box, const Box& other) {
  return box.min == other.min && box.max == other.max;
}

/// Radii and boxes at `now` against recomputation. Radii are sums of three squares, so a few 2^-53 off.
void check_bounds(const Surface& surface, const std::vector<oracle::OracleRegion>& expected,
                  const std::vector<Listed>& regions, const std::vector<Vector3d>& now) {
  const IndexedMesh& mesh = surface.mesh();
  const RegionTree& tree = mesh.regions();
  const auto near = [](double value, double truth) { return std::abs(value - truth) <= truth * 0x1p-50; };
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::uint32_t index = regions[i].index;
    CHECK(near(surface.radii()[index], oracle::radius(expected[i], now)));
    Box of_vertices;
    for (const std::uint32_t vertex : expected[i].vertices) of_vertices.add(now[vertex]);
    CHECK(same(surface.vertex_boxes()[index], of_vertices));
    Box of_features = of_vertices;
    for (const std::uint32_t face : tree.faces(tree.region(index)))
      for (const std::uint32_t corner : mesh.face(face)) of_features.add(now[corner]);
    for (const std::uint32_t edge : tree.edges(tree.region(index)))
      for (const std::uint32_t end : mesh.edge(edge)) of_features.add(now[end]);
    CHECK(same(surface.face_boxes()[index], of_features));
  }
  const auto level_radii = oracle::level_radii(expected, now);
  REQUIRE(surface.level_radii().size() == level_radii.size());
  for (std::size_t level = 0; level < level_radii.size(); ++level)
    CHECK(near(surface.level_radii()[level], level_radii[level]));
}

/// The tree of a shape against the oracle's, and its bounds at rest and deformed. Returns how many regions it
/// has.
std::size_t check_tree(const oracle::Shape& rest) {
  const auto expected = oracle::regions_of(rest);
  const Surface at_rest = surface_of(rest);
  const auto regions = listed(at_rest.mesh().regions());
  REQUIRE(regions.size() == expected.size());
  for (std::size_t i = 0; i < regions.size(); ++i) {
    CHECK(regions[i].level == expected[i].level);
    CHECK(regions[i].vertices == expected[i].vertices);
    CHECK(regions[i].middle == expected[i].middle);
    CHECK(regions[i].leaf == expected[i].leaf);
  }
  CHECK(at_rest.mesh().regions().level_count() == expected.back().level + 1);
  check_structure(at_rest.mesh());
  check_bounds(at_rest, expected, regions, rest.positions);
  const oracle::Shape deformed = wobbled(rest, 0.3, 5);
  check_bounds(surface_of({rest, deformed}), expected, regions, deformed.positions);
  return regions.size();
}

/// A face for every vertex, so that positions alone decide.
oracle::Shape points(const std::vector<Vector3d>& positions) {
  oracle::Shape shape{positions, {}};
  for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex)
    shape.faces.push_back({vertex, vertex, vertex});
  return shape;
}

}  // namespace

TEST_CASE("regions: those of the paper's models are the oracle's") {
  std::size_t regions = 0;
  for (const NamedShape& model : paper_models()) {
    INFO(model.name);
    regions += check_tree(model.shape);
  }
  for (const NamedShape& model : paper_models_of_quads()) {
    INFO(model.name);
    regions += check_tree(model.shape);
  }
  CHECK(regions > 100);
  std::cout << "compared " << regions << " regions of the paper's models\n";
}

TEST_CASE("regions: those of random soups are the oracle's") {
  std::size_t regions = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    const auto size = static_cast<std::uint32_t>(seed * 10);
    regions += check_tree(random_soup(seed, 1 + size, 1 + size));
  }
  CHECK(regions > 500);
  std::cout << "compared " << regions << " regions of soups\n";
}

TEST_CASE("regions: 30 vertices are a leaf, 31 are not") {
  std::vector<Vector3d> line;
  for (int i = 0; i < 30; ++i) line.emplace_back(i, 0, 0);
  CHECK(check_tree(points(line)) == 1);
  line.emplace_back(30, 0, 0);
  CHECK(check_tree(points(line)) == 3);
}

TEST_CASE("regions: a thousand vertices in one point are one leaf") {
  const std::vector<Vector3d> heap(1000, Vector3d(0.1, 0.2, 0.3));
  CHECK(check_tree(points(heap)) == 1);
  CHECK(indexed(*mesh_of(points(heap))).regions().region(0).middle == 0);
  std::vector<Vector3d> beside = heap;
  beside.emplace_back(1, 1, 1);
  CHECK(check_tree(points(beside)) == 3);
}

TEST_CASE("regions: vertices that only the deepest level would part end there") {
  std::vector<Vector3d> clusters(40, Vector3d::Zero());
  for (int i = 0; i < 40; ++i) clusters[static_cast<std::size_t>(i)].x() = std::ldexp(i, -70);
  clusters.emplace_back(1, 0.5, 0.25);
  check_tree(points(clusters));
  const auto mesh = mesh_of(points(clusters));
  const RegionTree& tree = indexed(*mesh).regions();
  CHECK(tree.level_count() == RegionTree::max_level + 1);
  CHECK(tree.region(tree.level_begin(RegionTree::max_level)).vertex_count == 40);
}

TEST_CASE("regions: cuts are exact at every depth") {
  // Neighbouring doubles around a deep cut of a root box whose size has all its bits.
  std::size_t regions = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    oracle::Random random(seed);
    const double size = random.between(0.5, 1);
    const int depth = 2 + static_cast<int>(random.below(30));
    const double way = std::ldexp(2 * random.below(1U << std::min(depth - 1, 20)) + 1, -depth);
    std::vector<Vector3d> cluster{Vector3d::Zero(), Vector3d(size, 0, 0)};
    double x = size * way;
    for (int i = 0; i < 20; ++i) x = std::nextafter(x, 0);
    for (int i = 0; i < 40; ++i, x = std::nextafter(x, 1)) cluster.emplace_back(x, 0, 0);
    INFO("seed " << seed);
    regions += check_tree(points(cluster));
  }
  CHECK(regions > 600);
}

TEST_CASE("regions: middle vertices decide ties exactly, for the lowest number") {
  // The average lies halfway between the two vertices in the middle, or so close that doubles cannot tell.
  for (const double nudge : {0.0, 0x1p-52, -0x1p-53}) {
    std::vector<Vector3d> pair{{1 + nudge, 0, 0}, {-1, 0, 0}, {1, 1, 0}, {-1, 1, 0}};
    check_tree(points(pair));
    std::reverse(pair.begin(), pair.end());
    check_tree(points(pair));
  }
  CHECK(indexed(*mesh_of(points({{1, 0, 0}, {-1, 0, 0}}))).regions().region(0).middle == 0);
  CHECK(indexed(*mesh_of(points({{3, 0, 0}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}}))).regions().region(0).middle ==
        1);
}

TEST_CASE("regions: a moved mesh has the same tree") {
  for (const NamedShape& model : paper_models()) {
    INFO(model.name);
    const oracle::Shape rest = snapped(model.shape, 0x1p-12);
    const auto regions = listed(indexed(*mesh_of(rest)).regions());
    for (const double far : {0x1p10, 0x1p20, 0x1p40}) {
      const auto moved = mesh_of(mapped(rest, 1, {far, -far, far / 2}));
      const auto after = listed(indexed(*moved).regions());
      REQUIRE(after.size() == regions.size());
      for (std::size_t i = 0; i < regions.size(); ++i)
        CHECK(std::tie(after[i].vertices, after[i].middle, after[i].index) ==
              std::tie(regions[i].vertices, regions[i].middle, regions[i].index));
    }
  }
}

TEST_CASE("regions: a surface reads positions whole or not at all") {
  const oracle::Shape rest = box({0, 0, 0}, {1, 1, 1});
  Surface surface = surface_of(rest);
  CHECK(surface.motion_since_vertex_refit() == 0);
  std::vector<Vector3d> next = mapped(rest, 1, {0, 0, 2}).positions;
  next[5].y() = std::numeric_limits<double>::quiet_NaN();
  const auto refused = surface.set_positions(next);
  CHECK_FALSE(refused.taken());
  CHECK(refused.bad_vertex == 5);
  CHECK(std::isnan(refused.bad_position.y()));
  CHECK(surface.position(0) == Vector3d(0, 0, 0));
  CHECK(surface.motion_since_vertex_refit() == 0);
  next[5].y() = 0;
  const auto taken = surface.set_positions(next);
  CHECK(taken.taken());
  CHECK(taken.displacement == 2);
  CHECK(surface.motion_since_vertex_refit() > 0);
  CHECK(surface.motion_since_face_refit() > 0);
  CHECK(same(surface.box(), {{0, 0, 2}, {1, 1, 3}}));
  surface.refit_vertices();
  surface.refit(RefitOf::radii);
  surface.refit_faces();
  CHECK(same(surface.vertex_boxes()[0], surface.box()));
  CHECK(same(surface.face_boxes()[0], surface.box()));
  const std::array<double, 12> quarter_turn{0, -1, 0, 5, 1, 0, 0, 6, 0, 0, 1, 7};
  CHECK(surface.set_pose(quarter_turn).taken());
  CHECK(surface.position(7) == Vector3d(4, 7, 8));
}

}  // namespace graze::tests
