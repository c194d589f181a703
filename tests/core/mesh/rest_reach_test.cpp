// The box of a posed mesh and the bound of its motion, against its vertices one by one.

#include "core/mesh/rest_reach.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <graze/mesh.hpp>

#include "core/mesh/indexed_mesh.hpp"
#include "models/models.hpp"
#include "support/catch.hpp"
#include "support/mesh_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Rows = std::array<double, 12>;

Eigen::Vector3d placed(const Rows& rows, const Eigen::Vector3d& p) {
  Eigen::Vector3d at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double* const r = &rows[4 * axis];
    at[static_cast<int>(axis)] = ((r[0] * p.x() + r[1] * p.y()) + r[2] * p.z()) + r[3];
  }
  return at;
}

Box box_of(const Mesh& mesh, const Rows& rows) {
  Box box;
  for (const std::uint32_t vertex : indexed(mesh).regions().vertices())
    box.add(placed(rows, mesh.rest()[vertex]));
  return box;
}

/// A rotation that is off by as much as the contract takes, or any matrix.
Rows random_rows(oracle::Random& random, bool is_any) {
  Eigen::Matrix3d matrix = Eigen::Quaterniond{random.between(-1, 1), random.between(-1, 1),
                                              random.between(-1, 1), random.between(-1, 1)}
                               .normalized()
                               .toRotationMatrix();
  for (int i = 0; i < 9; ++i)
    if (is_any)
      matrix(i / 3, i % 3) =
          random.chance(0.3) ? 0 : std::ldexp(random.between(-1, 1), static_cast<int>(random.below(60)) - 30);
    else
      matrix(i / 3, i % 3) += random.between(-3e-4, 3e-4);
  const double far = std::ldexp(1.0, static_cast<int>(random.below(50)) - 10);
  Rows rows;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      rows[static_cast<std::size_t>(row * 4 + column)] = matrix(row, column);
    rows[static_cast<std::size_t>(row * 4 + 3)] = far * random.between(-1, 1);
  }
  return rows;
}

}  // namespace

TEST_CASE("the box from a pose holds all used vertices, wherever and however stretched") {
  oracle::Random random(3);
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const auto mesh = mesh_of(seed % 2 == 0 ? scene.a : scene.b);
    for (const bool is_any : {false, true})
      for (int i = 0; i < 20; ++i) {
        const Rows rows = random_rows(random, is_any);
        const Box box = indexed(*mesh).rest_reach().box_at(rows);
        const Box truth = box_of(*mesh, rows);
        REQUIRE((box.min.array() <= truth.min.array()).all());
        REQUIRE((box.max.array() >= truth.max.array()).all());
        const Rows then = random_rows(random, is_any);
        double moved = 0;
        for (const std::uint32_t vertex : indexed(*mesh).regions().vertices())
          moved = std::max(moved,
                           (placed(rows, mesh->rest()[vertex]) - placed(then, mesh->rest()[vertex])).norm());
        REQUIRE(indexed(*mesh).rest_reach().motion_between(then, rows) >= moved);
      }
  }
}

TEST_CASE("the box from a pose of a sphere is a hundredth and a half too large at most") {
  const models::MeshData data = models::sphere(60, 40);
  const Mesh mesh =
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts));
  oracle::Random random(4);
  for (int i = 0; i < 300; ++i) {
    Rows rows = random_rows(random, false);
    for (const std::size_t axis : {0U, 1U, 2U}) rows[4 * axis + 3] = 0;
    const Box box = indexed(mesh).rest_reach().box_at(rows);
    const Box truth = box_of(mesh, rows);
    CHECK((truth.min - box.min).maxCoeff() < 0.02);
    CHECK((box.max - truth.max).maxCoeff() < 0.02);
  }
}

}  // namespace graze::tests
