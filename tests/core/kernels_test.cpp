// The kernels where they are hardest: at the threshold, at changes of kind, on needles, far from the origin,
// and at the ends of the range of doubles. Everything is compared with the oracle.

#include <cmath>
#include <iostream>
#include <limits>

#include "core/comparison.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"
#include "support/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Two shapes half a unit apart whose one closest contact is of a known kind, and the directions along which
/// a small move of b brings another kind.
struct Case {
  std::string name;
  ContactKind closest;
  Shape a, b;
  std::vector<Vector3d> changes;
};

/// A thin triangle that stands on its vertex 0.
Shape stake(const Vector3d& tip) {
  return triangle(tip, tip + Vector3d(0.25, 0, 4), tip + Vector3d(0, 0.25, 4));
}

/// A triangle that stands on its edge 0, from p to q.
Shape blade(const Vector3d& p, const Vector3d& q) {
  return triangle(p, q, (p + q) / 2 + Vector3d(0, 0, 8));
}

/// A quad whose inner diagonal is a ridge along y at height 0.
Shape roof() {
  return quad({0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1});
}

std::vector<Case> cases() {
  const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  const Shape below = triangle({-2, 0, 0}, {2, 0, 0}, {0, 0, -8});
  const Shape valley = quad({-1, 0, 0.5}, {0, -1, 1.5}, {1, 0, 0.5}, {0, 1, 1.5});
  const Vector3d x = Vector3d::UnitX();
  const Vector3d y = Vector3d::UnitY();
  const Vector3d z = Vector3d::UnitZ();
  using enum ContactKind;
  return {
      {"VV, corner over corner", VV, ground, stake({2, 2, 0.5}), {x, y}},
      {"VV, beside a corner", VV, ground, stake({2.5, 2, 0}), {x, y, z}},
      {"VE, over the middle of a border", VE, ground, stake({2, 0.5, 0.5}), {x, y}},
      {"VE, over the end of a border", VV, below, stake({2, 0, 0.5}), {x, y}},
      {"VF, over the inside", VF, ground, stake({0.5, 0.25, 0.5}), {x, y}},
      {"VF, over a flat quad's diagonal", VF, ground, stake({0.5, 0.5, 0.5}), {x, y}},
      {"VF, over a fold", VF, roof(), stake({0, 0.25, 0.5}), {x, y}},
      {"EE, crossing", EE, below, blade({0.25, -2, 0.5}, {0.25, 2, 0.5}), {x, y}},
      {"EE, crossing at an end", VE, below, blade({2, -2, 0.5}, {2, 2, 0.5}), {x}},
      {"EE, parallel", EE, below, blade({-1, 0, 0.5}, {3, 0, 0.5}), {x, y}},
      {"EE, parallel, meeting in one point", VV, below, blade({2, 0, 0.5}, {4, 0, 0.5}), {x, y}},
      {"EF, parallel over the inside", EF, ground, blade({-1, 0.25, 0.5}, {1, 0.5, 0.5}), {x, y}},
      {"EF, parallel over a border", EE, ground, blade({-1, 2, 0.5}, {1, 2, 0.5}), {y}},
      {"EF, over a fold", EF, roof(), blade({-1, 0.25, 0.5}, {1, 0.25, 0.5}), {x, y}},
      {"VF, an edge along a fold", VF, roof(), blade({0, -0.5, 0.5}, {0, 0.5, 0.5}), {x, y}},
      {"FF, fold over fold", FF, roof(), valley, {x, y}},
      {"FF, parallel", FF, ground, quad({-1, -1, 0.5}, {-1, 1, 0.5}, {3, 1, 0.5}, {3, -1, 0.5}), {x, y}},
  };
}

/// Nothing, one unit in the last place, and 1e-12 to either side.
const std::vector<double> nudges{0, 0x1p-52, -0x1p-52, 1e-12, -1e-12};

void check(const Body& a, const Body& b, double threshold, std::size_t& contacts) {
  const Comparison comparison = compare(a, b, threshold);
  contacts += comparison.contacts;
  CHECK(comparison.difference == "");
}

