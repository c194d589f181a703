// The generated models: the paper's counts, closed and manifold, wound outward, no degenerate faces.

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "models/models.hpp"
#include "support/catch.hpp"

using Eigen::Vector3d;
using graze::models::Faces;
using graze::models::MeshData;

namespace {

using Side = std::pair<std::uint32_t, std::uint32_t>;

std::vector<std::vector<std::uint32_t>> faces_of(const MeshData& mesh) {
  std::vector<std::vector<std::uint32_t>> faces;
  auto corner = mesh.corners.begin();
  for (const std::uint32_t count : mesh.corner_counts) {
    faces.emplace_back(corner, corner + count);
    corner += count;
  }
  REQUIRE(corner == mesh.corners.end());
  return faces;
}

/// How often each side runs from one vertex to another.
std::map<Side, int> sides_of(const MeshData& mesh) {
  std::map<Side, int> sides;
  for (const auto& face : faces_of(mesh))
    for (std::size_t i = 0; i < face.size(); ++i) ++sides[{face[i], face[(i + 1) % face.size()]}];
  return sides;
}

std::size_t edge_count(const MeshData& mesh) {
  std::set<Side> edges;
  for (const auto& [side, count] : sides_of(mesh)) edges.insert(std::minmax(side.first, side.second));
  return edges.size();
}

/// Every side runs once, and once the other way. The faces around every vertex form one ring.
void check_closed_manifold(const MeshData& mesh) {
  const auto sides = sides_of(mesh);
  for (const auto& [side, count] : sides) {
    REQUIRE(count == 1);
    REQUIRE(sides.contains({side.second, side.first}));
  }

  std::vector<std::map<std::uint32_t, std::uint32_t>> next(mesh.positions.size());
  for (const auto& face : faces_of(mesh)) {
    for (std::size_t i = 0; i < face.size(); ++i)
      next[face[(i + 1) % face.size()]][face[i]] = face[(i + 2) % face.size()];
  }
  for (const auto& around : next) {
    REQUIRE(around.size() >= 3);
    std::size_t length = 0;
    std::uint32_t at = around.begin()->first;
    do {
      at = around.at(at);
      ++length;
    } while (at != around.begin()->first);
    REQUIRE(length == around.size());
  }
}

std::vector<std::array<Vector3d, 3>> triangles_of(const MeshData& mesh) {
  std::vector<std::array<Vector3d, 3>> triangles;
  for (const auto& face : faces_of(mesh)) {
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      triangles.push_back({mesh.positions[face[0]], mesh.positions[face[i]], mesh.positions[face[i + 1]]});
  }
  return triangles;
}

double volume(const MeshData& mesh) {
  double sum = 0;
  for (const auto& [p, q, r] : triangles_of(mesh)) sum += p.dot(q.cross(r)) / 6;
  return sum;
}

/// Twice the area over the longest side squared: about 1 for a fair triangle, 0 for a degenerate one.
double worst_shape(const MeshData& mesh) {
  double worst = 1;
  for (const auto& [p, q, r] : triangles_of(mesh)) {
    const double longest = std::max({(q - p).squaredNorm(), (r - q).squaredNorm(), (p - r).squaredNorm()});
    worst = std::min(worst, (q - p).cross(r - p).norm() / longest);
  }
  return worst;
}

/// No two faces that share an edge are folded onto each other.
double sharpest_fold(const MeshData& mesh) {
  std::map<Side, Vector3d> normals;
  for (const auto& face : faces_of(mesh)) {
    const Vector3d& origin = mesh.positions[face[0]];
    const Vector3d normal =
        (mesh.positions[face[1]] - origin).cross(mesh.positions[face[2]] - origin).normalized();
    for (std::size_t i = 0; i < face.size(); ++i) normals[{face[i], face[(i + 1) % face.size()]}] = normal;
  }
  double sharpest = 1;
  for (const auto& [side, normal] : normals)
    sharpest = std::min(sharpest, normal.dot(normals.at({side.second, side.first})));
  return sharpest;
}

Eigen::AlignedBox3d box_of(const MeshData& mesh) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& position : mesh.positions) box.extend(position);
  return box;
}

struct Expected {
  std::size_t vertices, faces, edges;
  int euler;
};

void check(const MeshData& mesh, const Expected& expected) {
  CHECK(mesh.positions.size() == expected.vertices);
  CHECK(mesh.corner_counts.size() == expected.faces);
  CHECK(edge_count(mesh) == expected.edges);
  CHECK(static_cast<int>(expected.vertices + expected.faces) - static_cast<int>(expected.edges) ==
        expected.euler);
  check_closed_manifold(mesh);
  CHECK(volume(mesh) > 0);
  CHECK(worst_shape(mesh) > 0.05);
  CHECK(sharpest_fold(mesh) > -0.95);
}

