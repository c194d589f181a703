// Drops a soft ball onto a floor, with penalty forces: each contact is a spring that pushes while it is
// shorter than a wanted gap. The ball has to come to rest with its centre at its radius above the floor,
// whatever the contact distance is and however fast the ball comes.
//
// Both objects are solid. So no vertex is lost, however deep the first blow drives it into the floor.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <graze/graze.hpp>
#include <memory>

#include "examples/support/body.hpp"
#include "examples/support/record_option.hpp"

namespace {

using examples::Body;
using Forces = std::vector<Eigen::Vector3d>;

constexpr double radius = 0.5;             // m
constexpr double mass = 10;                // kg
constexpr double gap = 0.005;              // m, where the penalty begins
constexpr double contact_stiffness = 1e4;  // N/m for each contact
constexpr double contact_damping = 60;     // N s/m for each contact
constexpr double friction = 0.5;
constexpr double spring_compliance = 5e-5;  // m/N
constexpr double spring_damping = 10;       // N s/m for each spring
constexpr double air_damping = 1;           // 1/s, share of a velocity that is lost
constexpr double time_step = 2.5e-4;        // s
constexpr double duration = 5;              // s

/// Adds the force of each spring, and of a dashpot beside it.
void add_spring_forces(const Body& body, Forces& forces) {
  for (const examples::Spring& spring : body.springs) {
    const Eigen::Vector3d apart = body.positions[spring.b] - body.positions[spring.a];
    const double length = apart.norm();
    const Eigen::Vector3d along = apart / length;
    const double stretching = along.dot(body.velocities[spring.b] - body.velocities[spring.a]);
    const Eigen::Vector3d force =
        ((length - spring.rest_length) / spring.compliance + spring_damping * stretching) * along;
    forces[spring.a] += force;
    forces[spring.b] -= force;
  }
}

/// Returns the force of a contact on b, whose point moves with a velocity relative to that of a.
Eigen::Vector3d contact_force(const graze::Contact& contact, const Eigen::Vector3d& velocity) {
  const double penetration = gap - contact.separation();
  if (penetration <= 0) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d push = contact.push();
  const double opening = push.dot(velocity);
  const double pressure = std::max(0.0, contact_stiffness * penetration - contact_damping * opening);
  const Eigen::Vector3d sliding = velocity - opening * push;
  // Friction is proportional to the sliding where that is slow, so that it never turns the motion round.
  const double hold = std::min(contact_damping, friction * pressure / std::max(sliding.norm(), 1e-9));
  return pressure * push - hold * sliding;
}

/// Adds the forces of all contacts of the floor, which is a and stands still, and the ball.
void add_contact_forces(const graze::FrameReport& report, const Body& ball, Forces& forces) {
  for (const graze::Contact& contact : report.contacts()) {
    // An edge that pierces has no depth to push by: it would push with all its force from the first moment
    // on. The vertex behind it has one.
    if (contact.kind == graze::ContactKind::EF && contact.distance == 0) continue;
    const graze::SurfaceWeights shares =
        graze::weights(*ball.mesh, ball.positions, contact.feature_b, contact.point_b);
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(shares.count); ++i)
      velocity += shares.weight[i] * ball.velocities[shares.vertex[i]];
    const Eigen::Vector3d force = contact_force(contact, velocity);
    for (std::size_t i = 0; i < static_cast<std::size_t>(shares.count); ++i)
      forces[shares.vertex[i]] += shares.weight[i] * force;
  }
}

/// Symplectic Euler: velocities first, then positions by the new velocities.
void move(Body& body, const Forces& forces) {
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    body.velocities[i] += time_step * (body.inverse_masses[i] * forces[i] - air_damping * body.velocities[i] -
                                       Eigen::Vector3d(0, 0, 9.81));
    body.positions[i] += time_step * body.velocities[i];
  }
}

/// Drops the ball and returns whether it has come to rest where it should.
bool holds(double drop, double contact_distance, int argc, char** argv) {
  graze::SceneSettings settings;
  settings.contact_distance = contact_distance;
  settings.detail = graze::ContactDetail::nearest;
  settings.threads = 1;
  graze::Scene scene(settings);
  graze::ObjectSettings solid;
  solid.solid = true;
  const Body floor = examples::fixed_body(examples::floor_box(4, 1));
  const Eigen::Vector3d start(0, 0, radius + drop);
  Body ball =
      examples::soft_ball(moved(examples::ball(radius, 16, 9), start), start, mass, spring_compliance);
  scene.add(floor.mesh, solid);
  scene.bind_positions(scene.add(ball.mesh, solid), ball.positions);
  const std::unique_ptr<graze::Recorder> recorder = examples::recorder_by_options(argc, argv, scene);

  double deepest = 0;
  Forces forces;
  for (int i = 0; i < static_cast<int>(duration / time_step); ++i) {
    const graze::ReportHandle report = scene.step();
    forces.assign(ball.positions.size(), Eigen::Vector3d::Zero());
    add_spring_forces(ball, forces);
    add_contact_forces(*report, ball, forces);
    move(ball, forces);
    for (const graze::Contact& contact : report->contacts())
      deepest = std::max(deepest, -contact.separation());
  }

  double lowest = radius;
  for (const Eigen::Vector3d& point : ball.positions) lowest = std::min(lowest, point.z());
  const double centre = ball.positions.back().z();
  const double speed = examples::largest_speed(ball);
  std::printf(
      "drop %4.2f m, contact distance %4.2f m: centre %6.4f m, lowest %7.4f m, deepest %6.4f m, speed %.4f "
      "m/s\n",
      drop, contact_distance, centre, lowest, deepest, speed);
  return std::abs(centre - radius) < 0.02 && std::abs(lowest) < 0.02 && speed < 0.01;
}

}  // namespace

int main(int argc, char** argv) {
  int held = 0;
  for (const double drop : {0.05, 1.0})
    for (const double contact_distance : {0.02, 0.2}) held += holds(drop, contact_distance, argc, argv);
  std::printf("%d of 4 balls rest on the floor\n", held);
  return held == 4 ? 0 : 1;
}