/// Names, the very same distances times `factor`, and points moved by `offset` to the nearest doubles; but
/// for the last bits of what exact arithmetic rounds to double.
void check_same(const PairAnswer& answer, const PairAnswer& original, double factor, const Vector3d& offset) {
  REQUIRE(answer.contacts.size() == original.contacts.size());
  CHECK(answer.in_contact == original.in_contact);
  CHECK(answer.distance.lower == original.distance.lower * factor);
  CHECK(answer.distance.upper == original.distance.upper * factor);
  const double rounding = offset.cwiseAbs().maxCoeff() * 0x1p-51 + factor * 0x1p-50;
  for (std::size_t i = 0; i < answer.contacts.size(); ++i) {
    const Contact& now = answer.contacts[i];
    const Contact& before = original.contacts[i];
    CHECK(now.kind == before.kind);
    CHECK(now.feature_a == before.feature_a);
    CHECK(now.feature_b == before.feature_b);
    CHECK(now.distance == before.distance * factor);
    CHECK((now.normal - before.normal).norm() <= 0x1p-50);
    CHECK(now.side_a == before.side_a);
    CHECK(now.side_b == before.side_b);
    CHECK((now.point_a - (before.point_a * factor + offset)).cwiseAbs().maxCoeff() <= rounding);
    CHECK((now.point_b - (before.point_b * factor + offset)).cwiseAbs().maxCoeff() <= rounding);
  }
}

constexpr std::array all_details{ContactDetail::none, ContactDetail::closest, ContactDetail::regions,
                                 ContactDetail::vertices, ContactDetail::features};

}  // namespace

TEST_CASE("kernels: each closest feature at the threshold and at its changes of kind") {
  std::size_t contacts = 0;
  for (const Case& scene : cases()) {
    SECTION(scene.name) {
      const oracle::Pair distance = oracle::surface_distance(scene.a, scene.b);
      REQUIRE(distance.distance_down == 0.5);
      REQUIRE(distance.distance_up == 0.5);
      const auto closest = oracle::closest(scene.a, scene.b, 1);
      REQUIRE(closest.has_value());
      CHECK(closest->kind == scene.closest);
      CHECK(detect(surface_of(scene.a), surface_of(scene.b), query_of(ContactDetail::features, 0.5))
                .contacts.empty());
      for (const double above : nudges) {
        const Shape lifted = mapped(scene.b, 1, {0, 0, above});
        for (const double wider : nudges) check(scene.a, lifted, 0.5 + wider, contacts);
      }
      for (const Vector3d& along : scene.changes) {
        for (const double aside : nudges) {
          const Shape moved = mapped(scene.b, 1, along * aside);
          check(scene.a, moved, 0.75, contacts);
          check(scene.a, moved, 0.5, contacts);
          check(moved, scene.a, 0.75, contacts);
        }
      }
      CHECK(contacts > 0);
    }
  }
}

/// An area thinner than rounding has a middle somewhere in it: the points are checked for lying in the
/// closest set, and everything else as always.
void check_thin_overlap(const Shape& a, const Shape& b, double threshold, std::size_t& contacts) {
  const Tolerance tolerance(a, b);
  const auto expected = oracle::features(a, b, threshold);
  CHECK(difference_of(
            detect(surface_of(a), surface_of(b), query_of(ContactDetail::features, threshold)).contacts,
            expected, tolerance) == "");
  const auto closest = oracle::closest(a, b, threshold);
  const PairAnswer answer = detect(surface_of(a), surface_of(b), query_of(ContactDetail::closest, threshold));
  REQUIRE(answer.contacts.size() == (closest ? 1U : 0U));
  contacts += expected.size() + answer.contacts.size();
  if (!closest) return;
  const Contact& contact = answer.contacts[0];
  CHECK(contact.kind == closest->kind);
  CHECK(contact.feature_a == closest->a);
  CHECK(contact.feature_b == closest->b);
  const double error = tolerance.of(closest->a, closest->b, closest->distance);
  CHECK(std::abs(contact.distance - closest->distance) <= error);
  CHECK(std::abs((contact.point_b - contact.point_a).norm() - closest->distance) <= error);
  CHECK(std::abs(contact.point_a.x() - 2) <= 1.1e-12);
  CHECK(std::abs(contact.point_a.y()) <= 1);
}

