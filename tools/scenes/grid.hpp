#pragma once

#include <Eigen/Core>
#include <cmath>

namespace graze::scenes {

/// Rounded to multiples of 2^-16, which float holds up to 256: what the last bits of a machine's sine and
/// cosine are is not seen in it.
inline Eigen::Vector3d on_grid(const Eigen::Vector3d& point) {
  return (point * 0x1p16).array().round().matrix() * 0x1p-16;
}

}  // namespace graze::scenes
