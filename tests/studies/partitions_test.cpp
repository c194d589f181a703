// Partitions and their bounds as `graze_studies experiment subdivision` compares them: no bound is above the
// true distance, by exact arithmetic; no near pair is lost on the way down.

#include "experiment/regions/partitions/partitions.hpp"

#include <gmpxx.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <graze/mesh.hpp>
#include <limits>
#include <set>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"
#include "experiment/regions/bound_walk.hpp"
#include "experiment/regions/near_vertices.hpp"
#include "models/models.hpp"
#include "scenes/random.hpp"
#include "support/catch.hpp"

using namespace graze::tools;  // NOLINT: the vocabulary of these tests
using graze::Mesh;
using graze::scenes::Random;
using Vector = Eigen::Vector3d;
using Cloud = std::vector<Vector>;

namespace {

mpq_class exact_squared_distance(const Vector& a, const Vector& b) {
  mpq_class sum = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const mpq_class gap = mpq_class(b[axis]) - mpq_class(a[axis]);
    sum += gap * gap;
  }
  return sum;
}

/// The exact square of the least distance; in double first, to leave out what is certainly not the least.
mpq_class exact_squared_distance(const Cloud& a, const Cloud& b) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector& p : a)
    for (const Vector& q : b) least = std::min(least, (q - p).stableNorm());
  mpq_class exact = -1;
  for (const Vector& p : a)
    for (const Vector& q : b) {
      if ((q - p).stableNorm() > least * (1 + 1e-12) + 1e-300) continue;
      const mpq_class squared = exact_squared_distance(p, q);
      if (exact < 0 || squared < exact) exact = squared;
    }
  return exact;
}

enum class Shape { random, one_point, line, plane, axis_plane, grid, needle, last };

Cloud cloud_of(Shape shape, Random& random) {
  Cloud cloud;
  const Eigen::Matrix3d turn = random.turn();
  const std::size_t count = shape == Shape::one_point ? 1 + random.below(3) : 2 + random.below(29);
  for (std::size_t i = 0; i < count; ++i) {
    Vector point = random.vector(-1, 1);
    if (shape == Shape::one_point) point = Vector(0.1, 0.2, 0.3);
    if (shape == Shape::line) point.y() = point.z() = 0;
    if (shape == Shape::plane || shape == Shape::axis_plane) point.z() = 0;
    if (shape == Shape::grid) point = (2 * point).array().round().matrix();
    if (shape == Shape::needle) point = point.cwiseProduct(Vector(1, 1e-7, 1e-9));
    const bool stays = shape == Shape::axis_plane || shape == Shape::grid;
    cloud.push_back(stays ? point : turn * point);
  }
  return cloud;
}

/// Two clouds of one size that are near each other beside it, anywhere from the origin to far from it.
struct CloudPair {
  Cloud a, b;
};

CloudPair clouds_of(std::uint64_t seed) {
  Random random(seed);
  const auto shape = [&] { return static_cast<Shape>(random.below(static_cast<std::size_t>(Shape::last))); };
  CloudPair pair{cloud_of(shape(), random), cloud_of(shape(), random)};
  const Vector direction = random.vector(-1, 1).normalized();
  const Vector apart = direction * random.between(0, 4);
  const double scale = std::ldexp(1.0, static_cast<int>(random.below(5)) * 40 - 80);
  const Vector far =
      random.chance(0.5) ? Vector::Zero().eval() : (random.vector(-1, 1) * scale * 0x1p30).eval();
  const bool in_float = random.chance(0.3);
  for (Cloud* cloud : {&pair.a, &pair.b})
    for (Vector& point : *cloud) {
      point = scale * (cloud == &pair.a ? point : point + apart) + far;
      if (in_float) point = point.cast<float>().cast<double>();
    }
  return pair;
}

template <typename Volume>
Volume around(const Cloud& cloud) {
  return Volume::around({cloud, cloud[cloud.size() / 2]});
}

template <typename Volume>
void check_is_lower(const Volume& a, const Volume& b, const CloudPair& clouds) {
  INFO(Volume::name);
  const double lower = lower_distance(a, b);
  REQUIRE(lower >= 0);
  REQUIRE(std::isfinite(lower));
  const mpq_class exact = lower;
  const bool is_lower = exact * exact <= exact_squared_distance(clouds.a, clouds.b);
  CHECK(is_lower);
  CHECK(lower_distance(b, a) >= 0);
  if constexpr (Volume::merges) {
    const auto half = static_cast<std::ptrdiff_t>((clouds.a.size() + 1) / 2);
    const Cloud first(clouds.a.begin(), clouds.a.begin() + half);
    const Cloud second(clouds.a.begin() + half, clouds.a.end());
    Volume merged = around<Volume>(first);
    if (!second.empty()) merged.add(around<Volume>(second));
    const mpq_class merged_lower = lower_distance(merged, b);
    const bool merged_is_lower = merged_lower * merged_lower <= exact_squared_distance(clouds.a, clouds.b);
    CHECK(merged_is_lower);
  }
}

