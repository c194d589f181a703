#include "bench/scenes.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "models/models.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

using scenes::Random;

std::shared_ptr<const Mesh> mesh_of(const models::MeshData& data) {
  return std::make_shared<const Mesh>(
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts)));
}

/// S1: five tori and five pawns whose paths cross.
BenchScene paths() {
  BenchScene scene{"paths", 0.05, 300, 0.03, {}};
  Random random(1);
  const std::array meshes{mesh_of(models::torus()), mesh_of(models::pawn())};
  for (std::size_t i = 0; i < 10; ++i)
    scene.bodies.push_back({meshes[i % 2], random.turn(), random.vector(-1, 1), random.vector(0.8, 1.6),
                            random.vector(0.01, 0.03), random.between(0, 6)});
  return scene;
}

/// Two tori and two pawns that stay in contact.
BenchScene contact() {
  BenchScene scene{"contact", 0.05, 40, 0.02, {}};
  const std::array meshes{mesh_of(models::torus()), mesh_of(models::pawn())};
  const std::array<Eigen::Vector3d, 4> centres{
      {{0, 0, 0}, {-0.7, -0.7, 0.3}, {1.4, 0.3, 0.1}, {0.7, -0.9, 0.2}}};
  Random random(2);
  for (std::size_t i = 0; i < centres.size(); ++i)
    scene.bodies.push_back(
        {meshes[i % 2], random.turn(), centres[i], {0.03, 0.03, 0.03}, random.vector(0.1, 0.2), 0});
  return scene;
}

/// S2: a loose pile of a hundred surfaces of about 1,000 vertices, nearly everything near something.
BenchScene pile() {
  BenchScene scene{"pile", 0.04, 40, 0.02, {}};
  Random random(3);
  const std::array meshes{mesh_of(models::torus(40, 25, 0.7, 0.3)), mesh_of(models::torus()),
                          mesh_of(models::sphere(40, 25))};
  for (std::size_t i = 0; i < 100; ++i) {
    const Eigen::Vector3d cell(static_cast<double>(i % 5), static_cast<double>(i / 5 % 5),
                               static_cast<double>(i / 25));
    scene.bodies.push_back({meshes[i % 5 < 4 ? 0 : 1 + i % 2], random.turn(),
                            1.35 * cell + random.vector(-0.2, 0.2), random.vector(0.02, 0.06),
                            random.vector(0.05, 0.2), random.between(0, 6)});
  }
  return scene;
}

/// S4: two spheres of 100,000 vertices that touch.
BenchScene spheres() {
  BenchScene scene{"spheres", 0.02, 10, 0.006, {}};
  const auto mesh = mesh_of(models::sphere(400, 250));
  for (const double side : {-1.0, 1.0})
    scene.bodies.push_back({mesh,
                            Eigen::Matrix3d::Identity(),
                            {side * 0.999, 0, 0},
                            {0.002, 0.002, 0.002},
                            {0.1, 0.13, 0.17},
                            side});
  return scene;
}

}  // namespace

std::vector<std::string_view> scene_names() {
  return {"paths", "contact", "pile", "spheres"};
}

BenchScene make_scene(std::string_view name) {
  if (name == "paths") return paths();
  if (name == "contact") return contact();
  if (name == "pile") return pile();
  if (name == "spheres") return spheres();
  return {};
}

void place(const BenchScene& scene, const Body& body, std::size_t frame,
           std::vector<Eigen::Vector3f>& positions) {
  const double time = static_cast<double>(frame);
  Eigen::Vector3d centre = body.centre;
  for (int axis = 0; axis < 3; ++axis)
    centre[axis] += body.path[axis] * std::sin(body.speed[axis] * time + body.phase + axis);
  const auto rest = body.mesh->rest();
  positions.resize(rest.size());
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double swell = 1 + scene.wobble * std::sin(0.3 * time + body.phase + 5 * rest[i].z());
    positions[i] = (body.turn * (swell * rest[i]) + centre).cast<float>();
  }
}

}  // namespace graze::bench
