#include "scenes/skinned_human.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "models/models.hpp"
#include "scenes/grid.hpp"

namespace graze::scenes {
namespace {

using Eigen::Vector3d;

/// From its joint to its end, in the model's own coordinates: z up, facing -y. The trunk is bone 0. A bone
/// with a parent hangs on the end of that one.
struct Bone {
  Vector3d joint, end;
  int parent;
  double swing;  ///< radians about x, largest
  double phase;
};

const std::array<Bone, 9>& skeleton() {
  static const std::array<Bone, 9> bones = {{
      {{0, 0, 0.05}, {0, 0, 0.85}, -1, 0.05, 0},
      {{0.22, 0.01, 0.57}, {0.37, 0.02, 0.24}, 0, 0.6, 0},
      {{0.37, 0.02, 0.24}, {0.48, -0.07, -0.1}, 1, 0.5, 0.5},
      {{-0.22, 0.01, 0.57}, {-0.37, 0.02, 0.24}, 0, 0.6, 3.2},
      {{-0.37, 0.02, 0.24}, {-0.48, -0.07, -0.1}, 3, 0.5, 3.7},
      {{0.1, 0, 0}, {0.12, -0.01, -0.43}, 0, 0.5, 3.2},
      {{0.12, -0.01, -0.43}, {0.14, 0.02, -0.97}, 5, 0.4, 4.2},
      {{-0.1, 0, 0}, {-0.12, -0.01, -0.43}, 0, 0.5, 0},
      {{-0.12, -0.01, -0.43}, {-0.14, 0.02, -0.97}, 7, 0.4, 1},
  }};
  return bones;
}

double distance_to(const Bone& bone, const Vector3d& point) {
  const Vector3d along = bone.end - bone.joint;
  const double part = std::clamp((point - bone.joint).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (point - bone.joint - part * along).norm();
}

}  // namespace

SkinnedHuman::SkinnedHuman() {
  models::MeshData data = models::human();
  for (Vector3d& position : data.positions) position = on_grid(position);
  mesh_ = std::make_shared<const Mesh>(
      Mesh::from_polygons(data.positions, data.corners, std::span<const std::uint32_t>(data.corner_counts)));
  for (const Vector3d& position : data.positions) {
    auto& weights = weights_.emplace_back();
    double sum = 0;
    for (std::size_t bone = 0; bone < bone_count; ++bone) {
      const double distance = distance_to(skeleton()[bone], position) + 0.01;
      weights[bone] = 1 / (distance * distance * distance * distance);
      sum += weights[bone];
    }
    for (double& weight : weights) weight /= sum;
  }
}

void SkinnedHuman::pose(double time, std::vector<Vector3d>& positions) const {
  std::array<Eigen::Isometry3d, bone_count> moves;
  for (std::size_t i = 0; i < bone_count; ++i) {
    const Bone& bone = skeleton()[i];
    const double angle = bone.swing * std::sin(time + bone.phase);
    moves[i] = Eigen::Translation3d(bone.joint) * Eigen::AngleAxisd(angle, Vector3d::UnitX()) *
               Eigen::Translation3d(-bone.joint);
    if (bone.parent >= 0) moves[i] = moves[static_cast<std::size_t>(bone.parent)] * moves[i];
  }
  const auto rest = mesh_->rest();
  positions.assign(rest.size(), Vector3d::Zero());
  for (std::size_t vertex = 0; vertex < rest.size(); ++vertex)
    for (std::size_t i = 0; i < bone_count; ++i)
      positions[vertex] += weights_[vertex][i] * (moves[i] * rest[vertex]);
}

}  // namespace graze::scenes