void check_fits(const MeshData& mesh) {
  const Eigen::AlignedBox3d box = box_of(mesh);
  CHECK(box.center().norm() < 0.1);
  CHECK(box.max().cwiseMax(-box.min()).maxCoeff() < 1.01);
  CHECK(box.max().cwiseMax(-box.min()).maxCoeff() > 0.79);
}

/// In how many pieces a horizontal plane cuts a triangle mesh.
int pieces_at(const MeshData& mesh, double z) {
  std::map<Side, Side> parent;  // cut edges, joined across each cut triangle
  const auto root = [&](Side side) {
    while (parent.at(side) != side) side = parent.at(side);
    return side;
  };
  for (const auto& face : faces_of(mesh)) {
    std::vector<Side> cut;
    for (std::size_t i = 0; i < 3; ++i) {
      const Side side = std::minmax(face[i], face[(i + 1) % 3]);
      if ((mesh.positions[side.first].z() < z) != (mesh.positions[side.second].z() < z)) cut.push_back(side);
    }
    for (const Side& side : cut) parent.try_emplace(side, side);
    if (cut.size() == 2) parent[root(cut[0])] = root(cut[1]);
  }
  return static_cast<int>(std::count_if(parent.begin(), parent.end(),
                                        [](const auto& entry) { return entry.first == entry.second; }));
}

}  // namespace

TEST_CASE("models: the paper's models have its counts and are closed, manifold and wound outward") {
  using namespace graze::models;
  check(torus(), {768, 1536, 2304, 0});
  check(pawn(), {610, 1216, 1824, 2});
  check(human(), {946, 1888, 2832, 2});
  check(cylinder(), {258, 512, 768, 2});
  check(tooth(), {1202, 2400, 3600, 2});
  for (const MeshData& mesh : {torus(), pawn(), human(), cylinder(), tooth()}) check_fits(mesh);
}

TEST_CASE("models: as quads they have the same vertices and enclose about the same volume") {
  using namespace graze::models;
  check(torus(Faces::quads), {768, 768, 1536, 0});
  check(pawn(Faces::quads), {610, 640, 1248, 2});
  check(cylinder(Faces::quads), {258, 288, 544, 2});
  CHECK(torus(Faces::quads).positions == torus().positions);
  CHECK(volume(torus(Faces::quads)) ==
        Approx(2 * std::numbers::pi * std::numbers::pi * 0.7 * 0.09).epsilon(0.05));
  CHECK(volume(cylinder(Faces::quads)) == Approx(std::numbers::pi * 0.36 * 1.6).epsilon(0.01));
}

TEST_CASE("models: a human has a head, two arms and two legs, a tooth four cusps and two roots") {
  const MeshData human = graze::models::human();
  CHECK(pieces_at(human, 0.87) == 1);   // the head
  CHECK(pieces_at(human, 0.20) == 3);   // two arms and the trunk
  CHECK(pieces_at(human, -0.50) == 2);  // two legs
  const MeshData tooth = graze::models::tooth();
  CHECK(pieces_at(tooth, 0.82) == 4);
  CHECK(pieces_at(tooth, 0.20) == 1);
  CHECK(pieces_at(tooth, -0.75) == 2);
}

TEST_CASE("models: simple shapes") {
  using namespace graze::models;
  check(sphere(12, 5), {62, 120, 180, 2});
  check(sphere(12, 5, Faces::quads), {62, 72, 132, 2});
  for (const Vector3d& position : sphere(12, 5).positions) CHECK(position.norm() == Approx(1));
  check(torus(3, 3, 2.0, 0.5), {9, 18, 27, 0});
  check(box({1, 2, 3}), {8, 6, 12, 2});
  check(box({1, 2, 3}, Faces::triangles), {8, 12, 18, 2});
  CHECK(volume(box({1, 2, 3})) == Approx(6));
  const MeshData cloth = sheet(3, 2, 6, 4);
  CHECK(cloth.positions.size() == 12);
  CHECK(cloth.corner_counts.size() == 6);
  CHECK(edge_count(cloth) == 17);
  CHECK(sheet(3, 2, 6, 4, Faces::triangles).corner_counts.size() == 12);
  CHECK(box_of(cloth).min() == Vector3d(-3, -2, 0));
  CHECK(box_of(cloth).max() == Vector3d(3, 2, 0));
  for (const auto& [p, q, r] : triangles_of(cloth)) CHECK((q - p).cross(r - p).z() > 0);
}
