#include "examples/loops/crowd.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "examples/loops/random.hpp"
#include "examples/loops/terrain.hpp"

namespace loops {
namespace {

constexpr double height = 1.7;         // m
constexpr double walking_speed = 1.4;  // m/s
constexpr double turning_speed = 2.5;  // rad/s
constexpr double walked_radius = 20;   // m, about the middle of the terrain
constexpr double kept_distance = 0.8;  // m, between the middles of two characters

/// A figure in a long robe, with a neck and a head. It reaches 1 m into the ground: a prop that it walks into
/// is then pushed aside, as the way out below is longer. With feet at the ground it is pushed into the
/// ground.
Shape figure() {
  const Eigen::Vector2d outline[] = {{0, -1},      {0.34, -0.9}, {0.34, 0.1},  {0.32, 0.7}, {0.3, 1.1},
                                     {0.28, 1.25}, {0.1, 1.35},  {0.15, 1.45}, {0.16, 1.6}, {0, height}};
  constexpr int rings = 25;
  std::vector<Eigen::Vector2d> line;
  const int corners = static_cast<int>(std::size(outline)) - 1;
  for (int i = 0; i <= rings + 1; ++i) {
    const double along = static_cast<double>(i) * corners / (rings + 1);
    const int corner = std::min(static_cast<int>(along), corners - 1);
    line.push_back(outline[corner] + (along - corner) * (outline[corner + 1] - outline[corner]));
  }
  return rounded(examples::revolved(line, 20));
}

Eigen::Vector2d place_in_circle(std::uint32_t seed, double radius) {
  const double angle = 2 * std::numbers::pi * random_number(2 * seed);
  return radius * std::sqrt(random_number(2 * seed + 1)) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

}  // namespace

Crowd::Crowd(std::size_t count) : rest_(figure()), mesh_(make_mesh(rest_)), characters_(count) {
  for (std::size_t i = 0; i < count; ++i) {
    Character& character = characters_[i];
    character.place = place_in_circle(static_cast<std::uint32_t>(i), walked_radius);
    character.phase = static_cast<double>(i);
    character.points = character.before = character.normals = rest_.points;
    turn_away(i);
    pose(character);
  }
}

void Crowd::turn_away(std::size_t index) {
  Character& character = characters_[index];
  const std::size_t seed = 1000 + index + characters_.size() * ++character.goals;
  character.goal = place_in_circle(static_cast<std::uint32_t>(seed), walked_radius);
}

void Crowd::animate(double time) {
  for (Character& character : characters_) {
    const Eigen::Vector2d ahead(std::cos(character.heading), std::sin(character.heading));
    character.place += time * (walking_speed * ahead + character.dodge);
    character.phase += 7 * time;
    const double wanted = character.touches > 0 ? 0.35 : 0.05;
    character.step_height += std::clamp(wanted - character.step_height, -time, time);
    character.before = character.points;  // a copy, since graze reads `points` where they are
    pose(character);
  }
}

void Crowd::pose(Character& character) const {
  const double c = std::cos(character.heading), s = std::sin(character.heading);
  const double stretch = 1 + character.step_height * std::abs(std::sin(character.phase));
  const double sway = 0.1 * std::sin(character.phase);  // m, at the head
  const double z = ground_height(character.place.x(), character.place.y());
  for (std::size_t i = 0; i < rest_.points.size(); ++i) {
    const Eigen::Vector3d rest = rest_.points[i].cast<double>();
    const double bend = sway * (rest.z() * rest.z()) / (height * height);
    const double y = rest.y() + bend;
    character.points[i] = Eigen::Vector3d(character.place.x() + c * rest.x() - s * y,
                                          character.place.y() + s * rest.x() + c * y, z + stretch * rest.z())
                              .cast<float>();
  }
}

void Crowd::steer(double time) {
  for (std::size_t i = 0; i < characters_.size(); ++i) {
    Character& character = characters_[i];
    const Eigen::Vector2d way = character.goal - character.place;
    if (way.norm() < 1) turn_away(i);
    const double angle =
        std::remainder(std::atan2(way.y(), way.x()) - character.heading, 2 * std::numbers::pi);
    character.heading += std::clamp(angle, -turning_speed * time, turning_speed * time);
  }
}

void Crowd::dodge() {
  for (Character& character : characters_) {
    character.dodge.setZero();
    for (const Character& other : characters_) {
      const Eigen::Vector2d away = character.place - other.place;
      const double distance = away.norm();
      if (distance > 0 && distance < kept_distance)
        character.dodge += (kept_distance / distance - 1) * 4 * away;
    }
  }
}

void Crowd::compute_normals() {
  for (Character& character : characters_) {
    std::fill(character.normals.begin(), character.normals.end(), Eigen::Vector3f::Zero());
    const std::vector<Eigen::Vector3f>& points = character.points;
    for (const std::array<std::uint32_t, 3>& t : rest_.triangles) {
      const Eigen::Vector3f normal = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
      for (const std::uint32_t vertex : t) character.normals[vertex] += normal;
    }
    for (Eigen::Vector3f& normal : character.normals) normal.normalize();
  }
}

Eigen::Vector3d Crowd::velocity_at(std::size_t index, const graze::Feature& feature,
                                   const Eigen::Vector3d& point, double time) const {
  const Character& character = characters_[index];
  const graze::SurfaceWeights shares = graze::weights(*mesh_, character.points, feature, point);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(shares.count); ++i) {
    const std::uint32_t vertex = shares.vertex[i];
    const Eigen::Vector3f moved = character.points[vertex] - character.before[vertex];
    velocity += shares.weight[i] / time * moved.cast<double>();
  }
  return velocity;
}

}  // namespace loops
