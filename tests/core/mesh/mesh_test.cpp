// Topology as given: counts, edge numbers, incidence against naive recomputation, and what is refused.

#include <algorithm>
#include <array>
#include <cmath>
#include <graze/error.hpp>
#include <graze/mesh.hpp>
#include <iostream>
#include <limits>
#include <set>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using Numbers = std::vector<std::uint32_t>;
using Edge = std::array<std::uint32_t, 2>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Numbers listed(std::span<const std::uint32_t> values) {
  return {values.begin(), values.end()};
}

Numbers listed(const std::set<std::uint32_t>& values) {
  return {values.begin(), values.end()};
}

std::vector<Edge> edges_of(const Mesh& mesh) {
  std::vector<Edge> edges;
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) edges.push_back(mesh.edge(edge));
  return edges;
}

/// The edges in the order of first appearance, by looking through all of them for each corner.
std::vector<Edge> naive_edges(const std::vector<Numbers>& faces) {
  std::vector<Edge> edges;
  for (const Numbers& face : faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      const std::uint32_t next = face[(i + 1) % face.size()];
      const Edge edge{std::min(face[i], next), std::max(face[i], next)};
      if (edge[0] != edge[1] && std::find(edges.begin(), edges.end(), edge) == edges.end())
        edges.push_back(edge);
    }
  }
  return edges;
}

void check_against_naive(const oracle::Shape& shape) {
  const auto mesh = mesh_of(shape);
  REQUIRE(mesh->vertex_count() == shape.positions.size());
  REQUIRE(mesh->face_count() == shape.faces.size());
  REQUIRE(edges_of(*mesh) == naive_edges(shape.faces));
  for (std::uint32_t face = 0; face < mesh->face_count(); ++face) {
    const Numbers& corners = shape.faces[face];
    CHECK(listed(mesh->face(face)) == corners);
    REQUIRE(mesh->face_edges(face).size() == corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t edge = mesh->face_edges(face)[i];
      const std::uint32_t next = corners[(i + 1) % corners.size()];
      if (corners[i] == next)
        CHECK(edge == Mesh::no_edge);
      else
        CHECK(mesh->edge(edge) == Edge{std::min(corners[i], next), std::max(corners[i], next)});
    }
  }
  for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex) {
    std::set<std::uint32_t> faces;
    std::set<std::uint32_t> neighbours;
    for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
      const Numbers& corners = shape.faces[face];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] != vertex) continue;
        faces.insert(face);
        neighbours.insert(corners[(i + 1) % corners.size()]);
        neighbours.insert(corners[(i + corners.size() - 1) % corners.size()]);
      }
    }
    neighbours.erase(vertex);
    CHECK(listed(mesh->vertex_faces(vertex)) == listed(faces));
    CHECK(listed(mesh->vertex_neighbours(vertex)) == listed(neighbours));
    CHECK(mesh->is_used(vertex) == !faces.empty());
  }
  for (std::uint32_t edge = 0; edge < mesh->edge_count(); ++edge) {
    const auto [low, high] = mesh->edge(edge);
    std::set<std::uint32_t> faces;
    for (std::uint32_t face = 0; face < shape.faces.size(); ++face) {
      const Numbers& corners = shape.faces[face];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t next = corners[(i + 1) % corners.size()];
        if (std::min(corners[i], next) == low && std::max(corners[i], next) == high) faces.insert(face);
      }
    }
    CHECK(listed(mesh->edge_faces(edge)) == listed(faces));
  }
}

const std::vector<Vector3d> five_points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};

