// Positions as programs keep them: each form gives the same points as a plain list of them.

#include <graze/position_view.hpp>
#include <limits>
#include <vector>

#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Catch::Matchers::Contains;
using Points = std::vector<Eigen::Vector3d>;

/// Points that floats hold exactly.
const Points corners = {{0, 0, 0}, {1, 0.5, 0.25}, {-2, 1, 3}, {0.125, -4, 8}};

struct Own {
  float x, y, z;
};
struct OwnDouble {
  double x, y, z;
};
struct Vertex {
  float u, v;
  float x, y, z;
};
struct Particle {
  double mass;
  Eigen::Vector3d position;
  double radius;
};
struct Node : Particle {
  int number;
};
struct Record {
  std::int32_t number;
  float place[3];
};
struct Plane {
  double offset, x;  // nothing after x
};

void check_is(const PositionView& view, bool is_double) {
  REQUIRE(view.size() == corners.size());
  CHECK(view.is_double() == is_double);
  for (std::size_t i = 0; i < corners.size(); ++i) CHECK(view[i] == corners[i]);
}

template <typename Matrix>
Matrix rows_of_corners() {
  Matrix matrix(static_cast<Eigen::Index>(corners.size()), 3);
  for (std::size_t i = 0; i < corners.size(); ++i)
    matrix.row(static_cast<Eigen::Index>(i)) = corners[i].transpose().cast<typename Matrix::Scalar>();
  return matrix;
}

// Types that are no position do not convert.
static_assert(!PackedPoint<std::array<int, 3>> && !PackedPoint<Eigen::Vector3i> && !PackedPoint<Vertex>);
static_assert(!PackedPoint<Eigen::Vector4f> && !PackedPoint<Eigen::Vector2d>);
static_assert(!std::is_constructible_v<PositionView, Eigen::MatrixXi>);
static_assert(!std::is_constructible_v<PositionView, std::vector<Vertex>>);
static_assert(!std::is_constructible_v<PositionView, std::vector<Vertex>, int Record::*>);

}  // namespace

TEST_CASE("a caller's own struct of three numbers is a point") {
  std::vector<Own> floats;
  std::vector<OwnDouble> doubles;
  for (const Eigen::Vector3d& p : corners) {
    floats.push_back({float(p.x()), float(p.y()), float(p.z())});
    doubles.push_back({p.x(), p.y(), p.z()});
  }
  check_is(floats, false);
  check_is(std::span<const Own>(floats), false);
  check_is(doubles, true);
  CHECK(PositionView(floats).stride_bytes() == 12);
  CHECK(PositionView(floats).data() == floats.data());
}

TEST_CASE("positions inside of a caller's structs are named by a member") {
  std::vector<Vertex> vertices;
  std::vector<Node> nodes;
  std::vector<Record> records;
  for (const Eigen::Vector3d& p : corners) {
    vertices.push_back({7, 8, float(p.x()), float(p.y()), float(p.z())});
    nodes.push_back({{2, p, 3}, 4});
    records.push_back({3, {float(p.x()), float(p.y()), float(p.z())}});
  }
  check_is(PositionView(vertices, &Vertex::x), false);
  check_is(PositionView(std::span(vertices), &Vertex::x), false);
  check_is(PositionView(nodes, &Node::position), true);  // of its base
  check_is(PositionView(records, &Record::place), false);
  CHECK(PositionView(vertices, &Vertex::x).stride_bytes() == sizeof(Vertex));
  CHECK(PositionView(vertices, &Vertex::x).data() == &vertices[0].x);

  CHECK(PositionView(std::vector<Vertex>(), &Vertex::x).size() == 0);
  const std::vector<Plane> planes(2);
  REQUIRE_THROWS_WITH(PositionView(planes, &Plane::x),
                      Contains("no y and z after it in its struct of 16 bytes"));
}

TEST_CASE("matrices of n rows and 3 columns are read where they are") {
  const auto by_columns = rows_of_corners<Eigen::MatrixXd>();
  check_is(by_columns, true);
  CHECK(PositionView(by_columns).data() == by_columns.data());
  CHECK(PositionView(by_columns).stride_bytes() == sizeof(double));
  CHECK(PositionView(by_columns).coordinate_stride_bytes() == 4 * sizeof(double));
  CHECK_FALSE(PositionView(by_columns).has_joined_coordinates());
  check_is(rows_of_corners<Eigen::MatrixXf>(), false);
  check_is(rows_of_corners<Eigen::MatrixX3d>(), true);
  const auto by_rows = rows_of_corners<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>>();
  check_is(by_rows, false);
  CHECK(PositionView(by_rows).has_joined_coordinates());

  // Pieces of matrices, and memory of another program's.
  Eigen::MatrixXd wide = Eigen::MatrixXd::Constant(9, 7, -1);
  wide.block(2, 3, 4, 3) = by_columns;
  check_is(wide.block(2, 3, 4, 3), true);
  const Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>> ref(wide.block(2, 3, 4, 3));
  check_is(ref, true);
  check_is(Eigen::Map<const Eigen::MatrixX3d>(by_columns.data(), 4, 3), true);
}

TEST_CASE("a type of exactly three rows has a point in each column") {
  const Eigen::Matrix3Xd columns = rows_of_corners<Eigen::MatrixXd>().transpose();
  check_is(columns, true);
  CHECK(PositionView(columns).has_joined_coordinates());
  const Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::RowMajor> by_rows = columns.cast<float>();
  check_is(by_rows, false);
  CHECK_FALSE(PositionView(by_rows).has_joined_coordinates());
}

TEST_CASE("a matrix with another number of columns than 3 is refused") {
  const Eigen::MatrixXd transposed = rows_of_corners<Eigen::MatrixXd>().transpose();
  REQUIRE_THROWS_WITH(PositionView(transposed),
                      "positions: a matrix of 3 rows and 4 columns; give a point in each row, in 3 columns");
}

TEST_CASE("a surface reads coordinates that lie apart as those that follow one another") {
  oracle::Random random(5);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto mesh = mesh_of(oracle::random_scene(seed).a);
    Surface joined(mesh), apart(mesh);
    for (int frame = 0; frame < 3; ++frame) {
      Points points(mesh->rest().begin(), mesh->rest().end());
      for (Eigen::Vector3d& point : points) point += random.vector(-1, 1);
      if (frame == 2) points[mesh->face(0)[0]].y() = std::numeric_limits<double>::infinity();
      Eigen::MatrixXd matrix(static_cast<Eigen::Index>(points.size()), 3);
      for (std::size_t i = 0; i < points.size(); ++i)
        matrix.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
      const Surface::ReadResult a = joined.set_positions(points);
      const Surface::ReadResult b = apart.set_positions(matrix);
      CHECK(a.taken() == (frame < 2));
      CHECK(a.bad_vertex == b.bad_vertex);
      CHECK(a.displacement == b.displacement);
      CHECK(joined.box().min == apart.box().min);
      CHECK(joined.box().max == apart.box().max);
      for (std::uint32_t vertex = 0; vertex < mesh->vertex_count(); ++vertex)
        if (mesh->is_used(vertex)) CHECK(joined.position(vertex) == apart.position(vertex));
      CHECK_FALSE(apart.can_view(matrix));
    }
  }
}

}  // namespace graze::tests
