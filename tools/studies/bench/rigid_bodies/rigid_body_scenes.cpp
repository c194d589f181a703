#include "bench/rigid_bodies/rigid_body_scenes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <memory>
#include <numbers>
#include <utility>

#include "rigid/solver.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

using Eigen::Vector3d;

constexpr double start_gap = 0.002;  // m, between bodies that are put on each other

Eigen::Isometry3d upright(const Vector3d& position, double yaw) {
  return Eigen::Translation3d(position) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ());
}

void add(RigidBodyScene& scene, const RigidBodyShapePtr& shape, const Eigen::Isometry3d& pose) {
  rigid::Body& body = scene.bodies.emplace_back();
  body.set_pose(pose);
  if (scene.bodies.size() > 1) body.set_mass(shape->mass);
  scene.shapes.push_back(shape);
}

RigidBodyScene on_floor(std::string name, std::size_t steps) {
  RigidBodyScene scene;
  scene.name = std::move(name);
  scene.steps = steps;
  add(scene, box_shape({10, 10, 0.5}), upright({0, 0, -0.5}, 0));
  return scene;
}

/// The height of the middle of what stands on `below` others of half a height. The solver keeps them apart.
double standing_height(std::size_t below, double half) {
  const double gap = rigid::SolverSettings().gap;
  return gap + half + static_cast<double>(below) * (gap + 2 * half);
}

/// How a crate stands on the one below, by its number from the floor up. The height of the pose is 0.
using Placement = std::function<Eigen::Isometry3d(std::size_t crate)>;

RigidBodyScene stack(const std::string& placed, bool is_quick, const Placement& place) {
  constexpr double half = 0.25;
  RigidBodyScene scene =
      is_quick ? on_floor("three crates, " + placed, 90) : on_floor("ten crates, " + placed, 600);
  const RigidBodyShapePtr crate = box_shape({half, half, half});
  double base = 0;
  for (std::size_t i = 0; i < (is_quick ? 3U : 10U); ++i) {
    const Eigen::Isometry3d pose = place(i);
    // A tilted crate is higher than an upright one.
    const double reach = pose.linear().row(2).cwiseAbs().sum() * half;
    add(scene, crate, Eigen::Translation3d(0, 0, base + start_gap + reach) * pose);
    base += start_gap + 2 * reach;
    scene.heights.push_back(standing_height(i, half));
  }
  return scene;
}

std::vector<RigidBodyScene> stacks(bool is_quick) {
  std::vector<RigidBodyScene> scenes;
  const auto add_stack = [&](const char* placed, const Placement& place) {
    scenes.push_back(stack(placed, is_quick, place));
  };
  add_stack("one outline", [](std::size_t) { return upright({0, 0, 0}, 0); });
  add_stack("shifted", [](std::size_t i) {
    return upright({i % 2 == 0 ? 0 : 0.06, i % 3 == 0 ? 0 : 0.04, 0}, 0);
  });
  add_stack("turned by 2.7°", [](std::size_t i) {
    return upright({0, 0, 0}, 0.047 * static_cast<double>(i));
  });
  add_stack("turned by 45°", [](std::size_t i) {
    return upright({0, 0, 0}, std::numbers::pi / 4 * static_cast<double>(i));
  });
  scenes::Random random(1);
  add_stack("at random", [&](std::size_t) {
    const double x = random.between(-0.05, 0.05);
    const double y = random.between(-0.05, 0.05);
    return upright({x, y, 0}, random.between(0, 2 * std::numbers::pi));
  });
  add_stack("slightly tilted", [](std::size_t i) {
    const Vector3d axis = Vector3d(1, 0.6, 0).normalized();
    return Eigen::Isometry3d(Eigen::AngleAxisd(i % 2 == 0 ? 0.005 : -0.005, axis));
  });
  return scenes;
}

/// Two planks in each layer, across those below.
RigidBodyScene planks(bool is_quick) {
  const Vector3d half(0.6, 0.12, 0.05);
  RigidBodyScene scene = on_floor("planks across planks", is_quick ? 60 : 600);
  const RigidBodyShapePtr plank = box_shape(half);
  for (std::size_t layer = 0; layer < (is_quick ? 2U : 10U); ++layer)
    for (const double side : {-0.4, 0.4}) {
      const auto below = static_cast<double>(layer);
      const Eigen::Isometry3d turned =
          upright({0, 0, start_gap + half.z() + below * (start_gap + 2 * half.z())}, 1.5 * below);
      add(scene, plank, turned * Eigen::Translation3d(0, side, 0));
      scene.heights.push_back(standing_height(layer, half.z()));
    }
  return scene;
}

/// Bodies in layers of `wide` by `wide`, turned at random, which fall onto the floor and each other.
void drop(RigidBodyScene& scene, const std::vector<RigidBodyShapePtr>& shapes, std::size_t count,
          std::size_t wide, double spacing) {
  scenes::Random random(2);
  const auto place = [&](std::size_t index) {
    return spacing * (static_cast<double>(index) - 0.5 * static_cast<double>(wide - 1)) +
           random.between(-0.05, 0.05);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const double x = place(i % wide);
    const double y = place(i / wide % wide);
    const Vector3d position(x, y, spacing * static_cast<double>(1 + i / wide / wide));
    add(scene, shapes[i % shapes.size()], Eigen::Translation3d(position) * Eigen::Isometry3d(random.turn()));
  }
}

RigidBodyScene pile(bool is_quick) {
  RigidBodyScene scene = on_floor("150 crates fall", is_quick ? 45 : 480);
  if (is_quick) scene.name = "12 crates fall";
  std::vector<RigidBodyShapePtr> crates;
  for (const double half : {0.25, 0.2, 0.15}) crates.push_back(box_shape({half, 0.9 * half, 0.8 * half}));
  drop(scene, crates, is_quick ? 12 : 150, is_quick ? 2 : 5, 0.65);
  return scene;
}

RigidBodyScene heap_of_bodies(bool is_quick) {
  RigidBodyScene scene = on_floor("L shapes, rings and pawns fall", is_quick ? 60 : 360);
  drop(scene, {l_shape(), ring_shape(), pawn_shape()}, is_quick ? 4 : 36, is_quick ? 1 : 3, 0.7);
  return scene;
}

}  // namespace

bool RigidBodyScene::is_convex() const {
  return std::ranges::all_of(shapes, [](const auto& shape) { return shape->plain.parts.size() == 1; });
}

std::vector<RigidBodyScene> rigid_body_scenes(bool is_quick) {
  std::vector<RigidBodyScene> scenes = stacks(is_quick);
  scenes.push_back(planks(is_quick));
  scenes.push_back(pile(is_quick));
  scenes.push_back(heap_of_bodies(is_quick));
  return scenes;
}

}  // namespace graze::bench
