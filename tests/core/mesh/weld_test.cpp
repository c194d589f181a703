// This test compares weld() with its rule, word for word, and looks at what becomes of faces.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <graze/weld.hpp>
#include <limits>
#include <random>
#include <vector>

#include "core/mesh/closed.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// The faces of a cube with four vertices of its own for each face, as a renderer keeps it.
struct RenderedCube {
  Points points;
  std::vector<std::array<std::uint32_t, 4>> quads;
};

RenderedCube rendered_cube() {
  const std::array<std::array<int, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}}};
  RenderedCube cube;
  for (const auto& face : faces) {
    const auto first = static_cast<std::uint32_t>(cube.points.size());
    for (const int corner : face)
      cube.points.emplace_back((corner & 1) != 0 ? 1 : 0, (corner & 2) != 0 ? 1 : 0,
                               (corner & 4) != 0 ? 1 : 0);
    cube.quads.push_back({first, first + 1, first + 2, first + 3});
  }
  return cube;
}

/// The rule word for word: each point becomes the first that stayed and is at most the distance away.
std::vector<std::uint32_t> new_by_brute_force(const Points& points, double distance) {
  Points stayed;
  std::vector<std::uint32_t> new_of_old;
  for (const Eigen::Vector3d& point : points) {
    const auto near = std::find_if(stayed.begin(), stayed.end(), [&](const Eigen::Vector3d& other) {
      return (other - point).stableNorm() <= distance;
    });
    new_of_old.push_back(static_cast<std::uint32_t>(near - stayed.begin()));
    if (near == stayed.end()) stayed.push_back(point);
  }
  return new_of_old;
}

}  // namespace

TEST_CASE("weld: a cube with vertices of its own for each face becomes a solid") {
  const RenderedCube cube = rendered_cube();
  CHECK(why_not_closed(indexed(Mesh::from_quads(cube.points, cube.quads))).has_value());

  const WeldedMesh welded = weld(cube.points, cube.quads);
  CHECK(welded.mesh.vertex_count() == 8);
  CHECK(welded.mesh.face_count() == 6);
  CHECK_FALSE(why_not_closed(indexed(welded.mesh)).has_value());
  for (std::uint32_t face = 0; face < 6; ++face) {
    CHECK(welded.new_face_of_old[face] == face);
    for (std::size_t corner = 0; corner < 4; ++corner) {
      CHECK(welded.mesh.face(face)[corner] == welded.new_of_old[cube.quads[face][corner]]);
      CHECK(welded.mesh.rest()[welded.mesh.face(face)[corner]] == cube.points[cube.quads[face][corner]]);
    }
  }
}

TEST_CASE("weld: every vertex becomes the first one that stayed within the distance") {
  std::mt19937 random(47);
  for (std::size_t trial = 0; trial < 300; ++trial) {
    // Coordinates on a coarse grid give distances that are equal to the limit, and cells that touch.
    std::uniform_int_distribution<int> step(-5, 5);
    const double scale = trial % 5 == 0 ? 1e30 : trial % 5 == 1 ? 1e-30 : 0.25;
    const double offset = trial % 3 == 0 ? 1e6 * scale : 0;
    const double distance = scale * std::array{0.0, 1.0, std::sqrt(2.0), 2.5, 0.5}[trial % 7 % 5];
    Points points(60);
    for (Eigen::Vector3d& point : points)
      point = Eigen::Vector3d{step(random) * scale + offset, step(random) * scale, step(random) * scale};
    std::vector<std::uint32_t> faces(points.size());
    for (std::uint32_t corner = 0; corner < faces.size(); ++corner) faces[corner] = corner;
    const Mesh mesh = Mesh::from_triangles(points, faces);
    const std::vector<std::uint32_t> expected = new_by_brute_force(points, distance);
    bool has_face = false;
    for (std::size_t face = 0; face < faces.size(); face += 3)
      has_face =
          has_face || (expected[face] != expected[face + 1] && expected[face + 1] != expected[face + 2] &&
                       expected[face] != expected[face + 2]);
    if (has_face)
      REQUIRE(weld(mesh, distance).new_of_old == expected);
    else
      REQUIRE_THROWS_AS(weld(mesh, distance), Error);
  }
}

TEST_CASE("weld: -0 and 0 are one place, and unused vertices have no new one") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {nan, 0, 0}, {-0.0, 0, -0.0}, {1, 0, 0}, {0, 0, 1}};
  const WeldedMesh welded = weld(points, std::vector<std::array<int, 3>>{{0, 1, 2}, {4, 6, 5}});
  CHECK(welded.new_of_old == std::vector<std::uint32_t>{0, 1, 2, Mesh::no_vertex, 0, 1, 3});
  CHECK(welded.mesh.vertex_count() == 4);
  CHECK(welded.mesh.edge_count() == 5);
}

TEST_CASE("weld: faces that lose corners become triangles or are left out") {
  const Points points{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {4, 4.5, 0}, {0, 0.5, 0}, {9, 9, 9}};
  const std::vector<std::array<int, 4>> quads{{0, 1, 2, 3},  // stays
                                              {1, 2, 4, 3},  // loses the corner 4 and becomes a triangle
                                              {0, 1, 6, 5},  // loses its last corner, which becomes its first
                                              {1, 0, 6, 5},  // its opposite corners become one
                                              {0, 5, 2, 4}};  // two different vertices are left
  const WeldedMesh welded = weld(points, quads, 0.5);
  constexpr std::uint32_t none = WeldedMesh::no_face;
  CHECK(welded.new_face_of_old == std::vector<std::uint32_t>{0, 1, 2, none, none});
  CHECK(welded.mesh.face(0).size() == 4);
  REQUIRE(welded.mesh.face(1).size() == 3);
  CHECK(std::vector<std::uint32_t>(welded.mesh.face(1).begin(), welded.mesh.face(1).end()) ==
        std::vector<std::uint32_t>{1, 2, 3});
  CHECK(std::vector<std::uint32_t>(welded.mesh.face(2).begin(), welded.mesh.face(2).end()) ==
        std::vector<std::uint32_t>{0, 1, 4});
}

TEST_CASE("weld: distances that mean nothing and meshes that vanish are refused") {
  const RenderedCube cube = rendered_cube();
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double distance : {-1.0, infinite, std::numeric_limits<double>::quiet_NaN()})
    CHECK_THROWS_AS(weld(cube.points, cube.quads, distance), Error);
  CHECK_THROWS_AS(weld(cube.points, cube.quads, 2), Error);
}

}  // namespace graze::tests
