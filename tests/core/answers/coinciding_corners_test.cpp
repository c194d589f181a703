// Surfaces of several leaves of which most corners coincide: the closest points, which are settled by these
// corners, are those of brute force.

#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/floating_point_scope.hpp"
#include "core/comparison.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

constexpr std::uint32_t side = 10;  // corners along a sheet, which has some ten leaves

/// What a pair of sheets has beside corners that coincide.
struct Kind {
  const char* name;
  double step_of_heights;  ///< heights are multiples of it, and generic for 0
  bool has_quads;
  double moved;      ///< of the second sheet's corners, so many are elsewhere
  double collapsed;  ///< so many corners of either sheet lie on a neighbour
};
constexpr Kind kinds[] = {{"bent", 0, false, 0, 0},
                          {"bent, some apart", 0, false, 0.3, 0},
                          {"flat in parts", 0.5, false, 0, 0},
                          {"flat in parts, some apart", 0.5, false, 0.2, 0},
                          {"collapsed", 0.5, false, 0.1, 0.1},
                          {"bent and collapsed", 0, false, 0.1, 0.1},
                          {"quads", 0, true, 0.1, 0},
                          {"flat quads", 0.5, true, 0.1, 0.05}};

Shape sheet(const Kind& kind, Random& random) {
  Shape shape;
  for (std::uint32_t i = 0; i < side * side; ++i) {
    const double height =
        kind.step_of_heights > 0 ? kind.step_of_heights * random.below(2) : random.between(0, 0.5);
    shape.positions.emplace_back(i % side, i / side, height);  // NOLINT(bugprone-integer-division)
  }
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t first = y * side + x;
      if (kind.has_quads && random.chance(0.5)) {
        shape.faces.push_back({first, first + 1, first + side + 1, first + side});
        continue;
      }
      shape.faces.push_back({first, first + 1, first + side + 1});
      shape.faces.push_back({first, first + side + 1, first + side});
    }
  return shape;
}

void collapse(Shape& shape, double part, Random& random) {
  for (std::uint32_t i = 1; i < shape.positions.size(); ++i)
    if (random.chance(part)) shape.positions[i] = shape.positions[i - 1];
}

/// The same surface with its corners in another order.
Shape renumbered(const Shape& shape, Random& random) {
  std::vector<std::uint32_t> number(shape.positions.size());
  std::iota(number.begin(), number.end(), 0U);
  for (std::size_t i = number.size(); i > 1; --i)
    std::swap(number[i - 1], number[random.below(static_cast<std::uint32_t>(i))]);
  Shape other = shape;
  for (std::size_t i = 0; i < number.size(); ++i) other.positions[number[i]] = shape.positions[i];
  for (auto& face : other.faces)
    for (std::uint32_t& corner : face) corner = number[corner];
  return other;
}

struct Sheets {
  Shape a;
  Shape b;
};

/// The second sheet is a copy of which some corners are lower.
Sheets sheets_of(const Kind& kind, std::uint64_t seed) {
  Random random(seed);
  Sheets sheets;
  sheets.a = sheet(kind, random);
  collapse(sheets.a, kind.collapsed, random);
  sheets.b = renumbered(sheets.a, random);
  for (Vector3d& point : sheets.b.positions)
    if (random.chance(kind.moved)) point.z() -= 1 + random.below(3);
  collapse(sheets.b, kind.collapsed / 4, random);
  return sheets;
}

/// A middle corner and many around it, at random heights.
Shape fan(std::uint32_t count, std::uint64_t seed) {
  Random random(seed);
  Shape shape;
  shape.positions.emplace_back(0, 0, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double part = i / static_cast<double>(count);  // around a square
    const double along = 4 * part - std::floor(4 * part);
    const std::array<Vector3d, 5> corner{Vector3d(1, 0, 0), {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {1, 0, 0}};
    const auto quarter = static_cast<std::size_t>(4 * part);
    shape.positions.push_back((1 - along) * corner[quarter] + along * corner[quarter + 1] +
                              Vector3d(0, 0, random.between(-0.2, 0.2)));
    shape.faces.push_back({0, 1 + i, 1 + (i + 1) % count});
  }
  return shape;
}

/// Returns the kind of the contact, which is compared with brute force.
ContactKind check(const Shape& a, const Shape& b) {
  const std::optional<oracle::Named> expected = oracle::closest(a, b, 0.125);
  const PairAnswer answer = detect(surface_of(a), surface_of(b), query_of(ContactDetail::closest, 0.125));
  REQUIRE(expected);
  REQUIRE(answer.contacts.size() == 1);
  const Contact& contact = answer.contacts.front();
  CHECK(contact.kind == expected->kind);
  CHECK(contact.feature_a == expected->a);
  CHECK(contact.feature_b == expected->b);
  CHECK(answer.distance.upper == 0);
  return contact.kind;
}

}  // namespace

TEST_CASE("coinciding corners: the closest points are those of brute force") {
  const FloatingPointScope scope;
  std::array<std::size_t, 6> contacts{};
  for (const Kind& kind : kinds)
    for (std::uint64_t seed = 0; seed < repeats(4); ++seed) {
      INFO(kind.name << ", seed " << seed);
      const Sheets sheets = sheets_of(kind, seed);
      ++contacts[static_cast<std::size_t>(check(sheets.a, sheets.b))];
    }
  CHECK(contacts[static_cast<std::size_t>(ContactKind::VV)] > 0);
  CHECK(contacts[static_cast<std::size_t>(ContactKind::FF)] > 0);
}

TEST_CASE("coinciding corners: a vertex may have any number of faces") {
  const FloatingPointScope scope;
  for (const std::uint32_t count : {64U, 65U}) {
    INFO(count << " faces");
    Random random(count);
    const Shape whole = fan(count, count);
    CHECK(check(whole, renumbered(whole, random)) == ContactKind::FF);
    Shape bent = renumbered(whole, random);
    for (Vector3d& point : bent.positions)
      if (point != Vector3d::Zero()) point.z() -= 0.5;
    CHECK(check(whole, bent) == ContactKind::VV);
  }
}

}  // namespace graze::tests