TEST_CASE("kernels: parallel faces with an overlap as thin as rounding") {
  const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  const Shape beside = quad({2, -1, 0.5}, {2, 1, 0.5}, {4, 1, 0.5}, {4, -1, 0.5});
  std::size_t contacts = 0;
  for (const double nudge : nudges)
    check_thin_overlap(ground, mapped(beside, 1, {nudge, 0, 0}), 0.75, contacts);
  for (std::size_t vertex = 0; vertex < beside.positions.size(); ++vertex)
    for (int axis = 0; axis < 3; ++axis)
      for (const double nudge : {0x1p-52, -0x1p-52}) {
        Shape moved = beside;
        moved.positions[vertex][axis] += nudge;
        check_thin_overlap(ground, moved, std::nextafter(0.5, 1), contacts);
      }
  CHECK(contacts > 50);
}

TEST_CASE("kernels: a move along each coordinate of each vertex by a unit in the last place") {
  std::size_t contacts = 0;
  for (const Case& scene : cases()) {
    INFO(scene.name);
    for (std::size_t vertex = 0; vertex < scene.b.positions.size(); ++vertex)
      for (int axis = 0; axis < 3; ++axis)
        for (const double nudge : {0x1p-52, -0x1p-52}) {
          Shape moved = scene.b;
          moved.positions[vertex][axis] += nudge;
          check(scene.a, moved, 0.5, contacts);
          check(scene.a, moved, std::nextafter(0.5, 1), contacts);
        }
  }
  CHECK(contacts > 900);
  std::cout << "compared " << contacts << " contacts beside a change of kind\n";
}

TEST_CASE("kernels: a distance equal to the threshold is no contact, the next double is one") {
  // The distance of the tip is that of its three offsets, exact where they are multiples of (1, 2, 2) / 3.
  std::size_t contacts = 0;
  for (const double unit : {1.0, 0.1, 0x1.fffffffffffffp-3, 0x1p-300, 0x1p100}) {
    const Shape ground = triangle({0, 0, 0}, Vector3d(-1, 0, -1) * unit, Vector3d(0, -1, -1) * unit);
    const Shape tip = mapped(triangle({0, 0, 0}, {1, 0, 9}, {0, 1, 9}), unit, Vector3d(2, 4, 4) * unit);
    const double distance = 6 * unit;  // exactly, but for 0.1 and its like, where the oracle says which side
    check(ground, tip, distance, contacts);
    check(ground, tip, std::nextafter(distance, 0), contacts);
    const std::size_t before = contacts;
    check(ground, tip, std::nextafter(distance, distance * 2), contacts);
    CHECK(contacts > before);
  }
  const Shape ground = triangle({0, 0, 0}, {-1, 0, -1}, {0, -1, -1});
  const Shape tip = mapped(triangle({0, 0, 0}, {1, 0, 9}, {0, 1, 9}), 1, {2, 4, 4});
  CHECK_FALSE(detect(surface_of(ground), surface_of(tip), query_of(ContactDetail::features, 6)).in_contact);
}

TEST_CASE("kernels: needles of aspect 1e9") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const auto needle = [&](std::uint64_t turn) {
      const double at = random.between(0, 1);
      return turned(triangle({0, 0, 0}, {1, 0, 0}, {at, random.chance(0.5) ? 1e-9 : -1e-9, 0}), turn);
    };
    const Shape a = needle(seed);
    const double height = random.chance(0.3) ? 1e-9 : random.between(0, 0.2);
    const std::uint64_t turn = random.chance(0.3) ? seed : seed + 1000;  // often parallel
    const Shape b = mapped(needle(turn), 1, {height, random.between(-0.2, 0.2), random.between(-1e-9, 1e-9)});
    INFO("seed " << seed);
    check(a, b, random.chance(0.5) ? 0.3 : 2e-9, contacts);
  }
  CHECK(contacts > 500);
  std::cout << "compared " << contacts << " contacts of needles\n";
}

