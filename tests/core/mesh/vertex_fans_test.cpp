// The fans of vertices, beside the triangles of their faces one by one.

#include <algorithm>
#include <array>
#include <graze/mesh.hpp>
#include <vector>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Numbers = std::vector<std::uint32_t>;
/// The other two corners of a triangle that has a vertex, in its sense.
using Turn = std::array<std::uint32_t, 2>;

Numbers fans_of(const Mesh& mesh, std::uint32_t vertex) {
  const auto fans = indexed(mesh).vertex_fans(vertex);
  return {fans.begin(), fans.end()};
}

std::vector<Turn> expected_turns(const oracle::Shape& shape, std::uint32_t vertex) {
  std::vector<Turn> turns;
  for (const Numbers& face : shape.faces)
    for (std::size_t last = 2; last < face.size(); ++last) {
      const Numbers corner{face[0], face[last - 1], face[last]};
      if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
      for (std::size_t i = 0; i < 3; ++i)
        if (corner[i] == vertex) turns.push_back({corner[(i + 1) % 3], corner[(i + 2) % 3]});
    }
  std::sort(turns.begin(), turns.end());
  return turns;
}

std::vector<Turn> turns_of(const Numbers& fans, std::uint32_t vertex) {
  std::vector<Turn> turns;
  for (std::size_t i = 1; i < fans.size(); ++i)
    if (fans[i - 1] != vertex && fans[i] != vertex) turns.push_back({fans[i - 1], fans[i]});
  std::sort(turns.begin(), turns.end());
  return turns;
}

/// Whether the fans have each triangle of each vertex as often as the faces have it.
void check_triangles(const oracle::Shape& shape) {
  const auto mesh = mesh_of(shape);
  for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex) {
    const Numbers fans = fans_of(*mesh, vertex);
    REQUIRE(turns_of(fans, vertex) == expected_turns(shape, vertex));
    const auto parts = static_cast<std::size_t>(std::count(fans.begin(), fans.end(), vertex)) + 1;
    if (!fans.empty()) REQUIRE(fans.size() == expected_turns(shape, vertex).size() + 2 * parts - 1);
  }
}

oracle::Shape of_faces(std::size_t vertices, std::vector<Numbers> faces) {
  return {std::vector<Eigen::Vector3d>(vertices, Eigen::Vector3d::Zero()), std::move(faces)};
}

}  // namespace

TEST_CASE("fans: every triangle of a vertex is in them once") {
  for (std::uint32_t seed = 0; seed < 200; ++seed) check_triangles(random_soup(seed, 4 + seed % 9, 12));
  for (const auto& model : paper_models()) check_triangles(model.shape);
  for (const auto& model : paper_models_of_quads()) check_triangles(model.shape);
}

TEST_CASE("fans: about a vertex of a closed surface there is one, which ends where it begins") {
  for (const auto& model : paper_models()) {
    const auto mesh = mesh_of(model.shape);
    std::size_t closed = 0;
    for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex) {
      const Numbers fans = fans_of(*mesh, vertex);
      closed += !fans.empty() && fans.front() == fans.back() ? 1U : 0U;
    }
    CHECK(closed > mesh->vertex_count() * 9 / 10);
  }
}

TEST_CASE("fans: open ones begin at their first edge, and the vertex stands between fans") {
  // In no order, and the quad as two triangles of vertex 0.
  const auto open = mesh_of(of_faces(6, {{0, 3, 4}, {1, 2, 0}, {0, 2, 5, 3}}));
  CHECK(fans_of(*open, 0) == Numbers{1, 2, 5, 3, 4});
  CHECK(fans_of(*open, 5) == Numbers{3, 0, 2});
  const auto two = mesh_of(of_faces(5, {{0, 3, 4}, {0, 1, 2}}));
  CHECK(fans_of(*two, 0) == Numbers{1, 2, 0, 3, 4});
  const auto closed = mesh_of(of_faces(4, {{0, 2, 3}, {0, 3, 1}, {0, 1, 2}}));
  CHECK(fans_of(*closed, 0) == Numbers{1, 2, 3, 1});
}

TEST_CASE("fans: faces against each other's sense, around one edge, and without area") {
  const auto against = mesh_of(of_faces(4, {{0, 1, 2}, {0, 3, 2}}));
  CHECK(fans_of(*against, 0) == Numbers{1, 2, 0, 3, 2});
  check_triangles(of_faces(5, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 0, 2}}));
  check_triangles(of_faces(3, {{0, 1, 2}, {0, 1, 2}}));
  oracle::Shape book = of_faces(402, {});
  for (std::uint32_t page = 2; page < 402; ++page)
    book.faces.insert(book.faces.end(), {{0, 1, page}, {0, page, 1}});
  check_triangles(book);
  CHECK(fans_of(*mesh_of(book), 0).size() == 801);
  const auto flat = mesh_of(of_faces(4, {{0, 1, 1}, {0, 0, 2}, {0, 1, 0, 2}}));
  for (const std::uint32_t vertex : {0U, 1U, 2U, 3U}) CHECK(fans_of(*flat, vertex).empty());
}

}  // namespace graze::tests
