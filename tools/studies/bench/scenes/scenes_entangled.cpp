#include <array>
#include <cmath>
#include <numbers>

#include "bench/scenes/scene_makers.hpp"
#include "bench/scenes/wobbling.hpp"
#include "scenes/mesh_of.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

using Vector = Eigen::Vector3d;

std::shared_ptr<const Mesh> scaled_sphere(std::uint32_t segments, std::uint32_t rings, double radius) {
  models::MeshData sphere = models::sphere(segments, rings);
  for (Vector& position : sphere.positions) position *= radius;
  return scenes::mesh_of(sphere);
}

/// The height of a cloth that lies on a ball of radius 1 about the origin, `above` it, and hangs straight
/// down from where it leaves it.
double draped_height(double radius, double above) {
  constexpr double leaves = 0.9;
  const double reach = 1 + above;
  if (radius < leaves) return std::sqrt(reach * reach - radius * radius);
  const double height = std::sqrt(reach * reach - leaves * leaves);
  return height - leaves / height * (radius - leaves);
}

}  // namespace

BenchScene linked_tori() {
  BenchScene scene{"S6a", "a chain of 20 linked tori of 4,000 vertices", 0.04, 60, {}};
  const auto mesh = scenes::mesh_of(models::torus(80, 50, 0.7, 0.2));
  const Eigen::Matrix3d upright = Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitX()).toRotationMatrix();
  for (std::size_t i = 0; i < 20; ++i) {
    const Vector centre(0.995 * static_cast<double>(i), 0, 0);
    scene.bodies.push_back(wobbling(mesh, {i % 2 == 0 ? Eigen::Matrix3d::Identity() : upright,
                                           centre,
                                           {0.02, 0.02, 0.02},
                                           {0.1, 0.13, 0.17},
                                           static_cast<double>(i),
                                           0.02}));
  }
  return scene;
}

BenchScene nested_shells() {
  constexpr double edge = 0.0125;
  BenchScene scene{"S6b", "two nested shells of 100,000 vertices that touch in places", edge, 60, {}};
  scenes::Random random(6);
  for (const double radius : {1.0, 1 - 2 * edge})
    scene.bodies.push_back(
        wobbling(scaled_sphere(400, 250, radius),
                 {random.turn(), Vector::Zero(), Vector::Zero(), Vector::Zero(), 2 * radius, 0.0135}));
  return scene;
}

BenchScene draped_cloth() {
  constexpr double width = 3;
  constexpr std::uint32_t cells = 199;
  BenchScene scene{"S6c", "a cloth of 40,000 vertices over a ball of 10,000", width / cells, 60, {}};
  scene.bodies.push_back(wobbling(scaled_sphere(125, 80, 1), {.wobble = 0.003}));
  const auto cloth = scenes::mesh_of(models::sheet(cells, cells, width, width, models::Faces::triangles));
  const auto place = [cloth](std::size_t frame, std::span<float> out) {
    const auto time = static_cast<double>(frame);
    std::size_t next = 0;
    for (const Vector& rest : cloth->rest()) {
      const double above = 0.012 * (1 + std::sin(0.2 * time + 3 * rest.x() + 2 * rest.y()));
      const double height = draped_height(std::hypot(rest.x(), rest.y()), above);
      for (const double value : {rest.x(), rest.y(), height}) out[next++] = static_cast<float>(value);
    }
    return true;
  };
  scene.bodies.push_back({cloth, place});
  return scene;
}

}  // namespace graze::bench
