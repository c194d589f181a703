#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/box.hpp"
#include "post.hpp"

namespace graze::cluster {

/// A place with a load.
struct Load {
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  std::uint64_t nanoseconds = 0;
};

/// Divides space among all ranks by recursive coordinate bisection, so that each has about the same load.
/// Each rank gives its own loads, and gets the rank that each of them is to belong to. `all` is a box around
/// all of them, which all ranks give alike. All ranks call it, and all get parts of the same division.
///
/// Source: Berger and Bokhari, A partitioning strategy for nonuniform problems on multiprocessors, 1987.
[[nodiscard]] std::vector<int> divided(std::span<const Load> loads, const Box& all, Post& post);

}  // namespace graze::cluster
