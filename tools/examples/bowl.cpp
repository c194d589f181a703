// Drops 50 soft balls of 98 vertices into a bowl, or as many as `--balls N` says, with XPBD. None of them
// goes through it, and their energy falls.
//
// The bowl is a closed shell with a thickness, and solid. So a vertex that a fast ball drives into the wall
// has a way out, and graze knows the side of every vertex exactly. Of an open surface it only knows the side
// on which a vertex lies now: what has got through is taken for what came from there.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <graze/graze.hpp>
#include <memory>
#include <numbers>
#include <string>

#include "examples/support/record_option.hpp"
#include "examples/support/world.hpp"

namespace {

constexpr double bowl_radius = 0.8;  // m, of the hollow
constexpr double bowl_thickness = 0.1;
constexpr double ball_radius = 0.1;
constexpr int frames = 600;
constexpr int steps_per_frame = 2;
constexpr double time_step = 1.0 / 60 / steps_per_frame;  // s
constexpr double gravity = 9.81;

/// Places balls in layers of ten above the bowl, each layer turned against the one below.
Eigen::Vector3d start_of(int index) {
  const int layer = index / 10;
  const double angle = 2 * std::numbers::pi * (index % 10) / 8 + 0.3 * layer;
  const double from_axis = index % 10 < 8 ? 0.45 : index % 10 == 8 ? 0.12 : -0.12;
  return {from_axis * std::cos(angle), from_axis * std::sin(angle), 0.25 * (layer + 1)};
}

double total_energy(const examples::World& world) {
  double sum = 0;
  for (const examples::Body& body : world.bodies()) sum += examples::energy(body, gravity);
  return sum;
}

/// Counts vertices that are not over the bowl: in its wall, under it, or beside it.
std::size_t vertices_out(const examples::World& world) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < world.bodies().size(); ++i)
    for (const Eigen::Vector3d& point : world.bodies()[i].positions)
      count += point.norm() > bowl_radius && (point.z() < 0 || point.head<2>().norm() > bowl_radius);
  return count;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = examples::take_option("--balls", argc, argv);
  const int balls = wanted.empty() ? 50 : std::atoi(wanted.c_str());
  examples::WorldSettings settings;
  settings.contact_distance = 0.015;
  settings.gravity = gravity;
  settings.substeps = 5;
  examples::World world(settings);
  world.add(examples::fixed_body(examples::bowl(bowl_radius, bowl_thickness, 32, 8)));
  for (int i = 0; i < balls; ++i) {
    const Eigen::Vector3d start = start_of(i);
    world.add(examples::soft_ball(moved(examples::ball(ball_radius, 12, 8), start), start, 0.5, 1e-4));
  }
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, world.scene());

  bool falls = true;
  double lowest_energy = total_energy(world);
  for (int frame = 0; frame < frames; ++frame) {
    graze::ReportHandle report;
    for (int i = 0; i < steps_per_frame; ++i) report = world.step(time_step);
    if (frame % 60 != 59) continue;
    const double energy = total_energy(world);
    falls = falls && energy < lowest_energy + 0.1;  // the heap trembles a little when it lies still
    lowest_energy = std::min(lowest_energy, energy);
    double deepest = 0;
    for (const graze::Contact& contact : report->contacts())
      deepest = std::max(deepest, -contact.separation());
    std::printf("frame %3d: energy %8.3f J, %4zu pairs, %5zu contacts, %.4f m deep, %zu vertices out\n",
                frame + 1, energy, report->pairs().size(), report->contacts().size(), deepest,
                vertices_out(world));
  }
  const std::size_t out = vertices_out(world);
  std::printf("%zu vertices have left the bowl, the energy %s\n", out, falls ? "falls" : "rises");
  return out == 0 && falls ? 0 : 1;
}
