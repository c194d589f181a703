// A crate slides over tiles that lie side by side, without friction. Each tile is an object of its own, and a
// solid. Their inner walls are hidden, so that the crate does not stumble over the edges between them. It
// loses less than 2 % of its speed.
//
// A second crate is moved by hand into a crate of the same height, with the loop of the README. It is
// stopped.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <vector>

#include "examples/support/record_option.hpp"
#include "examples/support/rigid_world.hpp"
#include "examples/support/shapes.hpp"

namespace {

using Eigen::Vector3d;

constexpr int tiles = 12;
constexpr double tile_width = 0.5;  // m
constexpr std::uint8_t wall = 1;    // the group of hidden faces

/// The two triangles of each wall of examples::box(), from -y to +x, and whether another tile lies behind it.
std::vector<std::uint8_t> groups_of(int column) {
  const bool is_hidden[] = {false, false, column > 0, column < tiles - 1};
  std::vector<std::uint8_t> groups(12, 0);
  for (std::size_t i = 0; i < 4; ++i)
    if (is_hidden[i]) groups[4 + 2 * i] = groups[5 + 2 * i] = wall;
  return groups;
}

struct Slide {
  double slowest = 0;  ///< m/s along x
  double aside = 0;    ///< m/s across, at most
  double highest = 0;  ///< m, how far from its height at most
};

Slide slide(bool has_hidden_walls, double yaw, int argc, char** argv) {
  constexpr double speed = 3;
  examples::RigidWorldSettings settings;
  settings.contact_distance = 0.03;
  settings.solver.friction = 0;
  examples::RigidWorld world(settings);
  for (int column = 0; column < tiles; ++column) {
    graze::ObjectSettings object;
    object.face_groups = groups_of(column);
    if (has_hidden_walls) object.hidden_groups = {wall};
    world.add(examples::box({tile_width, 2, 0.2}),
              Eigen::Isometry3d(Eigen::Translation3d(tile_width * column, 0, -0.1)), 0, object);
  }
  const double height = 0.15 + settings.solver.gap;
  const auto crate =
      world.add(examples::box({0.4, 0.4, 0.3}),
                Eigen::Translation3d(0, 0.07, height) * Eigen::AngleAxisd(yaw, Vector3d::UnitZ()), 500);
  world.bodies()[crate].velocity = {speed, 0, 0};
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  Slide worst{speed};
  for (int frame = 0; frame < 100; ++frame) {  // 5 m
    world.step();
    const graze::rigid::Body& body = world.bodies()[crate];
    worst.slowest = std::min(worst.slowest, body.velocity.x());
    worst.aside = std::max(worst.aside, std::abs(body.velocity.y()));
    worst.highest = std::max(worst.highest, std::abs(body.position.z() - height));
  }
  return worst;
}

bool keeps_its_speed(int argc, char** argv) {
  bool holds = true;
  for (const double yaw : {0.0, 0.3}) {
    const Slide open = slide(false, yaw, argc, argv);
    const Slide hidden = slide(true, yaw, argc, argv);
    std::printf(
        "turned by %.1f: slowest %.4f m/s, %.4f m/s aside, %.2f mm off; with walls that are seen %.4f, %.4f, "
        "%.2f\n",
        yaw, hidden.slowest, hidden.aside, 1e3 * hidden.highest, open.slowest, open.aside,
        1e3 * open.highest);
    holds = holds && hidden.slowest > 2.95 && hidden.aside < 0.001 && hidden.highest < 0.008;
  }
  return holds;
}

/// Moves a crate by `pace` a step towards another, and pushes it out by the longest push. Returns whether it
/// is stopped. Both are 1 m wide, and the other one is at the origin.
bool walk(double pace, double aside, double lift) {
  constexpr double contact_distance = 0.05;
  graze::Scene scene({.contact_distance = contact_distance,
                      .detail = graze::ContactDetail::nearest,
                      .threads = 1,
                      .ways_out = true});
  const examples::Shape shape = examples::box({1, 1, 1});
  const auto mesh =
      std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles));
  scene.add(mesh, {.name = "wall", .motion = graze::Motion::fixed, .solid = true});
  const graze::ObjectId crate =
      scene.add(mesh, {.name = "crate", .motion = graze::Motion::rigid, .solid = true});
  Eigen::Isometry3d pose(Eigen::Translation3d(1.3, aside, lift));
  for (int step = 0; step < 200; ++step) {
    pose.translation().x() -= pace;
    scene.set_pose(crate, pose);
    const graze::ReportHandle report = scene.step();
    Vector3d push = Vector3d::Zero();
    for (const graze::PairReport& pair : report->pairs()) {
      for (const graze::Contact& contact : report->contacts(pair)) {
        const double missing = contact_distance - contact.separation();
        if (missing > push.norm()) push = missing * contact.push();
      }
      const graze::WayOut& out = pair.way_out;  // counts where no contact is a quarter as deep
      if (!out.direction.isZero() && push.norm() < contact_distance + out.thickness / 4)
        push = (contact_distance + out.thickness) * out.direction;
    }
    pose.translation() += push;
  }
  const Vector3d place = pose.translation();
  const bool is_stopped = place.x() > 1 && std::abs(place.y()) < 0.5 && std::abs(place.z()) < 0.5;
  std::printf("walks %.0f cm a step, %.1f m aside, %.2f m higher: ends at (%.3f %.3f %.3f)\n", 1e2 * pace,
              aside, lift, place.x(), place.y(), place.z());
  return is_stopped;
}

bool is_stopped() {
  bool holds = true;
  for (const double pace : {0.04, 0.08})
    for (const double aside : {0.0, 0.3})
      for (const double lift : {0.0, 0.02}) holds = walk(pace, aside, lift) && holds;
  return holds;
}

}  // namespace

int main(int argc, char** argv) {
  const bool slides = keeps_its_speed(argc, argv);
  const bool stops = is_stopped();
  std::printf("the crate %s, and the other one %s\n", slides ? "slides" : "stumbles",
              stops ? "is stopped" : "passes through");
  return slides && stops ? 0 : 1;
}
