// The pairs that task B's work is counted by, against all pairs in exact arithmetic.

#include "bench/near_pairs.hpp"

#include <algorithm>
#include <vector>

#include "support/catch.hpp"
#include "support/exact/exact_distance.hpp"
#include "support/mesh_of.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// A square of triangles with a bump, each vertex somewhere beside its place, as floats.
oracle::Shape bumpy_square(oracle::Random& random, double height) {
  constexpr std::uint32_t side = 5;
  oracle::Shape shape;
  const auto beside = [&](double place) {
    return double{static_cast<float>(place + random.between(0, 0.3))};
  };
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      shape.positions.emplace_back(beside(x), beside(y), height + beside(x == y ? 0.4 : 0));
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t corner = y * side + x;
      shape.faces.push_back({corner, corner + 1, corner + side});
      shape.faces.push_back({corner + 1, corner + side + 1, corner + side});
    }
  return shape;
}

std::vector<float> floats_of(const oracle::Shape& shape) {
  std::vector<float> floats;
  for (const Eigen::Vector3d& position : shape.positions)
    for (const double coordinate : position) floats.push_back(static_cast<float>(coordinate));
  return floats;
}

std::size_t vertices_near_faces(const oracle::ExactShape& of, const oracle::ExactShape& other,
                                const mpq_class& limit) {
  std::size_t count = 0;
  for (const std::uint32_t vertex : of.used)
    for (std::uint32_t face = 0; face < other.faces.size(); ++face)
      if (oracle::foot_on_face(of.points[vertex], other, face).distance_squared < limit) ++count;
  return count;
}

std::size_t edges_near_edges(const oracle::ExactShape& a, const oracle::ExactShape& b,
                             const mpq_class& limit) {
  std::size_t count = 0;
  for (const oracle::Segment& of_a : a.edges())
    for (const oracle::Segment& of_b : b.edges()) {
      const auto inner = oracle::inner_contact(a, of_a, b, of_b);
      const oracle::Foot least = inner ? inner->a : oracle::end_contacts(a, of_a, b, of_b).front().a;
      if (least.distance_squared < limit) ++count;
    }
  return count;
}

}  // namespace

TEST_CASE("pairs of features below a threshold are counted, each once") {
  std::size_t most = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    oracle::Random random(seed);
    const oracle::Shape shape_a = bumpy_square(random, 0);
    const oracle::Shape shape_b = bumpy_square(random, random.between(-0.5, 1));
    const auto mesh_a = mesh_of(shape_a);
    const auto mesh_b = mesh_of(shape_b);
    const std::vector<float> positions_a = floats_of(shape_a);
    const std::vector<float> positions_b = floats_of(shape_b);
    std::vector<bench::TrianglePair> all;
    for (std::uint32_t a = 0; a < mesh_a->face_count(); ++a)
      for (std::uint32_t b = 0; b < mesh_b->face_count(); ++b) all.push_back({0, 1, a, b, 0});

    const double distance = random.between(0.05, 0.6);
    const mpq_class limit = mpq_class(distance) * mpq_class(distance);
    const oracle::ExactShape exact_a(shape_a);
    const oracle::ExactShape exact_b(shape_b);
    const std::size_t count =
        bench::count_near_pairs({*mesh_a, positions_a.data()}, {*mesh_b, positions_b.data()}, all, distance);
    CHECK(count == vertices_near_faces(exact_a, exact_b, limit) +
                       vertices_near_faces(exact_b, exact_a, limit) +
                       edges_near_edges(exact_a, exact_b, limit));
    most = std::max(most, count);
  }
  CHECK(most > 100);
}

}  // namespace graze::tests
