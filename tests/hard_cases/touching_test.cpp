// Parallel, coplanar, touching, coincident and interpenetrating surfaces.

#include <cmath>
#include <iostream>

#include "hard_cases/scene_comparison.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/effort.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Random;
using oracle::Shape;

struct Touch {
  const char* name;
  Shape a, b;
};

/// Everything that lies exactly in, on or along something else.
const std::vector<Touch>& touches() {
  static const Shape ground = quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
  static const Shape cube = box({0, 0, 0}, {1, 1, 1});
  static const Shape fin = triangle({-1, 0, 0}, {1, 0, 0}, {0, 0, 4});
  static const std::vector<Touch> all{
      {"parallel edges", fin, mapped(fin, -1, {0, 0, -0.5})},
      {"parallel edges that touch", fin, mapped(fin, -1, {0.5, 0, 0})},
      {"coplanar faces that overlap", ground, mapped(ground, 0.5, {1.5, 0.25, 0})},
      {"coplanar faces with a common edge", ground, mapped(ground, 1, {4, 0, 0})},
      {"coplanar faces with a common corner", ground, mapped(ground, 1, {4, 4, 0})},
      {"coplanar faces apart", ground, mapped(ground, 1, {4.25, 0, 0})},
      {"an edge lying in a face", ground, fin},
      {"an edge lying on a face's diagonal", ground, triangle({-1, -1, 0}, {1, 1, 0}, {0, 0, 3})},
      {"an edge lying on a border", ground, triangle({-1, 2, 0}, {1, 2, 0}, {0, 3, 3})},
      {"a vertex on an edge", ground, triangle({2, 0.5, 0}, {3, 0, 1}, {3, 1, 1})},
      {"a vertex in a face", ground, triangle({0.5, 0.25, 0}, {0, 0, 2}, {1, 0, 2})},
      {"a shared point", cube, mapped(cube, 1, {1, 1, 1})},
      {"a shared edge", cube, mapped(cube, 1, {1, 1, 0})},
      {"a shared face", cube, mapped(cube, 1, {1, 0, 0})},
      {"a box standing on the ground", ground, cube},
      {"a box standing under the ground", ground, mapped(cube, 1, {0, 0, -1})},
      {"a box parallel above the ground", ground, mapped(cube, 1, {0, 0, 0.25})},
      {"crossing edges that touch", fin, triangle({0, -1, 0}, {0, 1, 0}, {0, 0, -4})},
  };
  return all;
}

bool same_contact(const Contact& left, const Contact& right) {
  return left.kind == right.kind && left.feature_a == right.feature_a && left.feature_b == right.feature_b &&
         left.distance == right.distance && left.normal == right.normal && left.point_a == right.point_a &&
         left.point_b == right.point_b && left.side_a == right.side_a && left.side_b == right.side_b;
}

bool same_contacts(std::span<const Contact> left, std::span<const Contact> right) {
  return std::equal(left.begin(), left.end(), right.begin(), right.end(), same_contact);
}

Shape jittered(Shape shape, double size, Random& random) {
  for (Vector3d& position : shape.positions)
    for (double& coordinate : position) coordinate += random.between(-size, size);
  return shape;
}

}  // namespace

TEST_CASE("parallel edges, coplanar faces, an edge in a face, a vertex on an edge, shared points") {
  Tally tally;
  for (const Touch& touch : touches())
    for (const double threshold : {0.0, 0x1p-40, 0.25, std::nextafter(0.25, 1), 0.75}) {
      INFO(touch.name << " at threshold " << threshold);
      tally.compare({touch.a, touch.b}, threshold);
      tally.compare({touch.b, touch.a}, threshold);
    }
  CHECK(tally.contacts > 500);
  tally.print("what touches or is parallel");
}

TEST_CASE("parallel edges and coplanar faces: kinds and normals stay from step to step") {
  std::size_t contacts = 0;
  for (const Touch& touch : touches())
    for (const ContactDetail detail : all_details) {
      INFO(touch.name << ", detail " << static_cast<int>(detail));
      BodyScene scene({touch.a, touch.b}, settings_of(0.75, infinity, detail));
      const ReportHandle first = scene.step({touch.a, touch.b});
      Random random(1);
      for (int round = 0; round < 4; ++round) {
        CHECK(same_contacts(scene.step({touch.a, touch.b})->contacts(), first->contacts()));
        scene.step({jittered(touch.a, 0.01, random), jittered(touch.b, 0.01, random)});
        CHECK(same_contacts(scene.step({touch.a, touch.b})->contacts(), first->contacts()));
        contacts += 2 * first->contacts().size();
        // Both moved alike: nothing but the points is another.
        const Vector3d offset(8, -4, 16);
        const ReportHandle moved = scene.step({mapped(touch.a, 1, offset), mapped(touch.b, 1, offset)});
        REQUIRE(moved->contacts().size() == first->contacts().size());
        for (std::size_t i = 0; i < first->contacts().size(); ++i) {
          CHECK(moved->contacts()[i].kind == first->contacts()[i].kind);
          CHECK(moved->contacts()[i].normal == first->contacts()[i].normal);
        }
      }
    }
  CHECK(contacts > 500);
  std::cout << "compared " << contacts << " contacts from step to step\n";
}

