#include "accuracy/models.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "mean_edge_length.hpp"
#include "models/models.hpp"
#include "support/model_shape.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tools {
namespace {

constexpr double two_pi = 6.28318530717958648;

/// How far the models are from the middle, over the frames.
double outward(double part_of_way) {
  return 1.35 + 0.6 * std::cos(two_pi * part_of_way);
}

}  // namespace

MovingModels::MovingModels(std::uint64_t seed, std::uint32_t frame_count) : frame_count_(frame_count) {
  oracle::Random random(seed);
  const std::vector<models::MeshData> models = {models::torus(), models::pawn(), models::human(),
                                                models::tooth(), models::cylinder()};
  std::vector<std::shared_ptr<const Mesh>> meshes;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const models::MeshData& model = models[i];
    Body body;
    body.rest = tests::shape_of(model);
    body.mesh = std::make_shared<const Mesh>(
        Mesh::from_polygons(model.positions, model.corners, model.corner_counts));
    meshes.push_back(body.mesh);
    const double angle = two_pi * static_cast<double>(i) / static_cast<double>(models.size());
    body.way = {std::cos(angle), std::sin(angle), random.between(-0.3, 0.3)};
    const double x = random.between(-1, 1);
    const double y = random.between(-1, 1);
    body.axis = Eigen::Vector3d(x, y, random.between(-1, 1)).normalized();
    body.turn = random.between(-2, 2);
    body.bend = random.between(0.1, 0.3);
    body.twist = random.between(-0.8, 0.8);
    bodies_.push_back(std::move(body));
  }
  mean_edge_length_ = tools::mean_edge_length(meshes);
  level_epsilon_ = largest_level_epsilon(meshes);
}

std::vector<Eigen::Vector3d> MovingModels::positions(std::size_t index, std::uint32_t frame) const {
  const Body& body = bodies_[index];
  const double part = static_cast<double>(frame) / frame_count_;
  const double swing = std::sin(two_pi * part);
  const Eigen::AngleAxisd turn(body.turn * part, body.axis);
  std::vector<Eigen::Vector3d> result;
  result.reserve(body.rest.positions.size());
  for (Eigen::Vector3d point : body.rest.positions) {
    point = Eigen::AngleAxisd(body.twist * swing * point.z(), Eigen::Vector3d::UnitZ()) * point;
    point.x() += body.bend * swing * point.z() * point.z();
    result.emplace_back(turn * point + outward(part) * body.way);
  }
  return result;
}

void MovingModels::place(Scene& scene, ObjectId object, std::size_t body, std::uint32_t frame) const {
  scene.set_positions(object, positions(body, frame));
}

oracle::Shape MovingModels::shape(std::size_t body, std::uint32_t frame) const {
  return {positions(body, frame), bodies_[body].rest.faces};
}

}  // namespace graze::tools
