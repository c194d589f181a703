// This test moves a scene far from the origin and scales it, and compares the answers.

#include <cmath>
#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

/// Half the distance from a double to the next larger one: what rounding to nearest may cost.
double half_unit(double value) {
  const double size = std::abs(value);
  return (std::nextafter(size, infinity) - size) / 2;
}

/// Whether `point` is `exact + offset` to the last bit, or rounded to nearest where it is computed.
bool is_moved(const Vector3d& point, const Feature& feature, const Vector3d& exact, const Vector3d& offset) {
  for (int axis = 0; axis < 3; ++axis) {
    const long double truth = static_cast<long double>(exact[axis]) + offset[axis];
    const long double off = std::abs(static_cast<long double>(point[axis]) - truth);
    const double allowed = feature.kind == FeatureKind::vertex ? 0 : half_unit(point[axis]) + 0x1p-45;
    if (off > allowed) return false;
  }
  return true;
}

/// The only pair far away: everything but the points as it was, and the points moved.
void check_moved(const FrameReport& now, const FrameReport& before, const Expected& expected,
                 const Vector3d& offset) {
  const PairReport& row = only_pair(now);
  const PairReport& first = only_pair(before);
  REQUIRE(row.distance.lower == first.distance.lower);
  REQUIRE(row.distance.upper == first.distance.upper);
  REQUIRE(row.witness.feature_a == first.witness.feature_a);
  REQUIRE(row.witness.feature_b == first.witness.feature_b);
  REQUIRE(is_moved(row.witness.point_a, row.witness.feature_a, first.witness.point_a, offset));
  REQUIRE(is_moved(row.witness.point_b, row.witness.feature_b, first.witness.point_b, offset));
  REQUIRE(now.contacts().size() == before.contacts().size());
  REQUIRE(now.contacts().size() == expected.contacts.size());
  for (std::size_t i = 0; i < now.contacts().size(); ++i) {
    const Contact& contact = now.contacts()[i];
    const Contact& original = before.contacts()[i];
    REQUIRE(contact.kind == original.kind);
    REQUIRE(contact.feature_a == original.feature_a);
    REQUIRE(contact.feature_b == original.feature_b);
    REQUIRE(contact.distance == original.distance);
    REQUIRE(contact.normal == original.normal);
    REQUIRE(contact.side_a == original.side_a);
    REQUIRE(contact.side_b == original.side_b);
    REQUIRE(is_moved(contact.point_a, contact.feature_a, expected.contacts[i].point_a, offset));
    REQUIRE(is_moved(contact.point_b, contact.feature_b, expected.contacts[i].point_b, offset));
  }
}

/// The only pair times `factor`: every length scaled exactly.
void check_scaled(const FrameReport& now, const FrameReport& before, double factor) {
  const PairReport& row = only_pair(now);
  const PairReport& first = only_pair(before);
  REQUIRE(row.distance.lower == first.distance.lower * factor);
  REQUIRE(row.distance.upper == first.distance.upper * factor);
  REQUIRE(row.witness.feature_a == first.witness.feature_a);
  REQUIRE(row.witness.feature_b == first.witness.feature_b);
  REQUIRE(now.contacts().size() == before.contacts().size());
  for (std::size_t i = 0; i < now.contacts().size(); ++i) {
    const Contact& contact = now.contacts()[i];
    const Contact& original = before.contacts()[i];
    REQUIRE(contact.kind == original.kind);
    REQUIRE(contact.feature_a == original.feature_a);
    REQUIRE(contact.feature_b == original.feature_b);
    REQUIRE(contact.distance == original.distance * factor);
    REQUIRE((contact.normal - original.normal).norm() <= 0x1p-50);
    REQUIRE(contact.side_a == original.side_a);
    REQUIRE(contact.side_b == original.side_b);
    // Points may differ by a unit in the last place. Plain double rounds in several steps, and exact
    // arithmetic, which takes over if double is unsure, rounds once.
    REQUIRE((contact.point_a - original.point_a * factor).cwiseAbs().maxCoeff() <= factor * 0x1p-50);
    REQUIRE((contact.point_b - original.point_b * factor).cwiseAbs().maxCoeff() <= factor * 0x1p-50);
  }
}

}  // namespace

TEST_CASE("far from the origin: moved by 2^10, 2^20 and 2^40") {
  std::size_t scenes = 0;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    const Shape a = snapped(given.a, 0x1p-11);
    const Shape b = snapped(given.b, 0x1p-11);
    for (const ContactDetail detail : all_details) {
      const Expected expected = expected_of(a, b, given.threshold, detail);
      BodyScene scene({a, b}, settings_of(given.threshold, infinity, detail));
      const ReportHandle before = scene.step({a, b});
      for (const double far : {0x1p10, 0x1p20, 0x1p40}) {
        INFO("seed " << seed << ", moved by " << far << ", detail " << static_cast<int>(detail));
        const Vector3d offset(far, -far, far / 4);
        const ReportHandle now = scene.step({{a, mapped(a, 1, offset)}, {b, mapped(b, 1, offset)}});
        check_moved(*now, *before, expected, offset);
        contacts += now->contacts().size();
        ++scenes;
      }
    }
  }
  CHECK(contacts > 3000);
  std::cout << "compared " << scenes << " scenes far from the origin, " << contacts << " contacts\n";
}

TEST_CASE("scale: times 2^-60 to 2^60") {
  std::size_t scenes = 0;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 80; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    for (const ContactDetail detail : all_details) {
      BodyScene scene({given.a, given.b}, settings_of(given.threshold, infinity, detail));
      const ReportHandle before = scene.step({given.a, given.b});
      for (int exponent = -60; exponent <= 60; exponent += 2) {
        INFO("seed " << seed << ", times 2^" << exponent << ", detail " << static_cast<int>(detail));
        const double factor = std::ldexp(1.0, exponent);
        const auto scaled = [&](const Shape& shape) {
          return Body(shape, mapped(shape, factor, Vector3d::Zero()));
        };
        scene.scene().set_rule(0, 0, {given.threshold * factor, infinity, {}});
        const ReportHandle now = scene.step({scaled(given.a), scaled(given.b)});
        check_scaled(*now, *before, factor);
        contacts += now->contacts().size();
        ++scenes;
      }
    }
  }
  CHECK(contacts > 3000);
  std::cout << "compared " << scenes << " scaled scenes, " << contacts << " contacts\n";
}

TEST_CASE("scale: meshes made at 2^-60 and 2^60") {
  Tally tally;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    for (const double factor : {0x1p-60, 0x1p60}) {
      INFO("seed " << seed << ", times " << factor);
      tally.compare({mapped(given.a, factor, Vector3d::Zero()), mapped(given.b, factor, Vector3d::Zero())},
                    given.threshold * factor);
    }
  }
  CHECK(tally.contacts > 300);
  tally.print("meshes made small and large");
}

}  // namespace graze::tests