/// The message with which a mesh is refused, or nothing.
std::string refusal(const PositionView& rest, const Numbers& corners, const Numbers& counts) {
  try {
    Mesh::from_polygons(rest, corners, counts);
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

bool names(const std::string& message, std::initializer_list<const char*> parts) {
  bool all = message.starts_with("mesh: ");
  for (const char* part : parts) all = all && message.find(part) != std::string::npos;
  return all;
}

}  // namespace

TEST_CASE("mesh: edges are numbered in the order of first appearance, lower vertex first") {
  const auto mesh =
      Mesh::from_polygons(five_points, Numbers{2, 1, 0, 3, 2, 4, 1}, std::vector<std::uint8_t>{4, 3});
  CHECK(mesh.vertex_count() == 5);
  CHECK(mesh.face_count() == 2);
  CHECK(edges_of(mesh) == std::vector<Edge>{{1, 2}, {0, 1}, {0, 3}, {2, 3}, {2, 4}, {1, 4}});
  CHECK(listed(mesh.face(0)) == Numbers{2, 1, 0, 3});
  CHECK(listed(mesh.face(1)) == Numbers{2, 4, 1});
  CHECK(listed(mesh.face_edges(0)) == Numbers{0, 1, 2, 3});
  CHECK(listed(mesh.face_edges(1)) == Numbers{4, 5, 0});
  CHECK(listed(mesh.vertex_neighbours(1)) == Numbers{0, 2, 4});
  CHECK(listed(mesh.vertex_faces(2)) == Numbers{0, 1});
  CHECK(listed(mesh.edge_faces(0)) == Numbers{0, 1});
  CHECK(listed(mesh.edge_faces(5)) == Numbers{1});
}

TEST_CASE("mesh: a repeated vertex is accepted, and a self-edge is no edge") {
  const auto mesh = Mesh::from_polygons(five_points, Numbers{0, 0, 1, 2, 2, 2, 3, 4, 3, 4},
                                        std::vector<std::uint16_t>{3, 3, 4});
  CHECK(edges_of(mesh) == std::vector<Edge>{{0, 1}, {3, 4}});
  CHECK(listed(mesh.face(0)) == Numbers{0, 0, 1});
  CHECK(listed(mesh.face_edges(0)) == Numbers{Mesh::no_edge, 0, 0});
  CHECK(listed(mesh.face_edges(1)) == Numbers{Mesh::no_edge, Mesh::no_edge, Mesh::no_edge});
  CHECK(listed(mesh.face_edges(2)) == Numbers{1, 1, 1, 1});
  CHECK(listed(mesh.vertex_neighbours(2)).empty());
  CHECK(listed(mesh.vertex_faces(3)) == Numbers{2});
  CHECK(listed(mesh.edge_faces(1)) == Numbers{2});
  CHECK(mesh.is_used(2));
}

TEST_CASE("mesh: triangles, quads and polygons of one shape are the same mesh") {
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  const std::vector<std::array<std::uint32_t, 4>> quads{{0, 1, 2, 3}};
  const auto of_triangles = Mesh::from_triangles(five_points, triangles);
  CHECK(of_triangles.face_count() == 2);
  CHECK(edges_of(of_triangles) == std::vector<Edge>{{0, 1}, {1, 2}, {0, 2}, {2, 3}, {0, 3}});
  const auto of_quads = Mesh::from_quads(five_points, quads);
  CHECK(of_quads.face_count() == 1);
  CHECK(edges_of(of_quads) == std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}, {0, 3}});
  CHECK_FALSE(of_quads.is_used(4));
}

TEST_CASE("mesh: topology equals naive recomputation") {
  std::size_t soups = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed, ++soups) {
    INFO("seed " << seed);
    const auto size = static_cast<std::uint32_t>(seed);
    check_against_naive(random_soup(seed, 1 + size, 1 + 2 * size));
  }
  for (const NamedShape& model : paper_models()) {
    INFO(model.name);
    const auto mesh = mesh_of(model.shape);
    CHECK(edges_of(*mesh).size() == model.shape.faces.size() * 3 / 2);
  }
  check_against_naive(shape_of(models::cylinder(models::Faces::quads)));
  std::cout << "compared the topology of " << soups << " soups and a model of quads\n";
}

TEST_CASE("mesh: a vertex that no face uses may hold anything") {
  const std::vector<Vector3d> rest{{nan, 0, 0},      {0, 0, 0}, {1, 0, 0},
                                   {infinity, 1, 1}, {0, 1, 0}, {0x1p200, 0, 0}};
  const auto mesh = Mesh::from_triangles(rest, std::vector<std::array<std::uint32_t, 3>>{{1, 2, 4}});
  CHECK(mesh.vertex_count() == 6);
  CHECK(std::isnan(mesh.rest()[0].x()));
  CHECK(listed(indexed(mesh).regions().vertices()) == Numbers{1, 2, 4});
  for (const std::uint32_t unused : {0U, 3U, 5U}) CHECK_FALSE(mesh.is_used(unused));
}

