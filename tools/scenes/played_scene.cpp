#include "scenes/played_scene.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <utility>

#include "models/models.hpp"
#include "scenes/grid.hpp"
#include "scenes/passing_scenes.hpp"
#include "scenes/random.hpp"
#include "scenes/scene_parts.hpp"
#include "scenes/seam_scene.hpp"
#include "scenes/skinned_human.hpp"

namespace graze::scenes {
namespace {

using Eigen::Vector3d;

/// A surface that takes a Lissajous path about `centre`, turned once, and wobbles radially.
struct Body {
  std::shared_ptr<const Mesh> mesh;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vector3d centre = Vector3d::Zero();
  Vector3d path = Vector3d::Zero();   ///< amplitude along each axis
  Vector3d speed = Vector3d::Zero();  ///< radians a frame
  double phase = 0;
  double wobble = 0;  ///< relative to the radius
  bool is_solid = false;

  void place(std::size_t frame, std::vector<Eigen::Vector3f>& positions) const {
    const auto time = static_cast<double>(frame);
    Vector3d now = centre;
    for (int axis = 0; axis < 3; ++axis)
      now[axis] += path[axis] * std::sin(speed[axis] * time + phase + axis);
    const auto rest = mesh->rest();
    positions.resize(rest.size());
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const double swell = 1 + wobble * std::sin(0.3 * time + phase + 5 * rest[i].z());
      positions[i] = on_grid(turn * (swell * rest[i]) + now).cast<float>();
    }
  }
};

/// Bodies that are all there from the start, their positions bound.
class BodiesScene : public PlayedScene {
 public:
  BodiesScene(SceneSettings settings, std::vector<Body> bodies)
      : settings_(std::move(settings)), bodies_(std::move(bodies)), positions_(bodies_.size()) {}

  [[nodiscard]] SceneSettings settings() const override { return settings_; }
  void advance(Scene& scene, std::size_t frame) override {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      bodies_[i].place(frame, positions_[i]);
      if (frame == 0)
        scene.bind_positions(scene.add(bodies_[i].mesh, {.solid = bodies_[i].is_solid}), positions_[i]);
    }
  }

 private:
  SceneSettings settings_;
  std::vector<Body> bodies_;
  std::vector<std::vector<Eigen::Vector3f>> positions_;
};

/// The paper's first experiment: five tori and five pawns whose paths cross.
std::vector<Body> bodies_of_paths() {
  Random random(1);
  const std::array meshes{mesh_on_grid(models::torus()), mesh_on_grid(models::pawn())};
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < 10; ++i)
    bodies.push_back({meshes[i % 2], random.turn(), random.vector(-1.8, 1.8), random.vector(0.8, 1.6),
                      random.vector(0.02, 0.06), random.between(0, 6), 0.03});
  return bodies;
}

/// Eighteen tori and spheres so close that each is in contact with most of its neighbours.
std::vector<Body> bodies_of_pile() {
  Random random(3);
  const std::array meshes{mesh_on_grid(models::torus(24, 12, 0.7, 0.3)),
                          mesh_on_grid(models::sphere(20, 13))};
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < 18; ++i) {
    const std::size_t layer = i / 9;
    const std::size_t row = i / 3 % 3;
    const Vector3d cell(static_cast<double>(i % 3), static_cast<double>(row), static_cast<double>(layer));
    bodies.push_back({meshes[i % 3 == 2 ? 1 : 0], random.turn(), 1.4 * cell + random.vector(-0.2, 0.2),
                      random.vector(0.02, 0.06), random.vector(0.05, 0.2), random.between(0, 6), 0.02});
  }
  return bodies;
}

SceneSettings nearest_settings_of(double contact_distance, double range) {
  SceneSettings settings = settings_of(contact_distance, range);
  settings.detail = ContactDetail::nearest;
  return settings;
}

/// Half of the bodies of the pile, as solids, of which the report lists the nearest contacts only.
std::unique_ptr<PlayedScene> limits() {
  std::vector<Body> bodies = bodies_of_pile();
  bodies.resize(bodies.size() / 2);
  for (Body& body : bodies) body.is_solid = true;
  SceneSettings settings = nearest_settings_of(0.02, 0.1);
  settings.max_contacts = 200;
  settings.max_contacts_per_pair = 40;
  return std::make_unique<BodiesScene>(settings, std::move(bodies));
}

