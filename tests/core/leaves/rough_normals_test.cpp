// Beside the same sums in long double, with every instruction set. The sides of whole contacts are in
// normals_test.cpp.

#include "measure/rough_normals.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <numbers>
#include <vector>

#include "core/comparison.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "core/shapes.hpp"
#include "core/surface/surface.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"
#include "support/real.hpp"

namespace graze::tests {
namespace {

using oracle::Random;
using oracle::Shape;

enum Family : std::uint64_t { plain, needles, nearly_straight, minute, huge, far, family_count };

/// Triangles and quads about vertex 0.
Shape fan(Family family, Random& random) {
  Shape shape;
  const auto add_point = [&] {
    Eigen::Vector3d point = random.vector(-1, 1);
    if (family == needles) point = point.cwiseProduct(Eigen::Vector3d(1, 0x1p-10, 0x1p-16));
    // A half turn seen from vertex 0, to a millionth.
    if (family == nearly_straight)
      point = Eigen::Vector3d(shape.positions.size() % 2 == 0 ? 1 : -1, 0, 0) + point * 0x1p-18;
    if (family == minute) point *= 0x1p-90;
    if (family == huge) point *= 0x1p90;
    if (family == far) point += Eigen::Vector3d(0x1p20, -0x1p30, 0x1p10);
    shape.positions.push_back(point);
    return static_cast<std::uint32_t>(shape.positions.size() - 1);
  };
  add_point();
  std::uint32_t last = add_point();
  for (std::uint64_t faces = 1 + random.below(7); faces-- > 0;) {
    std::vector<std::uint32_t> face{0, last, add_point()};
    if (random.below(3) == 0) face.push_back(add_point());
    last = face.back();
    shape.faces.push_back(face);
  }
  return shape;
}

/// A triangle by its angle at the first corner, or that of an edge.
void add(const Shape& shape, const std::array<std::uint32_t, 3>& corner, bool is_of_edge, Vector& sum) {
  const auto point = [&](std::size_t i) -> Vector { return shape.positions[corner[i]].cast<Real>(); };
  const Vector u = point(1) - point(0);
  const Vector v = point(2) - point(0);
  const Vector across = u.cross(v);
  const Real weight = is_of_edge ? 1 : std::atan2(across.norm(), u.dot(v));
  sum += across / across.norm() * weight;
}

/// The normals of the triangles at vertex 0 by their angles, or of those at the edge from it to `other`.
Vector expected(const Shape& shape, std::uint32_t other) {
  Vector sum = Vector::Zero();
  for (const auto& face : shape.faces)
    for (std::size_t last = 2; last < face.size(); ++last) {
      const std::array<std::uint32_t, 3> corner{face[0], face[last - 1], face[last]};
      // A quad's fold is no edge of it.
      const bool is_inner = face.size() == 4 && corner[last == 2 ? 2 : 1] == other;
      if (other == 0)
        add(shape, corner, false, sum);
      else if (!is_inner && (corner[1] == other || corner[2] == other))
        add(shape, corner, true, sum);
    }
  return sum;
}

Eigen::Vector3d sum_of(const RoughNormal& rough) {
  return Eigen::Map<const Eigen::Vector3d>(rough.sum);
}

/// Whether a rough normal is known. If so, it is compared.
bool check(const RoughNormal& rough, const Vector& sum) {
  if (std::isinf(rough.error)) return false;
  REQUIRE((sum_of(rough).cast<Real>() - sum).norm() <= rough.error);
  return true;
}

/// The feature pieces that are asked about, and the expected sum of normals for each.
struct Asked {
  std::vector<FeaturePiece> pieces;
  std::vector<Vector> sums;
};

/// Vertex 0, and then the edges from it.
Asked about_vertex(const Shape& shape, const IndexedMesh& mesh) {
  Asked asked{{vertex_piece(0)}, {expected(shape, 0)}};
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge)
    if (const auto ends = mesh.edge(edge); ends[0] == 0) {
      asked.pieces.push_back(edge_piece(edge));
      asked.sums.push_back(expected(shape, ends[1]));
    }
  return asked;
}

std::vector<RoughNormal> rough_normals(const Surface& surface, const std::vector<FeaturePiece>& pieces) {
  std::vector<RoughNormal> normals(pieces.size());
  NormalSums sums;
  for (std::size_t i = 0; i < pieces.size(); ++i) sums.add(surface, pieces[i], normals[i]);
  sums.finish();
  return normals;
}

}  // namespace