TEST_CASE("parallel edges or not: small moves far from a change of kind turn normals little") {
  constexpr double jitter = 1e-10;
  std::size_t contacts = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Random random(seed);
    const oracle::RandomScene given = oracle::random_scene(2 * seed);
    const Shape a = jittered(given.a, 0.02, random);
    const Shape b = jittered(given.b, 0.02, random);
    BodyScene scene({a, b}, settings_of(given.threshold + 0.015, infinity));
    const ReportHandle first = scene.step({a, b});
    INFO("seed " << seed << "\na: " << text_of(a) << "b: " << text_of(b));
    for (int round = 0; round < 3; ++round) {
      const ReportHandle now =
          scene.step({Body(a, jittered(a, jitter, random)), Body(b, jittered(b, jitter, random))});
      REQUIRE(now->contacts().size() == first->contacts().size());
      for (std::size_t i = 0; i < first->contacts().size(); ++i) {
        const Contact& before = first->contacts()[i];
        const Contact& after = now->contacts()[i];
        REQUIRE(after.kind == before.kind);
        REQUIRE(after.feature_a == before.feature_a);
        REQUIRE(after.feature_b == before.feature_b);
        CHECK((after.normal - before.normal).norm() <= 1e-5);
        ++contacts;
      }
    }
  }
  CHECK(contacts > 3000);
  std::cout << "compared " << contacts << " normals after small moves\n";
}

TEST_CASE("two objects with the same vertices exactly on top of each other") {
  Tally tally;
  for (const Shape& shape :
       {box({0, 0, 0}, {1, 1, 1}), shape_of(models::sphere(14, 9)), shape_of(models::sheet(8, 6, 2, 1)),
        wobbled(shape_of(models::torus(12, 8, 0.9, 0.3, models::Faces::quads)), 0.05, 2),
        wobbled(shape_of(models::sphere(10, 7, models::Faces::quads)), 0.1, 3)})
    tally.compare({shape, shape}, 0.05);
  for (std::uint64_t seed = 0; seed < repeats(60); ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    INFO("seed " << seed);
    tally.compare({given.a, given.a, given.a}, given.threshold / 2);
  }
  CHECK(tally.contacts > repeats(4000));
  tally.print("objects on top of each other");

  for (const NamedShape& model : paper_models()) {
    INFO(model.name);
    BodyScene scene({model.shape, model.shape}, settings_of(1e-6, 1, ContactDetail::vertices));
    const ReportHandle report = scene.step({model.shape, model.shape});
    CHECK(only_pair(*report).distance.upper == 0);
    CHECK(inconsistency_of(*report) == "");
    REQUIRE(report->contacts().size() == model.shape.positions.size());
    for (std::uint32_t i = 0; i < report->contacts().size(); ++i) {
      CHECK(report->contacts()[i].feature_a.index == i);
      CHECK(report->contacts()[i].feature_b.index == i);
    }
  }
}

TEST_CASE("interpenetrating surfaces: edges that pierce faces") {
  Tally tally;
  std::size_t piercings = 0;
  const auto compare = [&](const Body& a, const Body& b, double threshold) {
    tally.compare({a, b}, threshold);
    for (const oracle::Named& contact : oracle::features(a.now, b.now, threshold)) {
      if (!contact.pierced) continue;
      CHECK(contact.kind == ContactKind::EF);
      CHECK(contact.distance == 0);
      ++piercings;
    }
  };
  const Shape ball = shape_of(models::sphere(14, 9));
  const Shape quads = shape_of(models::sphere(11, 7, models::Faces::quads));
  compare(ball, mapped(quads, 0.75, {0.5, 0.125, 0}), 0);
  compare(ball, mapped(turned(ball, 3), 1, {0.3, 0.2, 0.1}), 0.02);
  compare(wobbled(quads, 0.2, 5), mapped(wobbled(quads, 0.2, 6), 1, {0.25, 0, 0}), 0.02);
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const oracle::RandomScene given = oracle::random_scene(seed);
    if (given.placement != oracle::Placement::interpenetrating) continue;
    INFO("seed " << seed);
    for (const double threshold : {0.0, given.threshold}) compare(given.a, given.b, threshold);
  }
  CHECK(piercings > 500);
  tally.print("interpenetrating surfaces");
  std::cout << "compared " << piercings << " piercing edges\n";
}

}  // namespace graze::tests
