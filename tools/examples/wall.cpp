// A crate is moved by hand into another one of the same height, with the loop of the README. It is stopped,
// with 4 cm and 8 cm a step, although both may share planes.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>

#include "examples/support/record_option.hpp"
#include "examples/support/shapes.hpp"

namespace {

using Eigen::Vector3d;

/// Moves a crate by `pace` a step towards another, and pushes it out by the longest push. Returns whether it
/// is stopped. Both are 1 m wide, and the other one is at the origin.
bool walk(double pace, double aside, double lift, int argc, char** argv) {
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
  const auto recorder = examples::recorder_by_options(argc, argv, scene);
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

bool is_stopped(int argc, char** argv) {
  bool holds = true;
  for (const double pace : {0.04, 0.08})
    for (const double aside : {0.0, 0.3})
      for (const double lift : {0.0, 0.02}) holds = walk(pace, aside, lift, argc, argv) && holds;
  return holds;
}

}  // namespace

int main(int argc, char** argv) {
  const bool stops = is_stopped(argc, argv);
  std::printf("the crate %s\n", stops ? "is stopped" : "passes through");
  return stops ? 0 : 1;
}