TEST_CASE("rough normals: they are no further off than they say") {
  struct Known {
    std::size_t vertices = 0, edges = 0, all_edges = 0;
  };
  std::array<Known, family_count> known{};
  constexpr std::size_t fans = 500;
  for (std::uint64_t family = 0; family < family_count; ++family) {
    for (std::uint64_t seed = 0; seed < fans; ++seed) {
      Random random(seed * family_count + family);
      const Shape shape = fan(static_cast<Family>(family), random);
      const Surface surface = surface_of(shape);
      const Asked asked = about_vertex(shape, surface.mesh());
      use_instruction_set(InstructionSet::scalar);
      const auto normals = rough_normals(surface, asked.pieces);
      known[family].vertices += check(normals[0], asked.sums[0]) ? 1U : 0U;
      for (std::size_t i = 1; i < normals.size(); ++i)
        known[family].edges += check(normals[i], asked.sums[i]) ? 1U : 0U;
      known[family].all_edges += normals.size() - 1;
      for (const InstructionSet set : available_instruction_sets()) {
        use_instruction_set(set);
        const auto others = rough_normals(surface, asked.pieces);
        for (std::size_t i = 0; i < normals.size(); ++i) {
          REQUIRE(others[i].error == normals[i].error);
          if (!std::isinf(normals[i].error)) REQUIRE(sum_of(others[i]) == sum_of(normals[i]));
        }
      }
    }
  }
  use_instruction_set(available_instruction_sets().back());
  for (const Family family : {plain, minute, huge, far})
    CHECK(known[family].edges == known[family].all_edges);
  for (const Family family : {needles, nearly_straight}) {
    CHECK(known[family].vertices > fans / 10);
    CHECK(known[family].edges > known[family].all_edges / 2);
  }
  // About a vertex in float, of which the square of such a length is none.
  for (const Family family : {minute, huge}) CHECK(known[family].vertices == 0);
  for (const Family family : {plain, far}) CHECK(known[family].vertices > fans * 9 / 10);
}

TEST_CASE("rough normals: of vertices with many triangles") {
  const auto normal_with = [](std::uint32_t spokes, Vector& sum) {
    Random random(spokes);
    Shape shape{{{0, 0, 1}}, {}};
    for (std::uint32_t i = 0; i < spokes; ++i) {
      const double angle = 2 * std::numbers::pi * i / spokes;
      shape.positions.emplace_back(std::cos(angle), std::sin(angle), random.between(-0.5, 0.5));
      shape.faces.push_back({0, 1 + i, 1 + (i + 1) % spokes});
    }
    sum = expected(shape, 0);
    return rough_normals(surface_of(shape), {vertex_piece(0)})[0];
  };
  Vector sum;
  for (const std::uint32_t spokes : {3U, 15U, 16U, 17U, 31U, 32U, 100U}) {
    const RoughNormal normal = normal_with(spokes, sum);
    CHECK(check(normal, sum));
    CHECK(certain_side(normal, {0, 0, 1}) == Side::front);
  }
  CHECK(check(normal_with(4095, sum), sum));
  CHECK(std::isinf(normal_with(4096, sum).error));
}

TEST_CASE("rough normals: several at once as alone, the last vertex among them, in float as in double") {
  Random random(1);
  Shape shape{{}, {}};
  std::vector<Eigen::Vector3f> floats;
  for (std::uint32_t i = 0; i < 9; ++i) {
    const Eigen::Vector3d point = random.vector(-1, 1);
    floats.push_back(point.cast<float>());
    shape.positions.push_back(floats.back().cast<double>());
  }
  for (std::uint32_t i = 0; i < 8; ++i) shape.faces.push_back({8, i, (i + 1) % 8});
  const Surface in_double = surface_of(shape);
  Surface in_float = surface_of(shape);
  in_float.set_positions(PositionView(floats));
  std::vector<FeaturePiece> pieces;
  for (std::uint32_t i = 0; i < 9; ++i) pieces.push_back(vertex_piece(8 - i));
  for (const InstructionSet set : available_instruction_sets()) {
    use_instruction_set(set);
    const auto together = rough_normals(in_float, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (const Surface* const surface : std::array<const Surface*, 2>{&in_float, &in_double}) {
        const RoughNormal alone = rough_normals(*surface, {pieces[i]})[0];
        CHECK(sum_of(together[i]) == sum_of(alone));
        CHECK(together[i].error == alone.error);
      }
  }
  use_instruction_set(available_instruction_sets().back());
}

TEST_CASE("rough normals: an edge that is none in float alone makes the vertex unknown") {
  const auto normal_with = [](double x) {
    const Surface surface =
        surface_of(Shape{{{0, 0, 0}, {1, 0, 0}, {x, x, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
    return rough_normals(surface, {vertex_piece(0)})[0];
  };
  CHECK(certain_side(normal_with(1), {0, 0, 1}) == Side::front);
  CHECK(!certain_side(normal_with(0x1p-200), {0, 0, 1}));
  CHECK(std::isinf(normal_with(0x1p-200).error));
  CHECK(!std::isinf(normal_with(0).error));
}

TEST_CASE("rough normals: one without area or of a fold is not known") {
  const Surface flat =
      surface_of(Shape{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const auto normals = rough_normals(flat, {vertex_piece(0), vertex_piece(1), face_piece(0, Piece::first),
                                            face_piece(1, Piece::first), vertex_piece(3)});
  for (const std::size_t i : {1U, 2U}) CHECK(!certain_side(normals[i], {0, 0, 1}));
  for (const std::size_t i : {0U, 3U, 4U}) CHECK(certain_side(normals[i], {0, 0, 1}) == Side::front);
  CHECK(certain_side(normals[3], {0, 0, -1}) == Side::back);
  CHECK(!certain_side(normals[3], {1, 0, 0}));
  const Surface folded = surface_of(quad({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}));
  CHECK(!certain_side(rough_normals(folded, {face_piece(0, Piece::fold)})[0], {0, 0, 1}));
}

}  // namespace graze::tests
