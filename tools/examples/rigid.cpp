// Puts rigid boxes on a plane, with sequential impulses. A stack of five comes to rest upright. A box on a
// slope stays where it is below the angle of friction, and slides as fast as it should above it.
//
// At most four contacts of a pair count. They are chosen anew in each step.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "examples/support/manifold.hpp"
#include "examples/support/record_option.hpp"
#include "examples/support/rigid_body.hpp"
#include "examples/support/shapes.hpp"

namespace {

using Eigen::Vector3d;
using examples::RigidBody;
using examples::RigidContact;

constexpr double size = 0.2;             // m, of a box; its mass is 1 kg
constexpr double time_step = 1.0 / 240;  // s
constexpr int steps = 480;
constexpr int iterations = 30;
constexpr double gravity = 9.81;
constexpr examples::RigidContactSettings contact_settings;

class World {
 public:
  /// The ground is tilted about the y axis. Boxes lie on it, one on top of the other.
  World(double slope, int boxes) : scene_(settings()) {
    const Eigen::Isometry3d tilt(Eigen::AngleAxisd(slope, Vector3d::UnitY()));
    bodies_.push_back(add(examples::floor_box(20, 1), tilt, 0));
    for (int i = 0; i < boxes; ++i) {
      const Vector3d middle(0.01 * (i % 2), 0.015 * (i % 3), size / 2 + 0.005 + i * (size + 0.005));
      bodies_.push_back(add(moved(examples::floor_box(size, size), {0, 0, size / 2}),
                            tilt * Eigen::Translation3d(middle), 1));
    }
  }

  void step() {
    const graze::ReportHandle report = scene_.step();
    for (RigidBody& body : bodies_)
      if (body.inverse_mass > 0) body.velocity.z() -= gravity * time_step;
    std::vector<RigidContact> contacts;
    for (const graze::PairReport& pair : report->pairs())
      for (const graze::Contact& contact : examples::manifold(report->contacts(pair)))
        contacts.emplace_back(bodies_[pair.user_data_a], bodies_[pair.user_data_b], contact, contact_settings,
                              time_step);
    for (int i = 0; i < iterations; ++i)
      for (RigidContact& contact : contacts) contact.solve();
    for (RigidBody& body : bodies_) {
      body.move(time_step);
      scene_.set_pose(body.id, body.pose);
    }
  }

  [[nodiscard]] graze::Scene& scene() { return scene_; }
  [[nodiscard]] const std::vector<RigidBody>& bodies() const { return bodies_; }

 private:
  static graze::SceneSettings settings() {
    graze::SceneSettings settings;
    settings.contact_distance = 0.02;
    settings.detail = graze::ContactDetail::nearest;
    settings.threads = 1;
    return settings;
  }
  RigidBody add(const examples::Shape& shape, const Eigen::Isometry3d& pose, double mass) {
    graze::ObjectSettings object;
    object.motion = mass > 0 ? graze::Motion::rigid : graze::Motion::fixed;
    object.solid = true;
    object.user_data = bodies_.size();
    RigidBody body;
    body.id = scene_.add(
        std::make_shared<const graze::Mesh>(graze::Mesh::from_triangles(shape.points, shape.triangles)),
        object);
    body.pose = pose;
    body.inverse_mass = mass > 0 ? 1 / mass : 0;
    body.inverse_inertia = 6 * body.inverse_mass / (size * size);  // of a cube
    scene_.set_pose(body.id, pose);
    return body;
  }

  graze::Scene scene_;
  std::vector<RigidBody> bodies_;
};

struct Outcome {
  double moved = 0;    ///< how far the top box has come since it had settled, after half a second
  double upright = 0;  ///< 1 where it stands square on the slope
  double speed = 0;
};

Outcome play(double slope, int boxes, int argc, char** argv) {
  World world(slope, boxes);
  const auto recorder = examples::recorder_by_options(argc, argv, world.scene());
  Vector3d settled = Vector3d::Zero();
  for (int i = 0; i < steps; ++i) {
    if (i == steps / 4) settled = world.bodies().back().pose.translation();
    world.step();
  }
  const RigidBody& top = world.bodies().back();
  const Vector3d normal = world.bodies().front().pose.linear().col(2);
  return {(top.pose.translation() - settled).norm(), normal.dot(top.pose.linear().col(2)),
          top.velocity.norm()};
}

}  // namespace

int main(int argc, char** argv) {
  bool holds = true;
  for (const auto& [degrees, boxes] : {std::pair{20.0, 1}, {26.0, 1}, {27.0, 1}, {32.0, 1}, {0.0, 5}}) {
    const double slope = degrees * std::numbers::pi / 180;
    const double pull = gravity * (std::sin(slope) - contact_settings.friction * std::cos(slope));
    const double expected_speed = std::max(0.0, pull) * steps * time_step;
    const Outcome outcome = play(slope, boxes, argc, argv);
    std::printf("%2.0f degrees, %d boxes: moved %.4f m, upright %.5f, speed %.4f m/s of %.4f m/s\n", degrees,
                boxes, outcome.moved, outcome.upright, outcome.speed, expected_speed);
    const bool stays = outcome.moved < 0.002;
    holds = holds && outcome.upright > 0.999 && stays == (expected_speed == 0) &&
            std::abs(outcome.speed - expected_speed) < 0.02;
  }
  std::printf("the boxes %s\n", holds ? "stand and slide as they should" : "do not behave");
  return holds ? 0 : 1;
}