/// Calls `check` with a volume of each kind.
template <typename Check>
void with_all_volumes(const Check& check) {
  check(MiddleSphere{});
  check(AxisBox{});
}

Mesh mesh_of(const graze::models::MeshData& data) {
  return Mesh::from_polygons(data.positions, data.corners,
                             std::span<const std::uint32_t>(data.corner_counts));
}

/// Bent and twisted.
Cloud deformed(const Mesh& mesh, double amount, const Vector& offset) {
  Cloud result;
  for (Vector point : mesh.rest()) {
    point = Eigen::AngleAxisd(amount * point.z(), Vector::UnitZ()) * point;
    point.x() += amount * point.z() * point.z();
    result.push_back(point + offset);
  }
  return result;
}

Cloud in_order(const RegionHierarchy& hierarchy, const Cloud& positions) {
  Cloud points;
  for (const std::uint32_t vertex : hierarchy.vertices()) points.push_back(positions[vertex]);
  return points;
}

using LeafPairs = std::set<std::pair<std::uint32_t, std::uint32_t>>;

template <typename Volume>
LeafPairs reached(const RegionHierarchy& a, const Cloud& positions_a, const RegionHierarchy& b,
                  const Cloud& positions_b, double distance) {
  const Cloud points_a = in_order(a, positions_a);
  const Cloud points_b = in_order(b, positions_b);
  std::vector<Volume> volumes_a, volumes_b;
  refit(PlacedRegions{a, points_a, positions_a}, volumes_a);
  refit(PlacedRegions{b, points_b, positions_b}, volumes_b);
  LeafPairs leaves;
  WalkCounts counts;
  walk(BoundedPair<Volume>{a.nodes(), b.nodes(), volumes_a, volumes_b}, distance, counts,
       [&](const NodePair& pair) { leaves.emplace(pair.a, pair.b); });
  CHECK(counts.reached == leaves.size());
  return leaves;
}

}  // namespace

TEST_CASE("Region bounds: never above the true distance") {
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    INFO("seed " << seed);
    const CloudPair clouds = clouds_of(seed);
    with_all_volumes([&](auto volume) {
      using Volume = decltype(volume);
      check_is_lower(around<Volume>(clouds.a), around<Volume>(clouds.b), clouds);
    });
  }
}

TEST_CASE("Region bounds: at the largest and the smallest coordinates") {
  for (const double scale : {0x1p120, 0x1p-400, 0x1p-530, 0x1p-1060}) {
    INFO(scale);
    Random random(9);
    CloudPair clouds;
    for (int i = 0; i < 12; ++i) {
      clouds.a.push_back(scale * random.vector(-1, 0));
      clouds.b.push_back(scale * random.vector(-0.5, 1));
    }
    with_all_volumes([&](auto volume) {
      using Volume = decltype(volume);
      check_is_lower(around<Volume>(clouds.a), around<Volume>(clouds.b), clouds);
    });
  }
}

TEST_CASE("Partitions: every used vertex once, in leaves that are small enough") {
  for (const graze::models::MeshData& data : {graze::models::tooth(), graze::models::torus(40, 30, 1, 0.3)}) {
    const Mesh mesh = mesh_of(data);
    for (const Partition partition : all_partitions)
      for (const std::uint32_t capacity : {30U, 15U}) {
        if (partition == Partition::octree && capacity != 30) continue;
        INFO(name_of(partition) << " of " << capacity);
        const RegionHierarchy hierarchy(mesh, divide(mesh, partition, capacity));
        std::vector<std::uint32_t> vertices(hierarchy.vertices().begin(), hierarchy.vertices().end());
        std::sort(vertices.begin(), vertices.end());
        std::vector<std::uint32_t> all(mesh.vertex_count());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        CHECK(vertices == all);
        for (const RegionNode& node : hierarchy.nodes()) {
          REQUIRE(node.child_count <= 8);
          REQUIRE(node.vertex_count > 0);
          if (node.is_leaf()) REQUIRE(node.vertex_count <= capacity);
          const auto members = RegionHierarchy::part(hierarchy.vertices(), node);
          REQUIRE(std::find(members.begin(), members.end(), node.middle) != members.end());
          std::uint32_t in_children = 0;
          for (std::uint32_t i = 0; i < node.child_count; ++i) {
            const RegionNode& child = hierarchy.nodes()[node.first_child + i];
            REQUIRE(child.level == node.level + 1);
            in_children += child.vertex_count;
          }
          if (!node.is_leaf()) REQUIRE(in_children == node.vertex_count);
        }
      }
  }
}

