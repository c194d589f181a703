// This test checks the list of find_oddities on meshes made by hand and on the generated models.

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/mesh.hpp>
#include <limits>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Numbers = std::vector<std::uint32_t>;

MeshOddities oddities_of(const oracle::Shape& shape) {
  return find_oddities(*mesh_of(shape));
}

/// The number of the edge between two vertices.
std::uint32_t edge_between(const oracle::Shape& shape, std::uint32_t low, std::uint32_t high) {
  const auto edges = oracle::edges_of(shape);
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge)
    if (edges[edge] == std::array{low, high}) return edge;
  return Mesh::no_edge;
}

void check_clean(const NamedShape& model) {
  INFO(model.name);
  const MeshOddities odd = oddities_of(model.shape);
  CHECK(odd.closed_manifold());
  CHECK(odd.degenerate_faces.empty());
  CHECK(odd.duplicate_faces.empty());
  CHECK(odd.isolated_vertices.empty());
  CHECK(odd.duplicate_vertices.empty());
  CHECK(odd.flipped_edges.empty());
}

}  // namespace

TEST_CASE("oddities: the generated models have none") {
  for (const NamedShape& model : paper_models()) check_clean(model);
  for (const NamedShape& model : paper_models_of_quads()) check_clean(model);
  check_clean({"box", shape_of(models::box({1, 2, 3}))});
  check_clean({"box of triangles", shape_of(models::box({1, 2, 3}, models::Faces::triangles))});
  check_clean({"sphere", shape_of(models::sphere(12, 5))});
  check_clean({"small torus", shape_of(models::torus(3, 3, 2.0, 0.5, models::Faces::quads))});
}

TEST_CASE("oddities: a sheet is open at its border and nowhere else") {
  const oracle::Shape sheet = shape_of(models::sheet(3, 2, 3, 2));
  const MeshOddities odd = oddities_of(sheet);
  CHECK(odd.border_edges.size() == 10);
  CHECK(odd.non_manifold_edges.empty());
  CHECK_FALSE(odd.closed_manifold());
  CHECK(odd.flipped_edges.empty());
}

TEST_CASE("oddities: faces without area") {
  oracle::Shape shape = box({0, 0, 0}, {1, 1, 1});
  CHECK(oddities_of(shape).degenerate_faces.empty());
  const std::size_t first = shape.faces.size();
  shape.positions.emplace_back(0.5, 0, 0);      // 8, on the edge from 0 to 1
  shape.positions.emplace_back(0.3, 0.3, 0.3);  // 9 and 10: on the line from 0 to 7, but for the rounding
  shape.positions.emplace_back(0.7, 0.7, 0.7);
  shape.faces.insert(shape.faces.end(),
                     {{0, 8, 1}, {0, 0, 3}, {0, 9, 10}, {0, 1, 8, 1}, {0, 8, 1, 2}, {3, 5, 6}});
  const MeshOddities odd = oddities_of(shape);
  CHECK(odd.degenerate_faces == Numbers{6, 7, 8, 9});
  CHECK(first == 6);
  // Nearly collinear is not collinear.
  shape.positions[9].x() = std::nextafter(0.3, 1);
  CHECK(oddities_of(shape).degenerate_faces == Numbers{6, 7, 9});
}

TEST_CASE("oddities: duplicates and isolated vertices") {
  oracle::Shape shape = box({0, 0, 0}, {1, 1, 1});
  shape.positions.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);  // 8
  shape.positions.emplace_back(1, 1, 1);                                         // 9, where 7 is
  shape.positions.emplace_back(-0.0, 0, 0);                                      // 10, where 0 is
  shape.positions.emplace_back(1, 1, 1);                                         // 11, unused
  shape.faces.insert(shape.faces.end(), {{0, 1, 2}, {9, 10, 4}, {2, 0, 1}, {7, 5, 4, 6}});
  const MeshOddities odd = oddities_of(shape);
  CHECK(odd.isolated_vertices == Numbers{8, 11});
  CHECK(odd.duplicate_vertices == Numbers{9, 10});
  CHECK(odd.duplicate_faces == Numbers{8, 9});
}

TEST_CASE("oddities: edges of one face, of three, and of two that run the same way") {
  oracle::Shape shape = box({0, 0, 0}, {1, 1, 1});
  shape.faces.push_back({0, 1, 7});  // a fin on the edge from 0 to 1
  MeshOddities odd = oddities_of(shape);
  CHECK(odd.non_manifold_edges == Numbers{edge_between(shape, 0, 1)});
  CHECK(odd.border_edges == Numbers{edge_between(shape, 1, 7), edge_between(shape, 0, 7)});
  CHECK(odd.flipped_edges.empty());

  shape = box({0, 0, 0}, {1, 1, 1});
  std::reverse(shape.faces[1].begin(), shape.faces[1].end());
  odd = oddities_of(shape);
  CHECK(odd.closed_manifold());
  Numbers around_top{edge_between(shape, 4, 5), edge_between(shape, 5, 7), edge_between(shape, 6, 7),
                     edge_between(shape, 4, 6)};
  std::sort(around_top.begin(), around_top.end());
  CHECK(odd.flipped_edges == around_top);
}

}  // namespace graze::tests
