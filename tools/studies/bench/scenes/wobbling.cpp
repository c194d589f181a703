#include "bench/scenes/wobbling.hpp"

#include <cmath>
#include <utility>

namespace graze::bench {

Body wobbling(std::shared_ptr<const Mesh> mesh, const Path& path) {
  const auto place = [mesh, path](std::size_t frame, std::span<float> out) {
    const auto time = static_cast<double>(frame);
    Eigen::Vector3d centre = path.centre;
    for (int axis = 0; axis < 3; ++axis)
      centre[axis] += path.reach[axis] * std::sin(path.speed[axis] * time + path.phase + axis);
    std::size_t next = 0;
    for (const Eigen::Vector3d& rest : mesh->rest()) {
      const double swell = 1 + path.wobble * std::sin(0.3 * time + path.phase + 5 * rest.z());
      const Eigen::Vector3d point = path.turn * (swell * rest) + centre;
      for (int axis = 0; axis < 3; ++axis) out[next++] = static_cast<float>(point[axis]);
    }
    return true;
  };
  return {std::move(mesh), place};
}

}  // namespace graze::bench
