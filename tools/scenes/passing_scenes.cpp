#include "scenes/passing_scenes.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/models.hpp"
#include "scenes/grid.hpp"
#include "scenes/scene_parts.hpp"

namespace graze::scenes {
namespace {

using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;
constexpr double ribbon_length = 3;
constexpr std::uint32_t ribbon_columns = 36;

std::shared_ptr<const Mesh> ribbon(models::Faces faces) {
  return mesh_on_grid(models::sheet(ribbon_columns, 3, ribbon_length, 0.5, faces));
}

/// The ribbon along a meander in the plane of x and z. From a swing of some 2.2 on its loops touch each
/// other.
std::vector<Vector3d> meander(const Mesh& ribbon, const Vector3d& place, double swing, double slant) {
  constexpr int pieces = 8 * static_cast<int>(ribbon_columns);
  constexpr double piece = ribbon_length / pieces;
  std::array<Vector3d, pieces + 1> curve{Vector3d::Zero()};
  for (std::size_t i = 0; i < pieces; ++i) {
    const double angle = swing * std::sin(2 * pi * piece * (static_cast<double>(i) + 0.5));
    curve[i + 1] = curve[i] + piece * Vector3d(std::cos(angle), 0, std::sin(angle));
  }
  std::vector<Vector3d> positions;
  for (const Vector3d& rest : ribbon.rest()) {
    const auto index = static_cast<std::size_t>(std::lround((rest.x() + ribbon_length / 2) / piece));
    // Loops that lie over each other are slanted, so that they cross in points and not along lines.
    const Vector3d lift(0, rest.y(), slant * rest.x() * rest.y());
    positions.push_back(on_grid(place + curve.at(index) + lift));
  }
  return positions;
}

Eigen::Isometry3d pose_at(const Vector3d& place) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = on_grid(place);
  return pose;
}

class SelfScene : public PlayedScene {
 public:
  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.03, 0.1); }

  void advance(Scene& scene, std::size_t frame) override {
    if (frame == 0) add_all(scene);
    const auto time = static_cast<double>(frame);
    if (frame % 5 == 2) scene.ignore(triangles_, 0, triangles_, 1);
    if (frame % 5 == 4) scene.watch(triangles_, 1, triangles_, 0);
    const double swing = 2.15 + 0.15 * std::sin(0.4 * time);
    scene.set_positions(triangles_, meander(*of_triangles_, {-1.5, 0, 0}, swing, 0.1));
    scene.set_positions(quads_, meander(*of_quads_, {-1.5, 0.25, 0.5}, swing + 0.1, 0.05));
    scene.set_pose(ring_, pose_at({0.3 * std::sin(0.3 * time), 0, 0.4}));
  }

 private:
  void add_all(Scene& scene) {
    ObjectSettings settings;
    settings.self = true;
    settings.self_rings = 2;
    for (std::uint32_t face = 0; face < of_triangles_->face_count(); ++face)
      settings.face_groups.push_back(static_cast<std::uint8_t>(face / 24 % 3));
    settings.hidden_groups = {2};
    triangles_ = scene.add(of_triangles_, settings);
    quads_ = scene.add(of_quads_, {.margin = 0.015625, .self = true, .self_rings = 0});
    ring_ = scene.add(mesh_on_grid(models::torus(12, 8, 0.4, 0.1)),
                      {.motion = Motion::rigid, .self = true, .self_at_rest = true});
  }

  std::shared_ptr<const Mesh> of_triangles_ = ribbon(models::Faces::triangles);
  std::shared_ptr<const Mesh> of_quads_ = ribbon(models::Faces::quads);
  ObjectId triangles_, quads_, ring_;
};

class SweptScene : public PlayedScene {
 public:
  [[nodiscard]] SceneSettings settings() const override {
    SceneSettings settings = settings_of(0.03, 0.1);
    settings.sweep_tolerance = 0x1p-24;
    settings.swept_gap = 0.0625;
    return settings;
  }

  void advance(Scene& scene, std::size_t frame) override {
    if (frame == 0) add_all(scene);
    const auto time = static_cast<double>(frame);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const double own = static_cast<double>(i);
      const Vector3d place(1.5 * std::sin(1.1 * time + own), 0.3 * std::cos(0.7 * time + 2 * own),
                           0.8 * std::sin(0.9 * time + 3 * own));
      const bool jumps = (frame + i) % balls_.size() == 0;
      if (i % 2 == 1)
        move(scene, balls_[i], place, time, jumps);
      else if (jumps)
        scene.set_pose(balls_[i], pose_at(place), teleport);
      else
        scene.set_pose(balls_[i], pose_at(place));
    }
    scene.set_positions(ribbon_, meander(*mesh_of_ribbon_, {-1.5, 0, 0}, 2.2 * std::sin(0.8 * time), 0.1));
  }

 private:
  void add_all(Scene& scene) {
    scene.add(mesh_on_grid(models::sheet(4, 4, 2, 2)), {.motion = Motion::fixed});
    for (std::size_t i = 0; i < balls_.size(); ++i)
      balls_[i] = scene.add(
          mesh_of_ball_,
          {.motion = i % 2 == 1 ? Motion::deformable : Motion::rigid, .solid = i == 0, .swept = i != 1});
    ribbon_ = scene.add(mesh_of_ribbon_, {.self = true, .swept = true});
  }
  /// Moves a ball that also swells and shrinks.
  void move(Scene& scene, ObjectId id, const Vector3d& place, double time, bool jumps) const {
    std::vector<Vector3d> positions;
    for (const Vector3d& rest : mesh_of_ball_->rest())
      positions.push_back(on_grid(place + (1 + 0.2 * std::sin(time)) * rest));
    if (jumps)
      scene.set_positions(id, positions, teleport);
    else
      scene.set_positions(id, positions);
  }
  static models::MeshData small_ball() {
    models::MeshData data = models::sphere(8, 5);
    for (Vector3d& position : data.positions) position *= 0.25;
    return data;
  }

  std::shared_ptr<const Mesh> mesh_of_ball_ = mesh_on_grid(small_ball());
  std::shared_ptr<const Mesh> mesh_of_ribbon_ = ribbon(models::Faces::triangles);
  std::array<ObjectId, 6> balls_;
  ObjectId ribbon_;
};

}  // namespace

std::unique_ptr<PlayedScene> make_self_scene() {
  return std::make_unique<SelfScene>();
}

std::unique_ptr<PlayedScene> make_swept_scene() {
  return std::make_unique<SweptScene>();
}

}  // namespace graze::scenes
