// Whole meshes at several distances against the oracle: the paper's models, and real ones where there are
// any. They are apart, near, touching exactly or interpenetrating, at rest and deformed.

#include <cmath>
#include <filesystem>
#include <iostream>

#include "core/comparison.hpp"
#include "core/mesh_files.hpp"
#include "core/shapes.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

using Eigen::Vector3d;
using oracle::Shape;

/// How many pairs and contacts were compared.
struct Tally {
  std::size_t pairs = 0;
  std::size_t contacts = 0;

  void check(const Body& a, const Body& b, double threshold) {
    const Comparison comparison = compare(a, b, threshold);
    CHECK(comparison.difference == "");
    contacts += comparison.contacts;
    ++pairs;
  }
  void print(const char* what) const {
    std::cout << "compared " << pairs << " pairs of " << what << ", " << contacts << " contacts\n";
  }
};

/// A pair with b apart from a, near it, touching it and in it. It touches at rest on a grid, where that is
/// exact, and else deformed.
void check_distances(const Shape& a, const Shape& b, Tally& tally) {
  constexpr double threshold = 0.06;
  const Shape rest_a = snapped(a, 0x1p-20);
  const Shape rest_b = snapped(b, 0x1p-20);
  tally.check(rest_a, placed_beside(rest_b, rest_a, 0, 0), threshold);
  const Shape deformed_a = wobbled(rest_a, 0.05, 3);
  for (const double gap : {0.25, threshold / 2, -0.05}) {
    INFO("gap " << gap);
    const Shape deformed_b = placed_beside(wobbled(rest_b, 0.05, 4), deformed_a, 0, gap);
    tally.check({rest_a, deformed_a}, {rest_b, deformed_b}, threshold);
  }
}

std::string data_path(const std::string& file) {
  return std::string(GRAZE_SHARED_DATA) + "/" + file;
}

/// Says so and returns false where a file of the shared data is missing.
bool has_data(const std::string& file) {
  if (std::filesystem::exists(data_path(file))) return true;
  std::cout << "skipped: there is no " << data_path(file) << "\n";
  return false;
}

}  // namespace

TEST_CASE("models: pairs of the paper's models at several distances") {
  const auto& models = paper_models();
  const auto& quads = paper_models_of_quads();
  Tally tally;
  const auto check = [&](const NamedShape& a, const NamedShape& b) {
    INFO(a.name << " and " << b.name);
    check_distances(a.shape, b.shape, tally);
  };
  check(models[0], models[1]);  // torus, pawn
  check(models[3], quads[2]);   // human, cylinder of quads
  CHECK(tally.contacts > 200);
  tally.print("the paper's models");
}

TEST_CASE("models: shapes of a few hundred faces, one inside, across and resting on the other") {
  const Shape ball = shape_of(models::sphere(14, 9));
  const Shape quad_ball = shape_of(models::sphere(12, 7, models::Faces::quads));
  const Shape ring = shape_of(models::torus(16, 10, 0.9, 0.3, models::Faces::quads));
  const Shape sheet = shape_of(models::sheet(12, 10, 3, 3));
  Tally tally;
  tally.check(ball, turned(ball, 1), 0.05);                       // all over each other
  tally.check(ball, mapped(quad_ball, 0.5, {0.1, 0.2, 0}), 0.3);  // wholly inside
  tally.check(ring, mapped(quad_ball, 0.55, {0, 0, 0}), 0.1);     // through the hole
  tally.check(sheet, mapped(ring, 1, {0, 0, 0.3}), 0.01);         // resting on the sheet
  tally.check(sheet, mapped(quad_ball, 1, {0, 0, 1}), 0.05);
  tally.check(sheet, mapped(sheet, 1, {0.125, 0, 0.0625}), 0.07);     // one over the other
  tally.check(sheet, sheet, 0.01);                                    // on each other
  tally.check(wobbled(sheet, 0.1, 7), wobbled(sheet, 0.1, 8), 0.05);  // warped, through each other
  tally.check({sheet, wobbled(sheet, 0.3, 9)}, {ball, mapped(ball, 0.5, {0, 0, 0.4})}, 0.05);
  CHECK(tally.contacts > 3000);
  tally.print("simple shapes");
}

TEST_CASE("models: a collapsed and an inside-out surface") {
  const Shape ball = shape_of(models::sphere(10, 7));
  Tally tally;
  tally.check({ball, mapped(ball, 0, {1.05, 0, 0})}, ball, 0.1);
  tally.check({ball, mapped(ball, -1, {1.9, 0, 0})}, ball, 0.1);
  Shape exploded = ball;
  exploded.positions[3] = {0x1p100, 0x1p99, -0x1p98};
  tally.check({ball, exploded}, mapped(ball, 1, {1.9, 0.1, 0}), 0.2);
  CHECK(tally.contacts > 50);
  tally.print("surfaces collapsed and exploded");
}

TEST_CASE("models: real cubes, close, far and intersecting") {
  Tally tally;
  for (const std::string name : {"close", "far", "intersecting"}) {
    const std::string file = "cubes/two-cubes-" + name + ".ply";
    if (!has_data(file)) return;
    INFO(file);
    const auto cubes = pieces_of(read_ply(data_path(file)));
    REQUIRE(cubes.size() == 2);
    const oracle::Pair apart = oracle::surface_distance(cubes[0], cubes[1]);
    CHECK(apart.pierced == (name == "intersecting"));
    for (const double threshold : {0.0, apart.distance_up, std::nextafter(apart.distance_up, 10.0), 0.1})
      tally.check(cubes[0], cubes[1], threshold);
    tally.check({cubes[0], wobbled(cubes[0], 0.05, 1)}, {cubes[1], wobbled(cubes[1], 0.05, 2)}, 0.1);
  }
  CHECK(tally.contacts > 100);
  tally.print("real cubes");
}

TEST_CASE("models: real links of a chain") {
  const std::string file = "bodies/chain__10-links.obj";
  if (!has_data(file)) return;
  const auto links = read_obj_objects(data_path(file));
  REQUIRE(links.size() == 10);
  Tally tally;
  for (std::size_t link = 0; link < 2; ++link) {
    const Shape& a = links[link];
    const Shape& b = links[link + 1];
    const double apart = oracle::surface_distance(a, b).distance_up;
    INFO("links " << link << " and " << link + 1 << ", " << apart << " apart");
    for (const double threshold : {apart, apart * 1.001 + 1e-3, apart + 0.2}) tally.check(a, b, threshold);
    tally.check({a, wobbled(a, 0.1, link)}, {b, wobbled(b, 0.1, link + 1)}, 0.1);
  }
  CHECK(tally.contacts > 100);
  tally.print("links of a chain");
}

}  // namespace graze::tests
