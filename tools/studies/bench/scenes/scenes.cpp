#include "bench/scenes/scenes.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "bench/scenes/scene_makers.hpp"
#include "bench/scenes/wobbling.hpp"
#include "scenes/mesh_of.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

using scenes::Random;

/// With a comma before the thousands.
std::string thousands(std::size_t number) {
  std::string digits = std::to_string(number);
  for (std::size_t place = digits.size(); place > 3;) digits.insert(place -= 3, ",");
  return digits;
}

Eigen::Vector3d cell_of(std::size_t index, std::size_t columns, std::size_t rows) {
  const std::size_t column = index % columns;
  const std::size_t row = index / columns % rows;
  const std::size_t layer = index / columns / rows;
  return {static_cast<double>(column), static_cast<double>(row), static_cast<double>(layer)};
}

/// The paper's first experiment: paths cross so that pairs come and go.
BenchScene paths() {
  BenchScene scene{"S1", "5 tori and 5 pawns on paths that cross", 0.05, 300, {}};
  Random random(1);
  const std::array meshes{scenes::mesh_of(models::torus()), scenes::mesh_of(models::pawn())};
  for (std::size_t i = 0; i < 10; ++i) {
    const Eigen::Matrix3d turn = random.turn();
    const Eigen::Vector3d centre = random.vector(-1, 1);
    const Eigen::Vector3d reach = random.vector(0.8, 1.6);
    const Eigen::Vector3d speed = random.vector(0.01, 0.03);
    scene.bodies.push_back(wobbling(meshes[i % 2], {turn, centre, reach, speed, random.between(0, 6), 0.03}));
  }
  return scene;
}

/// Nearly everything is near something.
BenchScene pile() {
  BenchScene scene{"S2", "a loose pile of 100 surfaces of about 1,000 vertices", 0.04, 40, {}};
  Random random(3);
  const std::array meshes{scenes::mesh_of(models::torus(40, 25, 0.7, 0.3)), scenes::mesh_of(models::pawn()),
                          scenes::mesh_of(models::sphere(40, 25))};
  for (std::size_t i = 0; i < 100; ++i) {
    const Eigen::Matrix3d turn = random.turn();
    const Eigen::Vector3d centre = 1.5 * cell_of(i, 5, 5) + random.vector(-0.2, 0.2);
    const Eigen::Vector3d reach = random.vector(0.02, 0.06);
    const Eigen::Vector3d speed = random.vector(0.05, 0.2);
    scene.bodies.push_back(wobbling(meshes[i % 5 < 4 ? 0 : 1 + i % 2],
                                    {turn, centre, reach, speed, random.between(0, 6), 0.02}));
  }
  return scene;
}

/// Far from each other but for every fortieth, which is moved to its neighbour.
BenchScene lattice() {
  BenchScene scene{"S3", "1,000 surfaces of about 1,000 vertices, 25 pairs touch", 0.04, 16, {}};
  scene.tries_telling = true;
  constexpr double spacing = 3.2;
  Random random(4);
  const auto ball = scenes::mesh_of(models::sphere(40, 25));
  const auto ring = scenes::mesh_of(models::torus(40, 25, 0.7, 0.3));
  for (std::size_t i = 0; i < 1000; ++i) {
    Eigen::Vector3d centre = spacing * cell_of(i, 10, 10);
    const bool is_mover = i % 40 == 5;
    const bool is_met = i % 40 == 6;
    if (is_mover) centre.x() += spacing - 1.97;
    const Eigen::Matrix3d turn = random.turn();
    const double phase = random.between(0, 6);
    scene.bodies.push_back(wobbling(is_mover || is_met || i % 2 == 0 ? ball : ring,
                                    {turn, centre, {0.01, 0.01, 0.01}, {0.2, 0.3, 0.25}, phase, 0.03}));
  }
  return scene;
}

/// Two spheres of about `segments * rings` vertices. Distance and motion are of the size of their edges.
BenchScene spheres(std::string name, std::uint32_t segments, std::uint32_t rings) {
  const double edge = 400.0 / segments;  // in those of the spheres of 100,000
  BenchScene scene{
      std::move(name),
      "2 spheres of " + thousands(std::size_t{segments} * rings) + " vertices with a small contact patch",
      0.02 * edge,
      20,
      {}};
  const auto mesh = scenes::mesh_of(models::sphere(segments, rings));
  for (const double side : {-1.0, 1.0})
    scene.bodies.push_back(wobbling(mesh, {Eigen::Matrix3d::Identity(),
                                           {side * (1 - 0.001 * edge), 0, 0},
                                           {0.002, 0.002, 0.002},
                                           {0.1, 0.13, 0.17},
                                           side,
                                           0.006}));
  return scene;
}

/// Surfaces at one density, however many there are.
BenchScene crowd(std::string name, std::size_t count) {
  BenchScene scene{
      std::move(name), thousands(count) + " surfaces of 258 vertices on a jittered lattice", 0.04, 8, {}};
  constexpr double jitter = 0.328;
  Random random(5);
  const auto mesh = scenes::mesh_of(models::sphere(16, 16));
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(static_cast<double>(count))));
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d centre = 2.55 * cell_of(i, side, side) + random.vector(-jitter, jitter);
    const Eigen::Matrix3d turn = random.turn();
    scene.bodies.push_back(
        wobbling(mesh, {turn, centre, {0.02, 0.02, 0.02}, {0.1, 0.13, 0.16}, random.between(0, 6), 0.02}));
  }
  return scene;
}

}  // namespace

std::vector<std::string_view> scene_names() {
  return {"S1",  "S2",  "S3", "S4",   "S5",   "S6a",  "S6b",   "S6c",    "S7a",   "S7b",    "S7c",
          "S8a", "S8b", "S9", "S10a", "S10b", "G100", "G1000", "G10000", "V1000", "V10000", "V100000"};
}

BenchScene make_scene(std::string_view name, const std::string& data) {
  if (name == "S1") return paths();
  if (name == "S2") return pile();
  if (name == "S3") return lattice();
  if (name == "S4" || name == "V100000") return spheres(std::string(name), 400, 250);
  if (name == "S5" || name == "G10000") return crowd(std::string(name), 10'000);
  if (name == "G100") return crowd("G100", 100);
  if (name == "G1000") return crowd("G1000", 1000);
  if (name == "V1000") return spheres("V1000", 40, 25);
  if (name == "V10000") return spheres("V10000", 125, 80);
  if (name == "S6a") return linked_tori();
  if (name == "S6b") return nested_shells();
  if (name == "S6c") return draped_cloth();
  if (name == "S7a")
    return real_mesh("S7a", "a body and its intestines", data + "/organs/body_large_small_intestine.obj");
  if (name == "S7b")
    return real_mesh("S7b", "an armadillo between rollers",
                     data + "/sequences/armadillo-rollers/frames/326.ply");
  if (name == "S7c")
    return real_mesh("S7c", "a cloth in a funnel", data + "/sequences/cloth-funnel/frames/227.ply");
  if (name == "S8a") return heap(false);
  if (name == "S8b") return heap(true);
  if (name == "S9") return sleepers();
  return landscape(name == "S10b");
}

}  // namespace graze::bench