TEST_CASE("kernels: far from the origin the same contacts at the same distances") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Shape a = snapped(scene.a, 0x1p-11);
    const Shape b = snapped(scene.b, 0x1p-11);
    const Surface near_a = surface_of(a);
    const Surface near_b = surface_of(b);
    for (const double far : {0x1p10, 0x1p20, 0x1p40}) {
      const Vector3d offset(far, -far, far / 4);
      const Surface far_a = surface_of(mapped(a, 1, offset));
      const Surface far_b = surface_of(mapped(b, 1, offset));
      for (const ContactDetail detail : all_details) {
        INFO("seed " << seed << ", moved by " << far << ", detail " << static_cast<int>(detail));
        const PairAnswer original = detect(near_a, near_b, query_of(detail, scene.threshold));
        check_same(detect(far_a, far_b, query_of(detail, scene.threshold)), original, 1, offset);
        contacts += original.contacts.size();
      }
    }
  }
  CHECK(contacts > 3000);
  std::cout << "compared " << contacts << " contacts far from the origin\n";
}

TEST_CASE("kernels: scaled by powers of two the same contacts at scaled distances") {
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const oracle::RandomScene scene = oracle::random_scene(seed);
    const Surface a = surface_of(scene.a);
    const Surface b = surface_of(scene.b);
    for (const double factor : {0x1p-60, 0x1p-20, 0x1p60}) {
      const Surface scaled_a = surface_of(mapped(scene.a, factor, Vector3d::Zero()));
      const Surface scaled_b = surface_of(mapped(scene.b, factor, Vector3d::Zero()));
      for (const ContactDetail detail : all_details) {
        INFO("seed " << seed << ", factor " << factor << ", detail " << static_cast<int>(detail));
        const PairAnswer original = detect(a, b, query_of(detail, scene.threshold));
        check_same(detect(scaled_a, scaled_b, query_of(detail, scene.threshold * factor)), original, factor,
                   Vector3d::Zero());
        contacts += original.contacts.size();
      }
    }
  }
  CHECK(contacts > 3000);
  std::cout << "compared " << contacts << " scaled contacts\n";
}

TEST_CASE("kernels: coordinates up to 2^120 and down to where squares vanish") {
  std::size_t contacts = 0;
  for (const int exponent : {116, 100, -200, -300, -505, -520, -530, -536, -540, -1000}) {
    const double factor = std::ldexp(1.0, exponent);
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      const oracle::RandomScene scene = oracle::random_scene(seed);
      INFO("seed " << seed << ", factor 2^" << exponent);
      check(mapped(scene.a, factor, Vector3d::Zero()), mapped(scene.b, factor, Vector3d::Zero()),
            scene.threshold * factor, contacts);
    }
  }
  CHECK(contacts > 2000);
  std::cout << "compared " << contacts << " contacts of extreme size\n";
}

TEST_CASE("kernels: denormal coordinates") {
  std::size_t contacts = 0;
  for (const double unit : {4 * smallest, 12 * smallest, 0x1p-1030}) {
    for (std::uint64_t seed = 1; seed < 60; seed += 2) {  // on a grid of quarters
      const oracle::RandomScene scene = oracle::random_scene(seed);
      INFO("seed " << seed << ", unit " << unit);
      const auto scaled = [&](Shape shape) {
        return mapped(snapped(std::move(shape), 0.25), unit, Vector3d::Zero());
      };
      check(scaled(scene.a), scaled(scene.b), scene.threshold * unit, contacts);
    }
  }
  CHECK(contacts > 500);
  std::cout << "compared " << contacts << " contacts of denormal size\n";
}

TEST_CASE("kernels: a huge shape and a tiny one") {
  std::size_t contacts = 0;
  for (const int exponent : {20, 60, 110}) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      const Shape huge =
          mapped(oracle::random_scene(2 * seed + 1).a, std::ldexp(1.0, exponent), Vector3d::Zero());
      Shape tiny = mapped(oracle::random_scene(seed).b, std::ldexp(1.0, -exponent), Vector3d::Zero());
      const auto& face = huge.faces[seed % huge.faces.size()];
      const Vector3d middle =
          (huge.positions[face[0]] + huge.positions[face[1]] + huge.positions[face[2]]) / 4;
      if (seed % 2 == 0) tiny = mapped(tiny, 1, middle);  // else about the origin, where huge may pass
      INFO("seed " << seed << ", 2^" << exponent);
      check(huge, tiny, std::ldexp(seed % 3 == 0 ? 0.25 : 4.0, seed % 3 == 0 ? -exponent : exponent),
            contacts);
    }
  }
  CHECK(contacts > 500);
  std::cout << "compared " << contacts << " contacts of huge and tiny shapes\n";
}

}  // namespace graze::tests