/// The bodies of the pile as solids, of which the report lists the contacts that carry them.
std::unique_ptr<PlayedScene> carrying() {
  std::vector<Body> bodies = bodies_of_pile();
  for (Body& body : bodies) body.is_solid = true;
  SceneSettings settings = nearest_settings_of(0.02, 0.1);
  settings.carrying = 8;
  settings.carrying_band = 0.03;
  return std::make_unique<BodiesScene>(settings, std::move(bodies));
}

models::MeshData scaled(models::MeshData data, double by) {
  for (Vector3d& position : data.positions) position *= by;
  return data;
}

/// Solids that pass through each other, small ones inside of large ones, and a sheet that bounds nothing.
std::unique_ptr<PlayedScene> solids() {
  Random random(11);
  const std::array meshes{
      mesh_on_grid(models::sphere(12, 8, models::Faces::quads)),
      mesh_on_grid(scaled(models::sphere(8, 5), 0.25)), mesh_on_grid(models::torus(16, 8, 0.7, 0.3)),
      mesh_on_grid(models::box({0.5, 0.7, 0.9})), mesh_on_grid(models::sheet(8, 8, 2, 2))};
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t shape = i % meshes.size();
    bodies.push_back({meshes[shape], random.turn(), random.vector(-1, 1), random.vector(0.2, 0.6),
                      random.vector(0.05, 0.2), random.between(0, 6), 0.02, shape + 1 < meshes.size()});
  }
  return std::make_unique<BodiesScene>(nearest_settings_of(0.03, 0.2), std::move(bodies));
}

/// Two spheres that touch in a small patch.
std::unique_ptr<PlayedScene> pair(PairSize size) {
  const auto mesh =
      mesh_on_grid(size == PairSize::large ? models::sphere(400, 250) : models::sphere(125, 80));
  std::vector<Body> bodies;
  for (const double side : {-1.0, 1.0})
    bodies.push_back({mesh,
                      Eigen::Matrix3d::Identity(),
                      {side * 0.999, 0, 0},
                      {0.002, 0.002, 0.002},
                      {0.1, 0.13, 0.17},
                      side,
                      0.006});
  return std::make_unique<BodiesScene>(settings_of(0.02, 0.1), std::move(bodies));
}

/// A walking human between a sheet that waves at its back, a ball that is posed and a second human.
class SkinnedScene : public PlayedScene {
 public:
  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.02, 0.2); }

  void advance(Scene& scene, std::size_t frame) override {
    const auto time = static_cast<double>(frame);
    if (frame == 0) {
      for (ObjectId& walker : walkers_) walker = scene.add(human().mesh());
      sheet_ = scene.add(sheet_mesh_);
      ObjectSettings settings;
      settings.motion = Motion::rigid;
      ball_ = scene.add(ball_mesh_, settings);
    }
    for (std::size_t i = 0; i < walkers_.size(); ++i) {
      human().pose(0.3 * time + 2 * static_cast<double>(i), positions_);
      const Vector3d place(0.75 * static_cast<double>(i) + 0.1 * std::sin(0.1 * time), 0, 0);
      for (Vector3d& position : positions_) position = on_grid(position + place);
      scene.set_positions(walkers_[i], positions_);
    }
    positions_.clear();
    for (const Vector3d& rest : sheet_mesh_->rest())
      positions_.push_back(on_grid({rest.x(), 0.13 + 0.05 * std::sin(4 * rest.y() + 0.4 * time), rest.y()}));
    scene.set_positions(sheet_, positions_);
    // Moved along the grid and not turned, so that its positions lie on it too.
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = on_grid({0.9 * std::sin(0.2 * time), -0.3, 0.3});
    scene.set_pose(ball_, pose);
  }

 private:
  static models::MeshData small_ball() {
    models::MeshData data = models::sphere(16, 9);
    for (Vector3d& position : data.positions) position *= 0.25;
    return data;
  }

  /// Made once: making its mesh takes longer than playing the scene.
  static const SkinnedHuman& human() {
    static const SkinnedHuman made;
    return made;
  }

  std::shared_ptr<const Mesh> sheet_mesh_ = mesh_on_grid(models::sheet(16, 16, 1.5, 1.75));
  std::shared_ptr<const Mesh> ball_mesh_ = mesh_on_grid(small_ball());
  std::array<ObjectId, 2> walkers_;
  ObjectId sheet_, ball_;
  std::vector<Vector3d> positions_;
};

