#include "bench/soft_bodies/soft_body_scenes.hpp"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "examples/support/body.hpp"
#include "examples/support/shapes.hpp"

namespace graze::bench {
namespace {

constexpr int balls = 20;
constexpr double ball_radius = 0.1;  // m
constexpr double bowl_radius = 0.8;  // m, of the hollow
constexpr double tray_width = 0.8;   // m, of the hollow
constexpr double wall_thickness = 0.3;

std::vector<SoftBodyKind> fill_with_cloth(examples::World& world) {
  world.add(examples::fixed_body(examples::ball(0.3, 32, 15)));
  world.add(examples::cloth(moved(examples::sheet(1.2, 40), {0.05, 0, 0.35}), 0.3));
  return {SoftBodyKind::ball, SoftBodyKind::deformable};
}

/// Drags the ball to the side while the cloth lies on it.
void drag_ball(examples::World& world, std::size_t frame) {
  examples::Body& ball = world.bodies().front();
  const bool is_dragged = frame >= 150 && frame < 210;
  ball.velocities.assign(ball.velocities.size(), Eigen::Vector3d(is_dragged ? 0.1 : 0, 0, 0));
}

void add_ball(examples::World& world, const Eigen::Vector3d& centre) {
  world.add(examples::soft_ball(moved(examples::ball(ball_radius, 12, 8), centre), centre, 0.5, 1e-4));
}

/// Places balls in layers of ten above the bowl, each layer turned against the one below.
Eigen::Vector3d start_above_bowl(int index) {
  const int layer = index / 10;
  const double angle = 2 * std::numbers::pi * (index % 10) / 8 + 0.3 * layer;
  const double from_axis = index % 10 < 8 ? 0.45 : index % 10 == 8 ? 0.12 : -0.12;
  return {from_axis * std::cos(angle), from_axis * std::sin(angle), 0.25 * (layer + 1)};
}

/// Places balls in layers of nine above the tray, each layer to the side of the one below.
Eigen::Vector3d start_above_tray(int index) {
  const int layer = index / 9;
  const int column = index % 3 - 1;
  const int row = index / 3 % 3 - 1;
  return {0.24 * column + 0.04 * (layer - 1), 0.24 * row - 0.03 * (layer - 1), 0.2 + 0.25 * layer};
}

/// The bowl is immovable, but no shape that a library calculates with.
std::vector<SoftBodyKind> fill_bowl(examples::World& world) {
  world.add(examples::fixed_body(examples::bowl(bowl_radius, 0.1, 32, 8)));
  std::vector<SoftBodyKind> kinds{SoftBodyKind::deformable};
  for (int i = 0; i < balls; ++i) add_ball(world, start_above_bowl(i));
  kinds.resize(kinds.size() + balls, SoftBodyKind::deformable);
  return kinds;
}

examples::Shape box(const Eigen::Vector3d& centre, const Eigen::Vector3d& size) {
  examples::Shape shape = examples::floor_box(1, 1);
  for (Eigen::Vector3d& point : shape.points)
    point = centre + (point + Eigen::Vector3d(0, 0, 0.5)).cwiseProduct(size);
  return shape;
}

std::vector<SoftBodyKind> fill_tray(examples::World& world) {
  const double outer = tray_width + 2 * wall_thickness;
  const double middle = (tray_width + wall_thickness) / 2;  // of a wall, from the axis
  world.add(examples::fixed_body(box({0, 0, -wall_thickness / 2}, {outer, outer, wall_thickness})));
  for (const double side : {-middle, middle}) {
    world.add(examples::fixed_body(box({side, 0, 0.5}, {wall_thickness, tray_width, 1})));
    world.add(examples::fixed_body(box({0, side, 0.5}, {outer, wall_thickness, 1})));
  }
  std::vector<SoftBodyKind> kinds(5, SoftBodyKind::box);
  for (int i = 0; i < balls; ++i) add_ball(world, start_above_tray(i));
  kinds.resize(kinds.size() + balls, SoftBodyKind::deformable);
  return kinds;
}

std::vector<SoftBodyKind> fill_with_entangled(examples::World& world) {
  const double radius = 0.3;
  for (const Eigen::Vector3d& centre :
       {Eigen::Vector3d(-radius / 2, 0, 0), Eigen::Vector3d(radius / 2, 0.05, 0.03)})
    world.add(examples::soft_ball(moved(examples::ball(radius, 20, 9), centre), centre, 2, 1e-4));
  return {SoftBodyKind::deformable, SoftBodyKind::deformable};
}

/// Below the lowest place of a corner of the cloth that hangs from the ball.
bool is_below_cloth(const Eigen::Vector3d& point) {
  return point.z() < -1;
}

/// In the bowl's wall, under it or beside it.
bool is_out_of_bowl(const Eigen::Vector3d& point) {
  return point.norm() > bowl_radius && (point.z() < 0 || point.head<2>().norm() > bowl_radius);
}

bool is_out_of_tray(const Eigen::Vector3d& point) {
  return point.z() < 0 || point.head<2>().cwiseAbs().maxCoeff() > tray_width / 2;
}

SoftBodyScene scene_of_balls() {
  SoftBodyScene scene;
  scene.settings.contact_distance = 0.015;
  scene.settings.substeps = 5;
  scene.steps_per_frame = 2;
  return scene;
}

}  // namespace

SoftBodyScene with_steps(SoftBodyScene scene, int steps_per_frame) {
  scene.settings.substeps = scene.settings.substeps * scene.steps_per_frame / steps_per_frame;
  scene.steps_per_frame = steps_per_frame;
  return scene;
}

SoftBodyScene cloth_on_ball() {
  SoftBodyScene scene;
  scene.name = "cloth on a ball";
  scene.settings.contact_distance = 0.04;
  scene.settings.contacts.gap = 0.005;
  scene.settings.contacts.friction = 0.5;
  scene.settings.damping = 1;
  scene.settings.substeps = 5;
  scene.settings.iterations = 3;
  scene.fill = fill_with_cloth;
  scene.lead = drag_ball;
  scene.is_out = is_below_cloth;
  scene.margins = {0.02, 0.04};
  return scene;
}

SoftBodyScene balls_in_bowl() {
  SoftBodyScene scene = scene_of_balls();
  scene.name = "20 soft balls in a bowl";
  scene.fill = fill_bowl;
  scene.is_out = is_out_of_bowl;
  return scene;
}

SoftBodyScene balls_in_tray() {
  SoftBodyScene scene = scene_of_balls();
  scene.name = "20 soft balls in a tray";
  scene.fill = fill_tray;
  scene.is_out = is_out_of_tray;
  return scene;
}

SoftBodyScene balls_inside_each_other() {
  SoftBodyScene scene;
  scene.name = "two soft balls inside each other";
  scene.settings.gravity = 0;
  scene.steps_per_frame = 5;
  scene.fill = fill_with_entangled;
  return scene;
}

}  // namespace graze::bench
