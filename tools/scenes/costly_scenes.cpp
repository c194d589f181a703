#include "scenes/costly_scenes.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "models/models.hpp"
#include "scenes/scene_parts.hpp"

namespace graze::scenes {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint32_t long_faces = 20000;

/// A quarter of a half turn about z.
Matrix3d turn() {
  const double half = std::sqrt(0.5);
  return Matrix3d{{half, -half, 0}, {half, half, 0}, {0, 0, 1}};
}
/// And then another about x, whose sine is 3/5.
Matrix3d turn_and_tilt() {
  return Matrix3d{{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}} * turn();
}

/// A place on a circle of radius 5, from 0 to 1 once around, without sine and cosine.
Vector3d on_circle(double share) {
  const double quarter = std::floor(4 * share);
  const double t = 4 * share - quarter;
  const double tangent = t * (0.785 + 0.215 * t * t);  // about that of half the angle
  const double square = tangent * tangent;
  const Vector3d at(5 * (1 - square) / (1 + square), 10 * tangent / (1 + square), 0);
  if (quarter == 0) return at;
  if (quarter == 1) return {-at.y(), at.x(), 0};
  return quarter == 2 ? Vector3d(-at.x(), -at.y(), 0) : Vector3d(at.y(), -at.x(), 0);
}

/// A square of 10 by 10 in strips from one side to the other.
models::MeshData strips() {
  constexpr std::uint32_t count = long_faces / 2;
  models::MeshData data;
  for (const double x : {-5, 5})
    for (std::uint32_t j = 0; j <= count; ++j)
      data.positions.emplace_back(x, 10 * (double(j) / count - 0.5), 0);
  for (std::uint32_t j = 0; j < count; ++j) {
    const std::uint32_t other = count + 1 + j;
    data.add_face({j, other, other + 1});
    data.add_face({j, other + 1, j + 1});
  }
  return data;
}

/// A square of 10 by 10 in cells, which are not long.
models::MeshData cells() {
  constexpr std::uint32_t count = 100;
  models::MeshData data;
  for (std::uint32_t j = 0; j <= count; ++j)
    for (std::uint32_t i = 0; i <= count; ++i)
      data.positions.emplace_back(10 * (double(i) / count - 0.5), 10 * (double(j) / count - 0.5), 0);
  for (std::uint32_t j = 0; j < count; ++j)
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t corner = j * (count + 1) + i;
      data.add_face({corner, corner + 1, corner + count + 2});
      data.add_face({corner, corner + count + 2, corner + count + 1});
    }
  return data;
}

/// A disc as CAD programs cut caps: to and fro between two halves of the rim.
models::MeshData zigzag() {
  models::MeshData data;
  for (std::uint32_t j = 0; j < long_faces; ++j) data.positions.push_back(on_circle(double(j) / long_faces));
  std::uint32_t low = 0;
  std::uint32_t high = long_faces - 1;
  while (high - low > 2) {
    data.add_face({low, low + 1, high});
    data.add_face({low + 1, high - 1, high});
    ++low;
    --high;
  }
  return data;
}

/// A disc of triangles that meet in its middle, which is the first corner of each, or in a vertex of its rim.
models::MeshData fan(bool has_hub) {
  models::MeshData data;
  if (has_hub) data.positions.emplace_back(0, 0, 0);
  for (std::uint32_t j = 0; j < long_faces; ++j) data.positions.push_back(on_circle(double(j) / long_faces));
  if (!has_hub)
    for (std::uint32_t j = 1; j + 1 < long_faces; ++j) data.add_face({0, j, j + 1});
  else
    for (std::uint32_t j = 0; j < long_faces; ++j) data.add_face({0, 1 + j, 1 + (j + 1) % long_faces});
  return data;
}

/// A bending road, 2 wide.
models::MeshData road() {
  constexpr std::uint32_t count = long_faces / 2;
  models::MeshData data;
  for (std::uint32_t j = 0; j <= count; ++j) {
    const double x = 10 * (double(j) / count - 0.5);
    const Vector3d across = Vector3d(-0.4 * x, 1, 0).normalized();
    for (const double side : {-1, 1}) data.positions.push_back(Vector3d(x, 0.2 * x * x, 0) + side * across);
  }
  for (std::uint32_t j = 0; j < count; ++j) {
    data.add_face({2 * j, 2 * j + 2, 2 * j + 3});
    data.add_face({2 * j, 2 * j + 3, 2 * j + 1});
  }
  return data;
}

/// A small ball that flies over a fixed surface, everything turned alike.
class FlyoverScene : public PlayedScene {
 public:
  FlyoverScene(models::MeshData ground, const Matrix3d& turned) : turned_(turned) {
    for (Vector3d& position : ground.positions) position = turned * position;
    ground_ = mesh_of(ground);
    models::MeshData ball = models::sphere(12, 7);
    for (Vector3d& position : ball.positions) position *= 0.05;
    ball_ = mesh_on_grid(std::move(ball));
  }

  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.01, 0.02); }
  void advance(Scene& scene, std::size_t frame) override {
    if (frame == 0) {
      ObjectSettings fixed;
      fixed.motion = Motion::fixed;
      scene.add(ground_, fixed);
      ObjectSettings rigid;
      rigid.motion = Motion::rigid;
      id_ = scene.add(ball_, rigid);
    }
    const double way = static_cast<double>(frame);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = turned_;
    pose.translation() = turned_ * Vector3d(0.5 + 0.02 * way, 0.25 + 0.03 * way, 0.055);
    scene.set_pose(id_, pose);
  }

 private:
  Matrix3d turned_;
  std::shared_ptr<const Mesh> ground_;
  std::shared_ptr<const Mesh> ball_;
  ObjectId id_;
};

