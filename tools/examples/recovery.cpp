// Two soft balls start half inside each other, and part. Both are solid, so with the detail `nearest` each
// vertex inside the other ball has a contact with the way out, however deep it is.
//
// Contacts push out with a speed that is limited. Otherwise what starts deep inside would fly apart.

#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>

#include "examples/support/record_option.hpp"
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

}  // namespace

int main(int argc, char** argv) {
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
  std::printf("%s after %d frames, the centre of the faster ball moves with %.2f m/s\n",
              is_apart() ? "apart" : "not apart", frame, speed);
  return is_apart() && speed < 2 ? 0 : 1;
}
