// Crates and logs fall from the air into a heap. None passes through another, and none stays in another. The
// heap comes to rest.
//
// What falls comes nearer by up to 7 cm in 1/120 s. So the contact distance is 8 cm, and contacts are found
// twice a frame. All of them count: those that carry a body now are not those that stop it next.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdio>
#include <graze/graze.hpp>
#include <random>

#include "examples/support/record_option.hpp"
#include "examples/support/rigid_world.hpp"
#include "examples/support/shapes.hpp"

namespace {

using Eigen::Vector3d;

constexpr double density = 500;  // kg/m³
constexpr double time_step = 1.0 / 120;

examples::RigidWorldSettings settings() {
  examples::RigidWorldSettings settings;
  settings.contact_distance = 0.08;
  settings.carrying = 0;
  settings.solver.substeps = 5;
  return settings;
}

/// Returns a number between -most and most.
double random(std::mt19937& engine, double most) {
  return most * (2 * static_cast<double>(engine()) / std::mt19937::max() - 1);
}

Eigen::Quaterniond random_turn(std::mt19937& engine) {
  Eigen::Quaterniond turn{random(engine, 1), random(engine, 1), random(engine, 1), random(engine, 1)};
  return turn.normalized();
}

void add_crates(examples::RigidWorld& world) {
  std::mt19937 engine(5);
  for (int layer = 0; layer < 6; ++layer)
    for (int row = 0; row < 5; ++row)
      for (int column = 0; column < 5; ++column) {
        const Eigen::Translation3d middle(0.75 * column, 0.75 * row, 0.5 + 0.75 * layer);
        world.add(examples::box({0.5, 0.4, 0.3}), middle * random_turn(engine), density);
      }
}

/// A log that lies along x.
examples::Shape log(double radius, double length) {
  const std::array<Eigen::Vector2d, 4> line{
      {{0, -length / 2}, {radius, -length / 2}, {radius, length / 2}, {0, length / 2}}};
  examples::Shape shape = examples::revolved(line, 16);
  for (Vector3d& point : shape.points) point = Vector3d(point.z(), point.y(), -point.x());
  return shape;
}

void add_logs(examples::RigidWorld& world) {
  std::mt19937 engine(7);
  for (int layer = 0; layer < 6; ++layer)
    for (int column = 0; column < 5; ++column) {
      const Eigen::Translation3d middle(0, 0.4 * column, 0.2 + 0.35 * layer);
      const Eigen::AngleAxisd yaw(random(engine, 0.1), Vector3d::UnitZ());
      world.add(log(0.12, 1.2), middle * yaw * Eigen::AngleAxisd(random(engine, 0.1), Vector3d::UnitY()),
                density);
    }
}

bool holds(const char* name, void (*add)(examples::RigidWorld&), int frames, int argc, char** argv) {
  examples::RigidWorld world(settings());
  world.add(examples::floor_box(40, 2), Eigen::Isometry3d::Identity(), 0);
  add(world);
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  double deepest = 0;
  std::size_t silent = 0;
  for (int frame = 0; frame < frames; ++frame) {
    for (int i = 0; i < 2; ++i) {
      world.step(time_step);
      silent += world.silent_crossings();
    }
    if (frame % 10 == 9) deepest = std::max(deepest, world.deepest_overlap());
  }
  std::size_t crossing = 0;
  for (const graze::PairReport& pair : world.report().pairs())
    crossing += pair.inside == graze::Inside::crossing;
  std::size_t resting = 0;
  for (const graze::rigid::Body& body : world.bodies()) resting += body.velocity.norm() < 0.05;
  std::printf(
      "%zu %s after %d frames: %zu of %zu pairs cross, deepest ever %.1f mm, %zu at rest, %zu silent\n",
      world.bodies().size() - 1, name, frames, crossing, world.report().pairs().size(), 1e3 * deepest,
      resting - 1, silent);
  return crossing == 0 && deepest < 0.01 && silent == 0 && resting >= world.bodies().size() * 8 / 10;
}

}  // namespace

int main(int argc, char** argv) {
  const bool crates = holds("crates", add_crates, 270, argc, argv);
  const bool logs = holds("logs", add_logs, 200, argc, argv);
  std::printf("the heaps %s\n", crates && logs ? "are whole" : "are not as they should be");
  return crates && logs ? 0 : 1;
}
