// Quads: flat, warped, concave, degenerate to triangles.

#include <Eigen/Geometry>
#include <algorithm>
#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

enum class Form { flat, warped, concave, folded_over, triangle };
constexpr std::array forms{Form::flat, Form::warped, Form::concave, Form::folded_over, Form::triangle};

/// A quad about the origin. Its corners are small binary fractions, so that a flat one is exactly flat.
Shape quad_of(Form form, Random& random) {
  const auto up = [&] { return (1 + random.below(4)) * 0.125; };
  const double warp = form == Form::warped ? up() * (random.chance(0.5) ? 1 : -1) : 0.0;
  Shape shape =
      quad({-0.5 - up(), -up(), 0}, {up(), -0.5 - up(), 0}, {0.5 + up(), up(), 0}, {-up(), 0.5, warp});
  auto& corners = shape.positions;
  if (form == Form::concave) corners[2] = {-0.125, -0.0625, 0};
  if (form == Form::folded_over) corners[3] = corners[1] * 0.75 + Vector3d(0.0625, 0, 0);
  if (form == Form::triangle) {
    if (random.chance(0.3))
      shape.faces[0][random.below(4)] = shape.faces[0][random.below(4)];
    else
      corners[random.below(4)] = corners[random.below(4)];
  }
  return shape;
}

/// Something that comes near a quad: a thin triangle in any direction, or another quad.
Shape other_of(Random& random) {
  const auto grid = [&] { return (random.below(17) - 8.0) * 0.125; };
  const auto point = [&](double lift) {
    const double x = grid();
    const double y = grid();
    return Vector3d(x, y, grid() * lift);
  };
  if (random.chance(0.4))
    return mapped(turned(quad_of(forms[random.below(5)], random), random.next()), 1, point(0.5));
  const Vector3d from = point(0.25);
  if (random.chance(0.5)) return triangle(from, point(1), from + Vector3d(0.0625, 0, 2));
  return triangle(from, {from.x() + grid(), from.y() + grid(), -from.z()}, from + Vector3d(0, 0.0625, 2));
}

/// Whether every edge that is named runs along a side of a face.
bool names_sides_only(std::span<const Contact> contacts, const Shape& a, const Shape& b) {
  const auto is_side = [](const Shape& shape, const Feature& feature) {
    if (feature.kind != FeatureKind::edge) return true;
    const auto ends = mesh_of(shape)->edge(feature.index);
    for (const auto& face : shape.faces)
      for (std::size_t i = 0; i < face.size(); ++i) {
        const auto side = std::minmax(face[i], face[(i + 1) % face.size()]);
        if (side.first == ends[0] && side.second == ends[1]) return true;
      }
    return false;
  };
  return std::all_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
    return is_side(a, contact.feature_a) && is_side(b, contact.feature_b);
  });
}

}  // namespace

TEST_CASE("quads: flat, warped, concave, folded over, degenerate to triangles") {
  Tally tally;
  std::size_t folds = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    Random random(seed);
    const Shape a = quad_of(forms[seed % forms.size()], random);
    const Shape b = other_of(random);
    const double threshold = random.below(4) * 0.25;
    INFO("seed " << seed << "\na: " << text_of(a) << "b: " << text_of(b));
    tally.compare({a, b}, threshold);
    tally.compare({b, a}, threshold, ContactDetail::features);
    BodyScene scene({a, b}, settings_of(threshold, infinity));
    const ReportHandle report = scene.step({a, b});
    CHECK(names_sides_only(report->contacts(), a, b));
    for (const Contact& contact : report->contacts()) folds += contact.kind == ContactKind::FF ? 1U : 0U;
  }
  CHECK(tally.contacts > 2000);
  CHECK(folds > 20);
  tally.print("single quads");
}

TEST_CASE("quads: one edge that pierces a warped quad twice is one contact, nearer its lower vertex") {
  const Shape ridge = quad({0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1});
  std::size_t compared = 0;
  for (const double height : {-0.125, -0.25, -0.5})
    for (const bool turned_round : {false, true}) {
      const double way = turned_round ? -1 : 1;
      const Shape rod = triangle({-2 * way, 0.0625, height}, {2 * way, 0.0625, height}, {0, 0.5, -8});
      BodyScene scene({ridge, rod}, settings_of(0, infinity));
      const ReportHandle report = scene.step({ridge, rod});
      std::size_t piercings = 0;
      for (const Contact& contact : report->contacts()) {
        if (contact.feature_b != Feature{FeatureKind::edge, 0}) continue;
        CHECK(contact.kind == ContactKind::EF);
        CHECK(contact.distance == 0);
        CHECK(contact.point_b.x() * way < 0);
        ++piercings;
      }
      CHECK(piercings == 1);
      CHECK(difference_of(report->contacts(), oracle::features(ridge, rod, 0), Tolerance(ridge, rod)) == "");
      compared += report->contacts().size();
    }
  std::cout << "compared " << compared << " contacts of edges through a warped quad\n";
}

TEST_CASE("quads: closest points on the fold") {
  const Shape ridge = quad({0, -1, 0}, {1, 0, -1}, {0, 1, 0}, {-1, 0, -1});
  const Shape valley = quad({-1, 0, 0.5}, {0, -1, 1.5}, {1, 0, 0.5}, {0, 1, 1.5});
  const Shape rod = triangle({-1, 0.25, 0.5}, {1, 0.25, 0.5}, {0, 0.25, 8});
  const Shape stake = triangle({0, 0.25, 0.5}, {0.25, 0.25, 4}, {0, 0.5, 4});
  const auto kind_of = [](const Shape& a, const Shape& b) {
    BodyScene scene({a, b}, settings_of(0.625, infinity, ContactDetail::closest));
    const ReportHandle report = scene.step({a, b});
    REQUIRE(report->contacts().size() == 1);
    CHECK(report->contacts()[0].distance == 0.5);
    return report->contacts()[0].kind;
  };
  CHECK(kind_of(ridge, valley) == ContactKind::FF);
  CHECK(kind_of(ridge, rod) == ContactKind::EF);
  CHECK(kind_of(ridge, stake) == ContactKind::VF);
  Tally tally;
  for (const Shape& other : {valley, rod, stake}) {
    tally.compare({ridge, other}, 0.625);
    tally.compare({other, ridge}, 0.625);
  }
  tally.print("contacts on a fold");
}

TEST_CASE("quads: warped surfaces of many") {
  const Shape sheet = shape_of(models::sheet(8, 6, 2, 1.5));
  const Shape ball = shape_of(models::sphere(10, 7, models::Faces::quads));
  Tally tally;
  tally.compare({{sheet, wobbled(sheet, 0.1, 7)}, {sheet, wobbled(sheet, 0.1, 8)}}, 0.05);
  tally.compare({{sheet, wobbled(sheet, 0.2, 9)}, {ball, wobbled(ball, 0.2, 10)}}, 0.05);
  tally.compare({{ball, wobbled(ball, 0.3, 11)}, {ball, mapped(wobbled(ball, 0.3, 12), 1, {1, 0.5, 0.25})}},
                0.1);
  CHECK(tally.contacts > 300);
  tally.print("warped surfaces");
}

}  // namespace graze::tests
