#include "scheduler/moving_scene.hpp"

#include <cmath>
#include <numeric>

#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

/// The used vertices about the origin, so that what turns stays where it is.
oracle::Shape centred(oracle::Shape shape) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0;
  for (const auto& face : shape.faces)
    for (const std::uint32_t corner : face) {
      sum += shape.positions[corner];
      count += 1;
    }
  for (Eigen::Vector3d& position : shape.positions) position -= sum / count;
  return shape;
}

std::vector<std::shared_ptr<const Mesh>> shapes() {
  std::vector<std::shared_ptr<const Mesh>> meshes = {
      mesh_of(models::torus(8, 6, 0.5, 0.2)),   mesh_of(models::sphere(8, 5)),
      mesh_of(models::box({0.7, 0.5, 0.9})),    mesh_of(models::sheet(6, 6, 1.5, 1.5)),
      mesh_of(models::torus(12, 8, 0.6, 0.25)), mesh_of(models::sphere(6, 3, models::Faces::quads))};
  for (std::uint64_t seed = 100; seed < 106; ++seed)
    meshes.push_back(mesh_of(centred(oracle::random_scene(2 * seed).a)));
  return meshes;
}

}  // namespace

MovingScene::MovingScene() {
  oracle::Random random(5);
  const auto vector = [&](double size) {
    const double x = random.between(-size, size);
    const double y = random.between(-size, size);
    return Eigen::Vector3d(x, y, random.between(-size, size));
  };
  for (auto& mesh : shapes()) {
    Body body;
    body.mesh = mesh;
    body.given = static_cast<Given>(bodies_.size() % 3);
    body.centre = vector(1);
    body.path = vector(0.8);
    body.axis = vector(1).normalized();
    body.speed = random.between(0.1, 0.4);
    body.bend = random.between(0.1, 0.5);
    bodies_.push_back(body);
  }
}

MovingScene::Order MovingScene::given_order() const {
  Order order(bodies_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

Eigen::Isometry3d MovingScene::pose(const Body& body, std::size_t frame) const {
  const double time = body.speed * static_cast<double>(frame);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(time, body.axis).toRotationMatrix();
  pose.translation() = body.centre + std::sin(2 * time) * body.path;
  return pose;
}

std::vector<Eigen::Vector3f> MovingScene::positions(const Body& body, std::size_t frame) const {
  const Eigen::Isometry3d place = pose(body, frame);
  const double bend = body.bend * std::sin(0.3 * static_cast<double>(frame));
  std::vector<Eigen::Vector3f> result;
  for (Eigen::Vector3d point : body.mesh->rest()) {
    point.z() += bend * point.x() * point.y();
    result.emplace_back((place * point).cast<float>());
  }
  return result;
}

void MovingScene::place(Scene& scene, const Body& body, ObjectId id, std::size_t frame) const {
  if (body.given == Given::posed)
    scene.set_pose(id, pose(body, frame));
  else
    scene.set_positions(id, positions(body, frame));
}

void MovingScene::play(const SceneSettings& settings, std::size_t count, const Look& look,
                       const std::shared_ptr<TaskScheduler>& scheduler) const {
  Scene scene(settings, scheduler);
  std::vector<ObjectId> ids;
  std::vector<std::vector<Eigen::Vector3f>> memory;
  for (const Body& body : bodies_) {
    ids.push_back(
        scene.add(body.mesh, motion_of(body.given == Given::posed ? Motion::rigid : Motion::deformable)));
    memory.push_back(positions(body, 0));
    if (body.given == Given::bound) scene.bind_positions(ids.back(), memory.back());
  }
  for (std::size_t frame = 0; frame < count; ++frame) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      if (bodies_[i].given == Given::bound) {
        const auto now = positions(bodies_[i], frame);
        std::copy(now.begin(), now.end(), memory[i].begin());
      } else {
        place(scene, bodies_[i], ids[i], frame);
      }
    }
    look(frame, scene.step(), ids);
  }
}

std::vector<ReportHandle> MovingScene::play(const SceneSettings& settings, std::size_t count,
                                            const std::shared_ptr<TaskScheduler>& scheduler) const {
  std::vector<ReportHandle> reports;
  play(
      settings, count,
      [&](std::size_t, const ReportHandle& report, const auto&) { reports.push_back(report); }, scheduler);
  return reports;
}

ReportHandle MovingScene::built_afresh(const SceneSettings& settings, std::size_t frame,
                                       const Order& order) const {
  Scene scene(settings);
  for (const std::size_t index : order) {
    const Body& body = bodies_[index];
    const ObjectId id =
        scene.add(body.mesh, motion_of(body.given == Given::posed ? Motion::rigid : Motion::deformable));
    place(scene, body, id, frame);
  }
  return scene.step();
}

}  // namespace graze::tests