/// Two solids of one mesh, of which one moves about the other's place.
class TwoBodiesScene : public PlayedScene {
 public:
  TwoBodiesScene(std::shared_ptr<const Mesh> mesh, double apart) : mesh_(std::move(mesh)), apart_(apart) {}

  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.01, 0.02); }
  void advance(Scene& scene, std::size_t frame) override {
    if (frame == 0) {
      ObjectSettings settings;
      settings.solid = true;
      settings.motion = Motion::fixed;
      scene.add(mesh_, settings);
      settings.motion = Motion::rigid;
      id_ = scene.add(mesh_, settings);
    }
    const double way = static_cast<double>(frame);
    const Vector3d towards(std::fmod(0.37 * way, 1.0) - 0.45, std::fmod(0.61 * way, 1.0) - 0.35,
                           std::fmod(0.83 * way, 1.0) - 0.55);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = apart_ * towards.normalized();
    // A body in the same place is away in every other frame: what does not move costs nothing.
    if (apart_ == 0 && frame % 2 == 1) pose.translation() = Vector3d(3, 0, 0);
    scene.set_pose(id_, pose);
  }

 private:
  std::shared_ptr<const Mesh> mesh_;
  double apart_;
  ObjectId id_;
};

/// A cone of 18 vertices: its top, the middle of its base, and 16 about that.
models::MeshData cone() {
  models::MeshData data;
  data.positions.emplace_back(0, 0, 1);
  data.positions.emplace_back(0, 0, -1);
  for (std::uint32_t j = 0; j < 16; ++j)
    data.positions.push_back(0.2 * on_circle(j / 16.0) - Vector3d::UnitZ());
  for (std::uint32_t j = 0; j < 16; ++j) {
    const std::uint32_t next = (j + 1) % 16;
    data.add_face({0, 2 + j, 2 + next});
    data.add_face({1, 2 + next, 2 + j});
  }
  return data;
}

/// A crate of 8 vertices.
models::MeshData crate() {
  models::MeshData data;
  for (std::uint32_t i = 0; i < 8; ++i)
    data.positions.emplace_back((i & 1U) != 0 ? 1 : -1, (i & 2U) != 0 ? 1 : -1, (i & 4U) != 0 ? 1 : -1);
  constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : sides) {
    data.add_face({a, b, c});
    data.add_face({a, c, d});
  }
  return data;
}

struct NamedGround {
  std::string_view name;
  models::MeshData (*make)();
  Matrix3d (*turn)();
};
Matrix3d not_turned() {
  return Matrix3d::Identity();
}
constexpr std::array<NamedGround, 9> grounds = {{{"strips_straight", strips, not_turned},
                                                 {"strips_turned", strips, turn},
                                                 {"strips_tilted", strips, turn_and_tilt},
                                                 {"zigzag_straight", zigzag, not_turned},
                                                 {"zigzag_turned", zigzag, turn},
                                                 {"fan_of_hub", [] { return fan(true); }, not_turned},
                                                 {"fan_of_rim", [] { return fan(false); }, not_turned},
                                                 {"road", road, not_turned},
                                                 {"cells", cells, not_turned}}};
struct NamedBodies {
  std::string_view name;
  models::MeshData (*make)();
  double apart;
};
models::MeshData ball() {
  return models::sphere(12, 7);
}
constexpr std::array<NamedBodies, 9> bodies = {{{"cones_same", cone, 0},
                                                {"cones_near", cone, 1e-6},
                                                {"cones_apart", cone, 0.1},
                                                {"crates_same", crate, 0},
                                                {"crates_near", crate, 1e-6},
                                                {"crates_apart", crate, 0.1},
                                                {"balls_same", ball, 0},
                                                {"balls_near", ball, 1e-6},
                                                {"balls_apart", ball, 0.1}}};

}  // namespace

std::vector<std::string_view> costly_scene_names() {
  std::vector<std::string_view> names;
  for (const NamedGround& each : grounds) names.push_back(each.name);
  for (const NamedBodies& each : bodies) names.push_back(each.name);
  return names;
}

std::unique_ptr<PlayedScene> make_costly_scene(std::string_view name) {
  for (const NamedGround& each : grounds)
    if (each.name == name) return std::make_unique<FlyoverScene>(each.make(), each.turn());
  for (const NamedBodies& each : bodies)
    if (each.name == name) return std::make_unique<TwoBodiesScene>(body_of_costly_scene(name), each.apart);
  return nullptr;
}

std::shared_ptr<const Mesh> body_of_costly_scene(std::string_view name) {
  for (const NamedBodies& each : bodies)
    if (each.name == name) return mesh_on_grid(each.make());
  return nullptr;
}

}  // namespace graze::scenes
