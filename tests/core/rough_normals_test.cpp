// Beside the same sums in long double, with every instruction set. The sides of whole contacts are in
// normals_test.cpp.

#include "rough_normals.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <graze/instruction_set.hpp>
#include <numbers>
#include <vector>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/random_scenes.hpp"
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
    Eigen::Vector3d point(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
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

struct Sum {
  Vector sum = Vector::Zero();
  Real weights = 0;
};

/// A triangle by its angle at the first corner, or that of an edge.
void add(const Shape& shape, const std::array<std::uint32_t, 3>& corner, bool is_of_edge, Sum& sum) {
  const auto point = [&](std::size_t i) -> Vector { return shape.positions[corner[i]].cast<Real>(); };
  const Vector u = point(1) - point(0);
  const Vector v = point(2) - point(0);
  const Vector across = u.cross(v);
  const Real weight = is_of_edge ? std::numbers::pi_v<Real> : std::atan2(across.norm(), u.dot(v));
  sum.sum += across / across.norm() * weight;
  sum.weights += weight;
}

/// The weighted normal of vertex 0, or of the edge from it to `other`.
Sum expected(const Shape& shape, std::uint32_t other) {
  Sum sum;
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

/// Whether a rough normal is known; if so, it is compared.
bool check(const RoughNormal& rough, const Sum& sum) {
  if (rough.weights == 0 || std::isinf(rough.weights)) return false;
  const Real allowed = sum.weights * 0x1p-28L;
  REQUIRE(std::abs(static_cast<Real>(rough.weights) - sum.weights) <= allowed);
  REQUIRE((rough.sum.cast<Real>() - sum.sum).norm() <= allowed);
  return true;
}

std::vector<RoughNormal> rough_normals(const Surface& surface, const std::vector<FeaturePiece>& pieces) {
  std::vector<RoughNormal> normals(pieces.size());
  NormalSums sums;
  for (std::size_t i = 0; i < pieces.size(); ++i) sums.add(surface, pieces[i], normals[i]);
  sums.finish();
  return normals;
}

}  // namespace

TEST_CASE("rough normals: they are within 2^-28 of their weights") {
  std::array<std::size_t, family_count> known{};
  constexpr std::size_t fans = 500;
  for (std::uint64_t family = 0; family < family_count; ++family) {
    for (std::uint64_t seed = 0; seed < fans; ++seed) {
      Random random(seed * family_count + family);
      const Shape shape = fan(static_cast<Family>(family), random);
      const Surface surface = surface_of(shape);
      std::vector<FeaturePiece> pieces{vertex_piece(0)};
      std::vector<Sum> sums{expected(shape, 0)};
      for (std::uint32_t edge = 0; edge < surface.mesh().edge_count(); ++edge)
        if (const auto ends = surface.mesh().edge(edge); ends[0] == 0) {
          pieces.push_back(edge_piece(edge));
          sums.push_back(expected(shape, ends[1]));
        }
      use_instruction_set(InstructionSet::scalar);
      const auto normals = rough_normals(surface, pieces);
      bool all_known = true;
      for (std::size_t i = 0; i < pieces.size(); ++i) all_known = check(normals[i], sums[i]) && all_known;
      known[family] += all_known ? 1 : 0;
      for (const InstructionSet set : available_instruction_sets()) {
        use_instruction_set(set);
        const auto others = rough_normals(surface, pieces);
        for (std::size_t i = 0; i < pieces.size(); ++i) {
          REQUIRE(others[i].weights == normals[i].weights);
          if (!std::isinf(normals[i].weights)) REQUIRE(others[i].sum == normals[i].sum);
        }
      }
    }
  }
  use_instruction_set(available_instruction_sets().back());
  for (const Family family : {plain, minute, huge, far}) CHECK(known[family] == fans);
  CHECK(known[needles] > fans / 2);
  CHECK(known[nearly_straight] > fans / 2);
}

TEST_CASE("rough normals: one without area or of a fold is not known") {
  const Surface flat =
      surface_of(Shape{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}});
  const auto normals = rough_normals(flat, {vertex_piece(0), vertex_piece(1), face_piece(0, Piece::first),
                                            face_piece(1, Piece::first), vertex_piece(3)});
  for (const std::size_t i : {0U, 1U, 2U}) CHECK(!certain_side(normals[i], {0, 0, 1}));
  for (const std::size_t i : {3U, 4U}) CHECK(certain_side(normals[i], {0, 0, 1}) == Side::front);
  CHECK(certain_side(normals[3], {0, 0, -1}) == Side::back);
  CHECK(!certain_side(normals[3], {1, 0, 0}));
  const Surface folded = surface_of(quad({0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}));
  CHECK(!certain_side(rough_normals(folded, {face_piece(0, Piece::fold)})[0], {0, 0, 1}));
}

}  // namespace graze::tests
