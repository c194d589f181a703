// Bodies start inside each other, and part.
//
// Two soft balls: both are solid, so with the detail `nearest` each vertex inside the other ball has a
// contact with the way out, however deep it is. Contacts push out with a speed that is limited. Otherwise
// what starts deep inside would fly apart.
//
// Rigid bars and boxes: where no vertex is inside, nothing says how deep they are. The way out of the pair
// leads them apart. A stake straight through a plank has none, and stays.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>

#include "examples/support/record_option.hpp"
#include "examples/support/rigid_world.hpp"
#include "examples/support/shapes.hpp"
#include "examples/support/world.hpp"

namespace {

constexpr double radius = 0.3;  // m
constexpr int most_frames = 60;
constexpr int steps_per_frame = 5;
constexpr double time_step = 1.0 / 60 / steps_per_frame;  // s

examples::Body ball_at(const Eigen::Vector3d& centre) {
  return examples::soft_ball(moved(examples::ball(radius, 20, 9), centre), centre, 2, 1e-4);
}

/// Counts the contacts whose vertex is inside the other ball.
std::size_t vertices_inside(const graze::FrameReport& report) {
  std::size_t count = 0;
  for (const graze::Contact& contact : report.contacts())
    count += (contact.feature_a.kind == graze::FeatureKind::vertex && contact.side_b == graze::Side::back) ||
             (contact.feature_b.kind == graze::FeatureKind::vertex && contact.side_a == graze::Side::back);
  return count;
}

double deepest(const graze::FrameReport& report) {
  double depth = 0;
  for (const graze::Contact& contact : report.contacts()) depth = std::max(depth, -contact.separation());
  return depth;
}

bool balls_part(int argc, char** argv) {
  examples::WorldSettings settings;
  settings.gravity = 0;
  settings.contacts.recovery_speed = 1;
  examples::World world(settings);
  const examples::Body& left = world.add(ball_at({-radius / 2, 0, 0}));
  const examples::Body& right = world.add(ball_at({radius / 2, 0.05, 0.03}));
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, world.scene());

  graze::ReportHandle report = world.look();
  int frame = 0;
  const auto is_apart = [&] {
    return report->pairs().empty() || report->pairs()[0].inside == graze::Inside::none;
  };
  for (; frame < most_frames && !is_apart(); ++frame) {
    if (frame % 5 == 0)
      std::printf("frame %2d: %3zu vertices inside, %.3f m deep\n", frame, vertices_inside(*report),
                  deepest(*report));
    for (int i = 0; i < steps_per_frame; ++i) world.step(time_step);
    report = world.look();
  }
  const double speed = std::max(left.velocities.back().norm(), right.velocities.back().norm());
  std::printf("soft balls: %s after %d frames, the centre of the faster one moves with %.2f m/s\n",
              is_apart() ? "apart" : "not apart", frame, speed);
  return is_apart() && speed < 2;
}

/// Two boxes in each other. The first one stands, and the other one floats.
struct Sunk {
  const char* name;
  Eigen::Vector3d size_a;  ///< m
  Eigen::Vector3d size_b;  ///< m
  Eigen::Vector3d middle;  ///< of b. That of a is the origin
  double yaw;              ///< of b, in rad
  bool parts;
  double way;  ///< m, the shortest one out
};

/// Returns whether they part, or stay, as they should. Those that part go less than three times the shortest
/// way: a box half in a box turns on its way out.
bool holds(const Sunk& sunk, int argc, char** argv) {
  constexpr int most = 400;
  examples::RigidWorldSettings settings;
  settings.solver.gravity.setZero();
  examples::RigidWorld world(settings);
  world.add(examples::box(sunk.size_a), Eigen::Isometry3d::Identity(), 0);
  world.add(examples::box(sunk.size_b),
            Eigen::Translation3d(sunk.middle) * Eigen::AngleAxisd(sunk.yaw, Eigen::Vector3d::UnitZ()), 500);
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  int frame = 0;
  do world.step();
  while (world.deepest_overlap() > 0 && ++frame < most);
  const graze::rigid::Body& body = world.bodies().back();
  const double way = (body.position - sunk.middle).norm();
  const bool is_apart = frame < most;
  std::printf("%s: %s after %d frames, went %.3f m of %.3f m, moves with %.2f m/s\n", sunk.name,
              is_apart ? "apart" : "not apart", frame, way, sunk.way, world.largest_speed());
  return is_apart == sunk.parts && (!sunk.parts || way < 3 * sunk.way) && world.largest_speed() < 2;
}

}  // namespace

int main(int argc, char** argv) {
  const Eigen::Vector3d crate(0.5, 0.5, 0.5);
  const Eigen::Vector3d plank(1.2, 0.24, 0.1);
  const Eigen::Vector3d bar(1, 0.1, 0.1);
  const Sunk cases[] = {
      {"a box half in a box", crate, crate, {0.25, 0.05, 0.03}, 0, true, 0.25},
      {"a box half in a box, turned", crate, crate, {0.25, 0.05, 0.03}, 0.5, true, 0.4},
      {"a box in a box of one outline", crate, crate, {0, 0, 0.3}, 0, true, 0.2},
      {"a plank in a plank, by 9 of 10 cm", plank, plank, {0, 0, 0.01}, 1.5, true, 0.09},
      {"a bar through a bar, by 9.9 of 10 cm", bar, bar, {0, 0, 0.001}, 1.57, true, 0.099},
      {"a bar through a bar, by all 10 cm", bar, bar, {0, 0, 0}, 1.5, true, 0.1},
      {"a stake through a plank", plank, {0.02, 0.02, 1}, {0.05, 0.03, 0.1}, 0, false, 0.1},
  };
  bool all_hold = balls_part(argc, argv);
  for (const Sunk& sunk : cases) all_hold = holds(sunk, argc, argv) && all_hold;
  std::printf("what started inside something %s\n",
              all_hold ? "parts, where there is a way" : "does not part");
  return all_hold ? 0 : 1;
}
