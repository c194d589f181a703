#include "hard_cases/random_motion.hpp"

#include <algorithm>
#include <cmath>

#include "models/models.hpp"

namespace graze::tests {
namespace {

/// The rest positions turned, placed and scaled.
Positions placed(const Mesh& mesh, const Eigen::Isometry3d& pose, double size) {
  Positions result;
  for (const Eigen::Vector3d& point : mesh.rest()) result.emplace_back(pose * (size * point));
  return result;
}

/// At least how far any used vertex moved.
double displacement(const Mesh& mesh, const Positions& from, const Positions& to) {
  double largest = 0;
  for (std::uint32_t i = 0; i < to.size(); ++i)
    if (mesh.is_used(i)) largest = std::max(largest, (to[i] - from[i]).norm());
  return largest * (1 + 0x1p-40);
}

}  // namespace

RandomMotion::RandomMotion(std::uint64_t seed, const SceneSettings& settings)
    : random_(seed), settings_(settings), scene_(settings), is_on_grid_(seed % 2 == 1) {
  meshes_ = {mesh_of(models::sphere(16, 9)), mesh_of(models::torus(18, 8, 0.6, 0.25)),
             mesh_of(models::sheet(9, 7, 1.5, 1.25)), mesh_of(models::box({0.7, 0.5, 0.9})),
             mesh_of(models::sphere(9, 6, models::Faces::quads))};
  for (std::uint64_t i = 0; i < 4; ++i) meshes_.push_back(mesh_of(oracle::random_scene(seed * 8 + i).a));
  for (int i = 0; i < 7; ++i) add_body();
}

Eigen::Vector3d RandomMotion::vector(double size) {
  const double x = random_.between(-size, size);
  const double y = random_.between(-size, size);
  return {x, y, random_.between(-size, size)};
}

void RandomMotion::add_body() {
  Body body;
  body.given = static_cast<Given>(random_.below(4));
  body.settings.motion = body.given == Given::posed ? Motion::rigid : Motion::deformable;
  body.settings.kind = random_.below(3);
  body.settings.margin = random_.chance(0.3) ? random_.between(0, 0.05) : 0;
  body.mesh = meshes_[random_.below(static_cast<std::uint32_t>(meshes_.size()))];
  body.id = scene_.add(body.mesh, body.settings);
  body.positions.assign(body.mesh->rest().begin(), body.mesh->rest().end());
  body.seen = body.positions;
  bodies_.push_back(std::move(body));
  Body& added = bodies_.back();
  // The memory of a vector stays where it is when its owner is moved.
  if (added.given == Given::bound) scene_.bind_positions(added.id, added.positions);
  if (added.given == Given::bound_when_told)
    scene_.bind_positions(added.id, added.positions, BindPolicy::when_told);
  added.pose.translation() = vector(1.2);
  place(added, placed(*added.mesh, added.pose, 1));
}

void RandomMotion::remove_body() {
  const auto place = bodies_.begin() + random_.below(static_cast<std::uint32_t>(bodies_.size()));
  scene_.remove(place->id);
  std::erase_if(ignored_,
                [&](const auto& pair) { return pair.first == place->id || pair.second == place->id; });
  bodies_.erase(place);
}

void RandomMotion::change_pairs() {
  const auto any = [&] { return bodies_[random_.below(static_cast<std::uint32_t>(bodies_.size()))].id; };
  if (random_.chance(0.5)) {
    const ObjectId a = any();
    const ObjectId b = any();
    if (a == b) return;
    scene_.ignore(a, b);
    ignored_.emplace_back(a, b);
  } else if (random_.chance(0.5) && !ignored_.empty()) {
    const std::pair watched = ignored_[random_.below(static_cast<std::uint32_t>(ignored_.size()))];
    const std::pair reversed(watched.second, watched.first);
    scene_.watch(watched.second, watched.first);
    std::erase_if(ignored_, [&](const auto& pair) { return pair == watched || pair == reversed; });
  } else {
    const std::pair kinds{random_.below(3), random_.below(3)};
    const double threshold = random_.between(0, 0.2);
    rules_.emplace_back(kinds, PairRule{threshold, random_.chance(0.3) ? 0 : random_.between(0, 1), {}});
    scene_.set_rule(kinds.first, kinds.second, rules_.back().second);
  }
}

/// Gives the body positions, and takes up the pose of a rigid one.
void RandomMotion::place(Body& body, Positions positions) {
  if (is_on_grid_ && body.given != Given::posed && random_.chance(0.8))
    for (Eigen::Vector3d& position : positions) position = (position * 16).array().round().matrix() / 16;
  const double moved = displacement(*body.mesh, body.seen, positions);
  // Copied in place: bound memory is read where it is.
  std::copy(positions.begin(), positions.end(), body.positions.begin());
  const bool promises = random_.chance(0.5);
  switch (body.given) {
    case Given::posed:
      return scene_.set_pose(body.id, body.pose);
    case Given::copied:
      return scene_.set_positions(body.id, body.positions, promises ? moved : Scene::any_displacement);
    case Given::bound:
      if (promises) scene_.positions_changed(body.id, moved);
      return;
    case Given::bound_when_told:
      return scene_.positions_changed(body.id, promises ? moved : Scene::any_displacement);
  }
}

void RandomMotion::tremble(Body& body) {
  const double size = std::ldexp(1.0, -static_cast<int>(10 + random_.below(44)));
  if (body.given == Given::posed) {
    body.pose.translation() += vector(size);
    return place(body, placed(*body.mesh, body.pose, 1));
  }
  Positions positions = body.positions;
  if (random_.chance(0.5))
    positions[random_.below(static_cast<std::uint32_t>(positions.size()))] += vector(size);
  else
    for (Eigen::Vector3d& position : positions) position += vector(size);
  place(body, std::move(positions));
}

void RandomMotion::change_motion(Body& body) {
  const std::uint32_t what = random_.below(12);
  body.velocity.setZero();
  if (what < 3) body.rest = 1 + random_.below(12);
  if (what == 3 || what == 4) body.velocity = vector(0.02);
  if (what == 5) body.velocity = vector(0.2);
  if (what == 6) body.velocity = vector(3);  // faster than its size: through others between two steps
  if (what == 7) body.pose.translation() = vector(random_.chance(0.5) ? 1e3 : 1);
  if (what == 8) body.pose.translation() = vector(0.5);
  if (what == 9 && body.given != Given::posed) body.size = random_.chance(0.5) ? 0 : -1;
  if (what == 10) body.size = 1;
  if (what == 11)
    body.pose.linear() = Eigen::AngleAxisd(random_.between(0, 6), vector(1).normalized()).toRotationMatrix();
  if (body.pose.translation().norm() > 2 && random_.chance(0.5)) body.pose.translation() = vector(1);
}

void RandomMotion::move(Body& body) {
  if (body.rest > 0) {
    --body.rest;
    return;
  }
  if (random_.chance(0.25)) return tremble(body);
  if (random_.chance(0.3)) change_motion(body);
  body.pose.translation() += body.velocity;
  place(body, placed(*body.mesh, body.pose, body.size));
}

ReportHandle RandomMotion::step() {
  if (random_.chance(0.05) && bodies_.size() < 10) add_body();
  if (random_.chance(0.05) && bodies_.size() > 4) remove_body();
  if (random_.chance(0.1)) change_pairs();
  for (Body& body : bodies_) move(body);
  const ReportHandle report = scene_.step();
  for (Body& body : bodies_) body.seen = body.positions;
  return report;
}

ReportHandle RandomMotion::built_afresh() const {
  Scene scene(settings_);
  for (const auto& [kinds, rule] : rules_) scene.set_rule(kinds.first, kinds.second, rule);
  std::vector<ObjectId> fresh;
  for (const Body& body : bodies_) {
    fresh.push_back(scene.add(body.mesh, body.settings));
    if (body.given == Given::posed)
      scene.set_pose(fresh.back(), body.pose);
    else
      scene.set_positions(fresh.back(), body.positions);
  }
  const auto now = ids();
  const auto fresh_id = [&](ObjectId id) {
    return fresh[static_cast<std::size_t>(std::find(now.begin(), now.end(), id) - now.begin())];
  };
  for (const auto& [a, b] : ignored_) scene.ignore(fresh_id(a), fresh_id(b));
  return scene.step();
}

std::vector<ObjectId> RandomMotion::ids() const {
  std::vector<ObjectId> result;
  for (const Body& body : bodies_) result.push_back(body.id);
  return result;
}

oracle::Shape RandomMotion::shape(ObjectId object) const {
  oracle::Shape shape;
  for (const Body& body : bodies_) {
    if (body.id != object) continue;
    shape.positions = body.positions;
    for (std::uint32_t face = 0; face < body.mesh->face_count(); ++face) {
      const auto corners = body.mesh->face(face);
      shape.faces.emplace_back(corners.begin(), corners.end());
    }
  }
  return shape;
}

}  // namespace graze::tests