TEST_CASE("mesh: rest positions come from floats, doubles and strided memory alike") {
  struct Node {
    float weight;
    std::array<float, 3> position;
    std::int32_t tag;
  };
  struct Wide {
    std::array<double, 3> position;
    double mass;
  };
  std::vector<Eigen::Vector3f> floats;
  std::vector<std::array<double, 3>> arrays;
  std::vector<Node> nodes;
  std::vector<Wide> wides;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3f p(0.1F * static_cast<float>(i), 1.0F / 3.0F * static_cast<float>(i * i), -0.7F);
    floats.push_back(p);
    arrays.push_back({p.x(), p.y(), p.z()});
    nodes.push_back({5, {p.x(), p.y(), p.z()}, 7});
    wides.push_back({{p.x(), p.y(), p.z()}, 9});
  }
  const std::vector<std::array<std::uint32_t, 3>> faces{{0, 1, 2}, {1, 3, 2}};
  const std::vector<Mesh> meshes{
      Mesh::from_triangles(floats, faces), Mesh::from_triangles(arrays, faces),
      Mesh::from_triangles(PositionView(nodes[0].position.data(), nodes.size(), sizeof(Node)), faces),
      Mesh::from_triangles(PositionView(wides[0].position.data(), wides.size(), sizeof(Wide)), faces)};
  for (const Mesh& mesh : meshes)
    for (std::size_t i = 0; i < floats.size(); ++i) CHECK(mesh.rest()[i] == floats[i].cast<double>());
}

TEST_CASE("mesh: what is refused is named") {
  const PositionView rest(five_points);
  CHECK(refusal(rest, {0, 1, 2}, {3}).empty());
  CHECK(names(refusal(rest, {}, {}), {"no face"}));
  CHECK(names(refusal(rest, {0, 1, 2, 0, 1, 5}, {3, 3}), {"face 1", "vertex 5", "5 vertices"}));
  CHECK(names(refusal(rest, {0, 1, 4294967295U}, {3}), {"face 0", "vertex 4294967295"}));
  CHECK(names(refusal(rest, {0, 1, 2, 0, 1}, {3, 2}), {"face 1", "2 corners"}));
  CHECK(names(refusal(rest, {0, 1, 2, 3, 4}, {5}), {"face 0", "5 corners"}));
  CHECK(names(refusal(rest, {0, 1, 2}, {3, 0}), {"face 1", "0 corners"}));
  CHECK(names(refusal(rest, {0, 1, 2, 3}, {3}), {"add up to 3", "4 corners"}));
  CHECK(names(refusal(rest, {0, 1, 2}, {4}), {"more than 3", "3 corners"}));
  CHECK(names(refusal(rest, {0, 1, 2}, {3, 3}), {"more than 3", "3 corners"}));
  CHECK(
      names(refusal(PositionView(static_cast<const double*>(nullptr), 3), {0, 1, 2}, {3}), {"null memory"}));
  CHECK(names(refusal(PositionView(), {0, 0, 0}, {3}), {"face 0", "vertex 0", "0 vertices"}));
  const std::vector<std::int64_t> negative{-3};
  CHECK_THROWS_AS(Mesh::from_polygons(rest, Numbers{0, 1, 2}, negative), Error);
}

TEST_CASE("mesh: used rest positions are finite and at most 2^120") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bad : {nan, infinity, -infinity, 0x1p121, -0x1p121, std::nextafter(0x1p120, infinity),
                             std::numeric_limits<double>::max()}) {
      std::vector<Vector3d> rest = five_points;
      rest[3][axis] = bad;
      INFO("axis " << axis << ", " << bad);
      CHECK(names(refusal(rest, {0, 1, 2, 1, 2, 3}, {3, 3}), {"vertex 3"}));
      CHECK(refusal(rest, {0, 1, 2}, {3}).empty());
    }
    for (const double good : {0x1p120, -0x1p120, -0.0, std::numeric_limits<double>::denorm_min()}) {
      std::vector<Vector3d> rest = five_points;
      rest[3][axis] = good;
      CHECK(refusal(rest, {1, 2, 3}, {3}).empty());
    }
  }
}

TEST_CASE("mesh: its bytes count what it holds") {
  const auto small = mesh_of(box({0, 0, 0}, {1, 1, 1}));
  const auto large = mesh_of(shape_of(models::torus()));
  CHECK(small->byte_count() > sizeof(Mesh) + 8 * sizeof(Vector3d));
  CHECK(large->byte_count() > sizeof(Mesh) + 768 * sizeof(Vector3d) + indexed(*large).regions().byte_count());
}

}  // namespace graze::tests
