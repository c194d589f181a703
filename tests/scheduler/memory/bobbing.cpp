#include "scheduler/memory/bobbing.hpp"

#include <cmath>
#include <numbers>

namespace graze::tests {
namespace {

constexpr double furthest_move = 0.1;  ///< between two frames

Eigen::Isometry3d pose_of(std::size_t drop, std::size_t frame) {
  const double angle = 2 * std::numbers::pi * static_cast<double>((drop + frame) % Bobbing::period) /
                       static_cast<double>(Bobbing::period);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.5 * static_cast<double>(drop % 5) - 1,
                                       0.5 * static_cast<double>(drop / 5) - 1, 0.3 + 0.3 * std::sin(angle));
  return pose;
}

template <typename Batch, typename Thing>
std::span<const Thing> first(const std::array<Thing, Bobbing::period>& things, const Batch& batch) {
  return std::span<const Thing>(things).first(batch.size);
}

}  // namespace

std::shared_ptr<const Mesh> drop_mesh() {
  models::MeshData sphere = models::sphere(8, 5);
  for (Eigen::Vector3d& position : sphere.positions) position *= 0.15;
  return mesh_of(sphere);
}

Bobbing::Bobbing(const SceneSettings& settings) : scene_(settings), mesh_(drop_mesh()) {
  plate_ = scene_.add(mesh_of(models::sheet(16, 16, 4, 4)), motion_of(Motion::fixed));
  for (std::size_t drop = 0; drop < Bobbing::period; ++drop) {
    const Given given = given_of(drop);
    ids_[drop] = scene_.add(mesh_, motion_of(given == Given::posed ? Motion::rigid : Motion::deformable));
    of_[static_cast<std::size_t>(given)].push_back(drop);
    for (std::size_t frame = 0; frame < Bobbing::period; ++frame) {
      poses_[frame].push_back(pose_of(drop, frame));
      positions_[frame].push_back(moved(mesh_->rest(), poses_[frame][drop].translation()));
    }
    own_.push_back(positions_[0][drop]);
    if (given == Given::told) scene_.bind_positions(ids_[drop], own_[drop], BindPolicy::when_told);
  }
}

void Bobbing::tell(std::size_t frame) {
  copy(frame % Bobbing::period);
  bind(frame % Bobbing::period);
  write(frame % Bobbing::period);
  place(frame % Bobbing::period);
  scene_.watch(plate_, ids_[frame % Bobbing::period]);
  scene_.ignore(ids_[(frame + 1) % Bobbing::period], plate_);
}

Bobbing::Batch Bobbing::batch_of(Given given, std::size_t frame) const {
  Batch batch;
  for (const std::size_t drop : all(given)) {
    if (drop == all(given)[0]) continue;
    batch.ids[batch.size] = ids_[drop];
    batch.views[batch.size] = positions_[frame][drop];
    batch.promises[batch.size] = furthest_move;
    batch.poses[batch.size] = poses_[frame][drop];
    ++batch.size;
  }
  return batch;
}

void Bobbing::copy(std::size_t frame) {
  const std::size_t single = all(Given::copied)[0];
  scene_.set_positions(ids_[single], positions_[0][single]);  // the later call counts
  scene_.set_positions(ids_[single], positions_[frame][single]);
  const Batch batch = batch_of(Given::copied, frame);
  scene_.set_positions(first(batch.ids, batch), first(batch.views, batch));
}

void Bobbing::bind(std::size_t frame) {
  const std::size_t single = all(Given::bound)[0];
  scene_.unbind_positions(ids_[single]);
  scene_.bind_positions(ids_[single], positions_[frame][single]);
  const Batch batch = batch_of(Given::bound, frame);
  scene_.bind_positions(first(batch.ids, batch), first(batch.views, batch));
}

/// Writes to the memory that is bound, and tells it.
void Bobbing::write(std::size_t frame) {
  for (const std::size_t drop : all(Given::told)) own_[drop] = positions_[frame][drop];
  scene_.positions_changed(ids_[all(Given::told)[0]]);
  const Batch batch = batch_of(Given::told, frame);
  scene_.positions_changed(first(batch.ids, batch));
  scene_.positions_changed(first(batch.ids, batch), first(batch.promises, batch));
}

void Bobbing::place(std::size_t frame) {
  const std::size_t single = all(Given::posed)[0];
  scene_.set_pose(ids_[single], poses_[frame][single]);
  const Batch batch = batch_of(Given::posed, frame);
  scene_.set_poses(first(batch.ids, batch), first(batch.poses, batch));
}

}  // namespace graze::tests
