#include "experiment/paper/motion/paper_motions.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "experiment/paper/motion/soft_motion.hpp"
#include "scenes/random.hpp"

namespace graze::tools {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using scenes::Random;

models::MeshData scaled(models::MeshData mesh, double factor) {
  for (Vector3d& position : mesh.positions) position *= factor;
  return mesh;
}

Isometry3d placed(const Vector3d& at, const Matrix3d& turn) {
  Isometry3d place = Isometry3d::Identity();
  place.linear() = turn;
  place.translation() = at;
  return place;
}

/// A spin, and a stretch along one axis that is a squeeze along another.
Matrix3d random_flow(Random& random, double spin, double stretch) {
  const Vector3d axis = spin * random.vector(-1, 1);
  Matrix3d flow;
  flow << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Matrix3d turn = random.turn();
  const double along = random.between(0.5, 1) * stretch;
  return flow +
         turn * Vector3d(along, -along, random.between(-0.3, 0.3) * stretch).asDiagonal() * turn.transpose();
}

Vector3d on_ring(double radius, double turns, double height) {
  const double angle = 2 * std::numbers::pi * turns;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// Tori with R = 4 r and pawns of about their size, five of each, on two rings, one above the other.
SoftMotion ten_objects(Random& random) {
  SoftMotion motion{"experiment_1", {}, Vector3d::Zero(), 0.4, 5, 0.02, 300};
  for (std::uint32_t i = 0; i < 10; ++i) {
    const bool torus = i % 2 == 0;
    SoftBody body;
    body.kind = torus ? "torus" : "pawn";
    body.kind_id = torus ? 0 : 1;
    body.name = body.kind + "_" + std::to_string(i / 2);
    body.rest = torus ? scaled(models::torus(32, 24, 0.8, 0.2), 33) : scaled(models::pawn(), 35);
    const double upper = i < 5 ? 1 : -1;
    const Vector3d at = on_ring(84, (i % 5 + (i < 5 ? 0 : 0.5)) / 5, 47 * upper) + random.vector(-4, 4);
    body.start = placed(at, random.turn());
    body.flow = random_flow(random, 0.006, 0.02);
    body.speed = 0.15;
    motion.bodies.push_back(std::move(body));
  }
  return motion;
}

SoftMotion three_humans_and_torus(Random& random) {
  SoftMotion motion{"experiment_2", {}, Vector3d::Zero(), 0.4, 4, 0.02, 200};
  const auto add = [&](const std::string& kind, std::uint32_t kind_id, const std::string& name,
                       models::MeshData rest, const Vector3d& at, double turn) {
    SoftBody body;
    body.kind = kind;
    body.kind_id = kind_id;
    body.name = name;
    body.rest = std::move(rest);
    const double about_x = random.between(-0.15, 0.15);
    const double about_z = turn + random.between(-0.1, 0.1);
    body.start = placed(at + random.vector(-1, 1),
                        Eigen::AngleAxisd(about_z, Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(about_x, Vector3d::UnitX()).toRotationMatrix());
    body.flow = random_flow(random, 0.002, 0.008);
    body.speed = 0.13;
    motion.bodies.push_back(std::move(body));
  };
  const double third = 2 * std::numbers::pi / 3;
  for (std::uint32_t i = 0; i < 3; ++i)
    add("human", 0, "human_" + std::to_string(i), scaled(models::human(), 38.5), on_ring(40, i / 3.0, 0),
        third * i - std::numbers::pi / 2);
  add("torus", 1, "torus", scaled(models::torus(32, 24, 0.8, 0.2), 48), {0, 0, 72}, 0);
  return motion;
}

SoftMotion tooth_and_cylinder(Random& random) {
  SoftMotion motion{"experiment_3", {}, Vector3d::Zero(), 0.4, 3, 0.02, 100};
  SoftBody tooth;
  tooth.name = tooth.kind = "tooth";
  tooth.rest = scaled(models::tooth(), 34);
  tooth.soft = false;
  motion.bodies.push_back(std::move(tooth));
  SoftBody cylinder;
  cylinder.name = cylinder.kind = "cylinder";
  cylinder.kind_id = 1;
  cylinder.rest = scaled(models::cylinder(), 36.5);
  const double about_z = random.between(-0.2, 0.2);
  cylinder.start = placed(Vector3d(0, 0, 75) + random.vector(-1, 1),
                          (Eigen::AngleAxisd(about_z, Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()))
                              .toRotationMatrix());
  cylinder.flow = random_flow(random, 0.002, 0.01);
  cylinder.speed = 0.36;
  motion.bodies.push_back(std::move(cylinder));
  return motion;
}

RecordedMotion record(int number, std::uint64_t seed, std::uint32_t frames) {
  Random random(seed + static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15U);
  const SoftMotion motion = number == 1   ? ten_objects(random)
                            : number == 2 ? three_humans_and_torus(random)
                                          : tooth_and_cylinder(random);
  return record_soft_motion(motion, frames == 0 ? motion.steps : frames);
}

}  // namespace

RecordedMotion record_experiment(int number, const ExperimentOptions& options) {
  if (number < 1 || number > 3) throw std::invalid_argument("the paper has experiments 1, 2 and 3");
  static std::map<std::tuple<int, std::uint64_t, std::uint32_t>, RecordedMotion>
      made;  // for study after study
  RecordedMotion& motion = made[{number, options.seed, options.frames}];
  if (motion.objects.empty()) motion = record(number, options.seed, options.frames);
  return motion;
}

}  // namespace graze::tools
