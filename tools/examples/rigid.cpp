// Puts rigid boxes on slopes and on each other. A box on a slope stays where it is below the angle of
// friction, and slides as fast as it should above it. Stacks of ten stand, however the boxes are turned.
//
// All contacts of the detail `nearest` that carry count, at most eight of a pair. Contacts are found once a
// frame, and the solver cuts the frame into ten substeps.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <graze/graze.hpp>
#include <numbers>
#include <random>

#include "examples/support/record_option.hpp"
#include "examples/support/rigid_world.hpp"
#include "examples/support/shapes.hpp"

namespace {

using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;
constexpr double density = 500;  // kg/m³
constexpr double gap = 0.001;    // m
constexpr int frames_per_second = 60;

/// Returns whether a box stays or slides on a slope as it should, for two seconds.
bool holds_on_slope(double angle, int argc, char** argv) {
  constexpr int frames = 2 * frames_per_second;
  const examples::RigidWorldSettings settings;
  examples::RigidWorld world(settings);
  const Eigen::Isometry3d tilt(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  world.add(examples::floor_box(20, 1), tilt, 0);
  world.add(examples::box({0.2, 0.2, 0.2}), tilt * Eigen::Translation3d(0, 0, 0.1 + gap), density);
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  for (int frame = 0; frame < frames; ++frame) world.step();

  const graze::rigid::Body& box = world.bodies()[1];
  const double pull =
      settings.solver.gravity.norm() * (std::sin(angle) - settings.solver.friction * std::cos(angle));
  const double expected = std::max(0.0, pull) * frames / frames_per_second;
  const Vector3d normal = tilt.linear().col(2);
  const double upright = normal.dot(box.pose().linear().col(2));
  const double moved = (box.position - (0.1 + gap) * normal).norm();
  std::printf("slope of %2.0f degrees: moved %.4f m, upright %.5f, speed %.4f m/s of %.4f m/s\n",
              angle / degree, moved, upright, box.velocity.norm(), expected);
  return upright > 0.9999 && (moved < 0.001) == (expected == 0) &&
         std::abs(box.velocity.norm() - expected) < 0.005;
}

struct Stack {
  const char* name;
  Vector3d size;                       ///< of each box, in m
  std::function<double(int)> yaw;      ///< of a box by its number
  std::function<Vector3d(int)> shift;  ///< sideways
};

/// Returns whether ten boxes stand on each other for ten seconds.
bool holds(const Stack& stack, int argc, char** argv) {
  constexpr int boxes = 10;
  constexpr int frames = 10 * frames_per_second;
  examples::RigidWorld world;
  world.add(examples::floor_box(20, 1), Eigen::Isometry3d::Identity(), 0);
  for (int i = 0; i < boxes; ++i) {
    Vector3d middle = stack.shift(i);
    middle.z() = (i + 0.5) * stack.size.z() + (i + 1) * gap;
    world.add(examples::box(stack.size),
              Eigen::Translation3d(middle) * Eigen::AngleAxisd(stack.yaw(i), Vector3d::UnitZ()), density);
  }
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  const Vector3d start = world.bodies().back().position;
  double deepest = 0;
  double speed = 0;
  std::size_t silent = 0;
  for (int frame = 0; frame < frames; ++frame) {
    world.step();
    deepest = std::max(deepest, world.deepest_overlap());
    silent += world.silent_crossings();
    if (frame >= frames - frames_per_second) speed = std::max(speed, world.largest_speed());
  }
  const Vector3d moved = world.bodies().back().position - start;
  std::printf("%-22s top %6.2f mm lower and %5.2f mm aside, deepest %.2f mm, speed %4.1f mm/s, %zu silent\n",
              stack.name, -1e3 * moved.z(), 1e3 * std::hypot(moved.x(), moved.y()), 1e3 * deepest,
              1e3 * speed, silent);
  return std::abs(moved.z()) < 0.003 && std::hypot(moved.x(), moved.y()) < 0.02 && deepest < 0.001 &&
         speed < 0.05 && silent == 0;
}

/// Returns a function of a box's number that is random, and the same in every run.
std::function<double(int)> random(unsigned seed, double most) {
  return [=](int i) {
    std::mt19937 engine(seed + static_cast<unsigned>(i));
    return most * (2 * static_cast<double>(engine()) / std::mt19937::max() - 1);
  };
}

}  // namespace

int main(int argc, char** argv) {
  const Vector3d crate(0.5, 0.5, 0.5);
  const Vector3d plank(1.2, 0.24, 0.1);
  const auto straight = [](int) { return 0.0; };
  const auto centred = [](int) { return Vector3d(0, 0, 0); };
  const auto shifted = [](int i) { return Vector3d(random(10, 0.04)(i), random(30, 0.04)(i), 0); };
  const Stack stacks[] = {
      {"boxes, one outline", crate, straight, centred},
      {"boxes, shifted", crate, straight, shifted},
      {"boxes, each 2.7 deg", crate, [](int i) { return 2.7 * degree * i; }, centred},
      {"boxes, each 45 deg", crate, [](int i) { return 45 * degree * i; }, centred},
      {"boxes, at random", crate, random(50, 180 * degree), shifted},
      {"planks across planks", plank, [](int i) { return 86 * degree * i; }, centred},
  };
  bool all_hold = true;
  for (const double angle : {20.0, 26.0, 27.0, 32.0})
    all_hold = holds_on_slope(angle * degree, argc, argv) && all_hold;
  for (const Stack& stack : stacks) all_hold = holds(stack, argc, argv) && all_hold;
  std::printf("the boxes %s\n", all_hold ? "stand and slide as they should" : "do not behave");
  return all_hold ? 0 : 1;
}
