#include "examples/loops/props.hpp"

#include <cmath>
#include <numbers>

#include "examples/loops/random.hpp"
#include "examples/loops/terrain.hpp"

namespace loops {
namespace {

constexpr double gravity = 9.81;  // m/s²
constexpr double kept = 0.6;      // of a spin after one second

/// The sizes of the props in m, and their density in kg/m³. The last one is a ball.
constexpr double density = 150;
const Eigen::Vector3d sizes[] = {{0.5, 0.5, 0.5}, {0.9, 0.4, 0.3}, {0.5, 0.5, 0.5}};
constexpr std::size_t ball_shape = 2;

void give_mass(Prop& prop) {
  const Eigen::Vector3d& size = sizes[prop.shape];
  const Eigen::Vector3d squares = size.cwiseProduct(size);
  const bool is_ball = prop.shape == ball_shape;
  const double mass = density * size.prod() * (is_ball ? std::numbers::pi / 6 : 1);
  const double share =
      is_ball ? 1.0 / 20 : 1.0 / 12;  // of a ball, each two squares sum to twice its diameter's
  prop.inverse_mass = 1 / mass;
  prop.inverse_inertia = (share * mass * (Eigen::Vector3d::Constant(squares.sum()) - squares)).cwiseInverse();
}

}  // namespace

void Prop::push(const Eigen::Vector3d& arm, const Eigen::Vector3d& impulse) {
  velocity += inverse_mass * impulse;
  spin += inverse_inertia_now * arm.cross(impulse);
}

Props::Props(std::size_t count)
    : meshes_{make_mesh(rounded(examples::box(sizes[0]))), make_mesh(rounded(examples::box(sizes[1]))),
              make_mesh(rounded(examples::ball(sizes[2].x() / 2, 16, 7)))},
      props_(count),
      poses_(count) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(count))));
  for (std::size_t i = 0; i < count; ++i) {
    Prop& prop = props_[i];
    const auto seed = static_cast<std::uint32_t>(i);
    const int row = static_cast<int>(i) / columns, column = static_cast<int>(i) % columns;
    const double x = 36.0 * (row + 0.5) / columns - 18 + random_number(2 * seed) - 0.5;
    const double y = 36.0 * (column + 0.5) / columns - 18 + random_number(2 * seed + 1) - 0.5;
    prop.position = {x, y, ground_height(x, y) + 0.8};
    prop.turn = Eigen::AngleAxisd(6 * random_number(7 * seed), Eigen::Vector3d::UnitZ());
    prop.shape = i % std::size(sizes);
    give_mass(prop);
    update_pose(i);
  }
}

void Props::update_pose(std::size_t index) {
  Prop& prop = props_[index];
  const Eigen::Matrix3d turn = prop.turn.toRotationMatrix();
  prop.inverse_inertia_now = turn * prop.inverse_inertia.asDiagonal() * turn.transpose();
  poses_[index] = Eigen::Translation3d(prop.position) * prop.turn;
}

void Props::move(double time) {
  for (std::size_t i = 0; i < props_.size(); ++i) {
    Prop& prop = props_[i];
    if (prop.velocity != Eigen::Vector3d::Zero() || prop.spin != Eigen::Vector3d::Zero()) {
      prop.position += time * prop.velocity;
      const double angle = time * prop.spin.norm();
      if (angle > 0) prop.turn = (Eigen::AngleAxisd(angle, prop.spin.normalized()) * prop.turn).normalized();
      update_pose(i);
    }
    prop.spin *= std::pow(kept, time);
    prop.velocity.z() -= gravity * time;
  }
}

void Props::rest() {
  for (Prop& prop : props_) {
    if (prop.velocity.norm() > 0.05 || prop.spin.norm() > 0.1) continue;
    prop.velocity.setZero();
    prop.spin.setZero();
  }
}

}  // namespace loops
