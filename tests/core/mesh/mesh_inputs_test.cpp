// Faces as programs keep them: each form gives the mesh that a list of arrays gives.

#include <graze/error.hpp>
#include <graze/mesh.hpp>
#include <vector>

#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Quad = std::array<std::uint32_t, 4>;

struct OwnTriangle {
  int a, b, c;
};
struct OwnQuad {
  std::uint32_t corner[4];
};

const std::vector<Eigen::Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                                             {0, 1, 0}, {2, 0, 1}, {2, 1, 1}};
const std::vector<Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
const std::vector<Quad> quads = {{0, 1, 2, 3}, {1, 4, 5, 2}};

template <typename Number>
const std::vector<Number> flat_triangles = {0, 1, 2, 0, 2, 3, 1, 4, 2};
template <typename Number>
const std::vector<Number> flat_quads = {0, 1, 2, 3, 1, 4, 5, 2};

void check_faces(const Mesh& mesh, const Mesh& expected) {
  CHECK(mesh.vertex_count() == points.size());
  REQUIRE(mesh.face_count() == expected.face_count());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    CHECK(std::ranges::equal(mesh.face(face), expected.face(face)));
  REQUIRE(mesh.edge_count() == expected.edge_count());
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge)
    CHECK(mesh.edge(edge) == expected.edge(edge));
}

/// As check_faces, of triangles in any form, and of the same in a span.
template <typename Faces>
void check_triangles(const Faces& faces) {
  check_faces(Mesh::from_triangles(points, faces), Mesh::from_triangles(points, triangles));
}
template <typename Faces>
void check_quads(const Faces& faces) {
  check_faces(Mesh::from_quads(points, faces), Mesh::from_quads(points, quads));
}

// Numbers that are no corners do not convert.
static_assert(!CornerTuple<Eigen::Vector3f, 3> && !CornerTuple<std::array<float, 3>, 3>);
static_assert(!CornerTuple<OwnTriangle, 4> && !CornerTuple<std::array<std::uint64_t, 3>, 3>);
static_assert(!CornerTuple<std::array<std::int16_t, 3>, 3> && CornerTuple<OwnTriangle, 3>);

}  // namespace

TEST_CASE("triangles from flat lists of corners, with a sign or without") {
  check_triangles(flat_triangles<std::uint32_t>);
  check_triangles(flat_triangles<std::int32_t>);
  check_triangles(std::span<const std::uint32_t>(flat_triangles<std::uint32_t>));
  check_triangles(std::span<const std::int32_t>(flat_triangles<std::int32_t>));
  const int in_array[] = {0, 1, 2, 0, 2, 3, 1, 4, 2};
  check_triangles(in_array);
}

TEST_CASE("triangles from any triple of 32-bit integers") {
  const std::vector<Eigen::Vector3i> of_eigen = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  const std::vector<std::array<int, 3>> arrays = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  const std::vector<OwnTriangle> own = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  check_triangles(of_eigen);
  check_triangles(arrays);
  check_triangles(own);
  check_triangles(std::span<const OwnTriangle>(own));
  check_triangles(std::span<const Triangle>(triangles));
}

TEST_CASE("triangles and quads from the rows of a matrix") {
  Eigen::MatrixXi by_columns(3, 3);
  by_columns << 0, 1, 2, 0, 2, 3, 1, 4, 2;
  const Eigen::Matrix<std::uint32_t, Eigen::Dynamic, 4, Eigen::RowMajor> by_rows =
      Eigen::Map<const Eigen::Matrix<std::uint32_t, 2, 4, Eigen::RowMajor>>(flat_quads<std::uint32_t>.data());
  check_triangles(by_columns);
  check_triangles(by_columns.topRows(3));
  check_quads(by_rows);
  CHECK_THROWS_WITH(Mesh::from_quads(points, by_columns),
                    "mesh: a matrix of 3 rows and 3 columns; give a face in each row, in 4 columns");
}

TEST_CASE("quads from flat lists of corners and from any four 32-bit integers") {
  check_quads(flat_quads<std::uint32_t>);
  check_quads(flat_quads<std::int32_t>);
  check_quads(std::vector<Eigen::Vector4i>{{0, 1, 2, 3}, {1, 4, 5, 2}});
  check_quads(std::vector<std::array<int, 4>>{{0, 1, 2, 3}, {1, 4, 5, 2}});
  check_quads(std::vector<OwnQuad>{{{0, 1, 2, 3}}, {{1, 4, 5, 2}}});
}

TEST_CASE("mixed faces from corners and counts with a sign") {
  const std::vector<std::int32_t> corners = {0, 1, 2, 3, 1, 4, 2};
  const std::vector<std::uint32_t> as_unsigned(corners.begin(), corners.end());
  const Mesh expected = Mesh::from_polygons(points, as_unsigned, std::vector<std::uint32_t>{4, 3});
  check_faces(Mesh::from_polygons(points, corners, std::vector<int>{4, 3}), expected);
  check_faces(Mesh::from_polygons(points, corners, std::vector<std::uint32_t>{4, 3}), expected);
  check_faces(Mesh::from_polygons(points, as_unsigned, std::vector<std::int64_t>{4, 3}), expected);
}

TEST_CASE("corners that make no whole face, and negative ones, are refused") {
  CHECK_THROWS_WITH(Mesh::from_triangles(points, std::vector<int>{0, 1, 2, 3}),
                    "mesh: 4 corners are no whole number of faces of 3");
  CHECK_THROWS_WITH(Mesh::from_quads(points, std::vector<std::uint32_t>{0, 1, 2}),
                    "mesh: 3 corners are no whole number of faces of 4");
  CHECK_THROWS_WITH(Mesh::from_triangles(points, std::vector<int>{0, 1, -1}),
                    "mesh: face 0 names vertex 4294967295 (-1 with a sign), but there are 6 vertices");
  CHECK_THROWS_AS(Mesh::from_triangles(points, std::vector<Eigen::Vector3i>()), Error);
}

}  // namespace graze::tests