TEST_CASE("Partitions: the octree is the library's own") {
  const Mesh mesh = mesh_of(graze::models::pawn());
  const RegionHierarchy hierarchy(mesh, divide(mesh, Partition::octree));
  const auto& tree = indexed(mesh).regions();
  REQUIRE(hierarchy.nodes().size() == tree.region_count());
  CHECK(std::equal(tree.vertices().begin(), tree.vertices().end(), hierarchy.vertices().begin(),
                   hierarchy.vertices().end()));
  for (std::uint32_t i = 0; i < tree.region_count(); ++i) {
    const graze::Region& region = tree.region(i);
    const RegionNode& node = hierarchy.nodes()[i];
    REQUIRE(node.level == region.level);
    REQUIRE(node.first_vertex == region.first_vertex);
    REQUIRE(node.vertex_count == region.vertex_count);
    REQUIRE(node.child_count == region.child_count);
    if (!region.is_leaf()) REQUIRE(node.first_child == region.first_child);
  }
}

TEST_CASE("Partitions: surface halves keep apart what only space joins") {
  // Two sheets on each other, 0.001 apart, that no edge joins.
  graze::models::MeshData data = graze::models::sheet(9, 9, 1, 1);
  const auto count = static_cast<std::uint32_t>(data.positions.size());
  const auto corners = data.corners;
  const auto counts = data.corner_counts;
  for (std::uint32_t i = 0; i < count; ++i)
    data.positions.emplace_back(data.positions[i] + Vector(0, 0, 0.001));
  for (const std::uint32_t corner : corners) data.corners.push_back(corner + count);
  data.corner_counts.insert(data.corner_counts.end(), counts.begin(), counts.end());
  const Mesh mesh = mesh_of(data);
  const auto mixed_leaves = [&](Partition partition) {
    std::size_t mixed = 0;
    for (const auto& cluster : divide(mesh, partition).clusters) {
      const auto upper = std::count_if(cluster.vertices.begin(), cluster.vertices.end(),
                                       [&](std::uint32_t vertex) { return vertex >= count; });
      if (upper > 0 && upper < static_cast<std::ptrdiff_t>(cluster.vertices.size())) ++mixed;
    }
    return mixed;
  };
  CHECK(mixed_leaves(Partition::surface_halves) == 0);
  CHECK(mixed_leaves(Partition::edge_collapse) == 0);
  CHECK(mixed_leaves(Partition::median) > 0);
}

TEST_CASE("Near vertices: as every pair tells, with vertices that no face uses") {
  Random random(4);
  for (int round = 0; round < 20; ++round) {
    graze::models::MeshData data = graze::models::sphere(12, 8);
    data.positions.emplace_back(Vector::Zero());  // unused
    const Mesh mesh = mesh_of(data);
    const Cloud a = deformed(mesh, random.between(-1, 1), Vector::Zero());
    const Vector away = random.vector(-1.5, 1.5);
    const Cloud b = deformed(mesh, random.between(-1, 1), away);
    const double distance = random.between(0.02, 0.5);
    LeafPairs expected, found;
    for (std::uint32_t i = 0; i + 1 < a.size(); ++i)
      for (std::uint32_t j = 0; j + 1 < b.size(); ++j)
        if ((b[j] - a[i]).norm() < distance) expected.emplace(i, j);
    const auto pairs = near_vertices({mesh, a}, {mesh, b}, distance);
    for (const NearVertexPair& pair : pairs) found.emplace(pair.a, pair.b);
    CHECK(found.size() == pairs.size());
    CHECK(found == expected);
  }
}

TEST_CASE("Region bounds: no near vertex is lost on the way down") {
  const Mesh pawn = mesh_of(graze::models::pawn());
  const Mesh ring = mesh_of(graze::models::torus());
  const double distance = 0.06;
  const Cloud a = deformed(pawn, 0.6, Vector::Zero());
  const Cloud b = deformed(ring, -0.5, {0.75, 0.1, 0});
  for (const Partition partition : all_partitions) {
    const RegionHierarchy tree_a(pawn, divide(pawn, partition));
    const RegionHierarchy tree_b(ring, divide(ring, partition));
    LeafPairs near;
    for (const NearVertexPair& pair : near_vertices({pawn, a}, {ring, b}, distance))
      near.emplace(tree_a.leaf_of_vertex()[pair.a], tree_b.leaf_of_vertex()[pair.b]);
    REQUIRE(near.size() > 5);
    with_all_volumes([&](auto volume) {
      using Volume = decltype(volume);
      INFO(name_of(partition) << ", " << Volume::name);
      const LeafPairs leaves = reached<Volume>(tree_a, a, tree_b, b, distance);
      CHECK(std::includes(leaves.begin(), leaves.end(), near.begin(), near.end()));
      CHECK(leaves.size() < tree_a.leaf_count() * tree_b.leaf_count() / 2);
    });
  }
}