/// Small bodies in one small room that come, move, jump and go. Pairs are ignored and watched, rules change.
class CrowdScene : public PlayedScene {
 public:
  [[nodiscard]] SceneSettings settings() const override { return settings_of(0.05, 0.3); }

  void advance(Scene& scene, std::size_t frame) override {
    if (frame == 0)
      while (members_.size() < 20) join(scene);
    for (std::size_t i = 0; i < 2; ++i) {
      if (random_.chance(0.5) && members_.size() < 30) join(scene);
      if (random_.chance(0.5) && members_.size() > 10) leave(scene);
    }
    change_pairs(scene);
    for (Member& member : members_) move(scene, member);
  }

 private:
  struct Member {
    ObjectId id;
    std::size_t shape = 0;
    Vector3d place, velocity;
  };

  ObjectId any() { return members_[random_.below(members_.size())].id; }
  std::uint32_t any_kind() { return static_cast<std::uint32_t>(random_.below(3)); }
  void change_pairs(Scene& scene) {
    const ObjectId a = any();
    const ObjectId b = any();
    if (random_.chance(0.3)) scene.ignore(a, b);  // with itself too: a diagnostic
    if (random_.chance(0.3)) scene.watch(b, any());
    if (!random_.chance(0.2)) return;
    const std::uint32_t kind = any_kind();
    const double threshold = random_.between(0, 0.1);
    const double range = random_.between(0, 0.4);
    scene.set_rule(kind, any_kind(), {threshold, range, {}});
  }
  void join(Scene& scene) {
    Member member;
    member.shape = random_.below(meshes_.size());
    ObjectSettings settings;
    settings.motion = member.shape == 0 ? Motion::rigid : Motion::deformable;
    settings.kind = any_kind();
    settings.margin = random_.chance(0.3) ? 0.03125 : 0;
    member.id = scene.add(meshes_[member.shape], settings);
    member.place = random_.vector(-1.5, 1.5);
    member.velocity = random_.vector(-0.05, 0.05);
    members_.push_back(member);
  }
  void leave(Scene& scene) {
    const auto gone = members_.begin() + static_cast<std::ptrdiff_t>(random_.below(members_.size()));
    scene.remove(gone->id);
    members_.erase(gone);
  }
  void move(Scene& scene, Member& member) {
    member.place += member.velocity;
    if (random_.chance(0.05)) member.place = random_.vector(-1.5, 1.5);
    const Vector3d place = on_grid(member.place);
    if (member.shape == 0) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = place;
      return scene.set_pose(member.id, pose);
    }
    const double swell = random_.between(0.9, 1.1);
    std::vector<Vector3d> positions;
    for (const Vector3d& rest : meshes_[member.shape]->rest())
      positions.emplace_back(on_grid(swell * rest) + place);
    scene.set_positions(member.id, positions);
  }

  Random random_{7};
  std::array<std::shared_ptr<const Mesh>, 4> meshes_ = {
      mesh_on_grid(models::box({0.7, 0.5, 0.9})), mesh_on_grid(models::torus(12, 8, 0.4, 0.15)),
      mesh_on_grid(models::sphere(9, 6, models::Faces::quads)), mesh_on_grid(models::sheet(6, 6, 1.5, 1.5))};
  std::vector<Member> members_;
};

}  // namespace

std::vector<std::string_view> played_scene_names() {
  return {"paths",  "pile",   "pair",     "skinned", "crowd", "nearest",
          "solids", "limits", "carrying", "seams",   "self",  "swept"};
}

std::unique_ptr<PlayedScene> make_played_scene(std::string_view name, PairSize pair_size) {
  if (name == "paths") return std::make_unique<BodiesScene>(settings_of(0.05, 0.25), bodies_of_paths());
  if (name == "pile") return std::make_unique<BodiesScene>(settings_of(0.02, 0.1), bodies_of_pile());
  if (name == "pair") return pair(pair_size);
  if (name == "skinned") return std::make_unique<SkinnedScene>();
  if (name == "crowd") return std::make_unique<CrowdScene>();
  if (name == "nearest")
    return std::make_unique<BodiesScene>(nearest_settings_of(0.05, 0.25), bodies_of_paths());
  if (name == "solids") return solids();
  if (name == "limits") return limits();
  if (name == "carrying") return carrying();
  if (name == "seams") return make_seam_scene();
  if (name == "self") return make_self_scene();
  if (name == "swept") return make_swept_scene();
  return nullptr;
}

}  // namespace graze::scenes
