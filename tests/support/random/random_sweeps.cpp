#include "support/random/random_sweeps.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace graze::oracle {
namespace {

/// A small multiple of 1/4.
double grid_number(Random& random, std::uint32_t count) {
  return (static_cast<double>(random.below(count)) - static_cast<double>(count / 2)) / 4;
}
Eigen::Vector3d grid_point(Random& random, std::uint32_t count) {
  const double x = grid_number(random, count);
  const double y = grid_number(random, count);
  return {x, y, grid_number(random, count)};
}

MovingPoints generic(Random& random) {
  MovingPoints points;
  for (std::size_t i = 0; i < 4; ++i) {
    points.start[i] = random.vector(-1, 1);
    points.end[i] = random.vector(-1, 1);
  }
  return points;
}

MovingPoints on_grid(Random& random) {
  MovingPoints points;
  const std::uint32_t count = 2 + random.below(8);
  for (std::size_t i = 0; i < 4; ++i) {
    points.start[i] = grid_point(random, count);
    points.end[i] = grid_point(random, count);
  }
  return points;
}

/// Makes some coordinates equal, so that all lies in a plane or on a line, or some points.
void flatten(Random& random, MovingPoints& points) {
  const std::uint32_t axes = 1 + random.below(2);
  const auto first = static_cast<Eigen::Index>(random.below(3));
  for (std::uint32_t i = 0; i < axes; ++i)
    for (auto* const at : {&points.start, &points.end}) {
      const Eigen::Index axis = (first + static_cast<Eigen::Index>(i)) % 3;
      const double value = random.chance(0.5) ? 0 : grid_number(random, 8);
      for (Eigen::Vector3d& point : *at) point[axis] = value;
    }
}

/// Moves all points alike, or not at all.
void translate(Random& random, MovingPoints& points) {
  const Eigen::Vector3d motion = random.chance(0.3) ? Eigen::Vector3d::Zero().eval() : grid_point(random, 8);
  const std::size_t from = random.below(4);  // those before it keep their motion
  for (std::size_t i = from; i < 4; ++i) points.end[i] = points.start[i] + motion;
}

/// Makes two of the points the same at the start, at the end or at both.
void join(Random& random, MovingPoints& points) {
  const std::size_t from = random.below(4);
  const std::size_t to = (from + 1 + random.below(3)) % 4;
  const std::uint32_t when = random.below(3);
  if (when != 0) points.start[to] = points.start[from];
  if (when != 1) points.end[to] = points.end[from];
}

/// Puts a point at the end, or half way, onto a point between two others, which doubles hold on a grid.
void aim(Random& random, MovingPoints& points) {
  const std::size_t a = random.below(4);
  const std::size_t b = random.below(4);
  const std::size_t hits = random.below(4);
  const Eigen::Vector3d target = (points.start[a] + points.start[b] + points.end[a] + points.end[b]) / 4;
  if (random.chance(0.5)) {
    points.end[hits] = 2 * target - points.start[hits];
  } else {
    points.end[hits] = (points.end[a] + points.end[b]) / 2;
  }
}

/// Turns on the way through a position in which it lies in a plane twice, or nearly.
void graze_plane(Random& random, MovingPoints& points) {
  for (std::size_t i = 0; i < 4; ++i) {
    points.start[i].z() = 0;
    points.end[i].z() = 0;
  }
  const double tiny = std::ldexp(1.0, -static_cast<int>(random.below(60)));
  const std::size_t lifted = random.below(4);
  points.start[lifted].z() = tiny;
  points.end[lifted].z() = random.chance(0.5) ? tiny : -tiny;
}

/// Changes some coordinates by units in the last place, or to a very different size.
void disturb(Random& random, MovingPoints& points) {
  for (auto* const at : {&points.start, &points.end})
    for (Eigen::Vector3d& point : *at)
      for (double& coordinate : point) {
        const std::uint32_t how = random.below(12);
        if (how == 0) coordinate = std::nextafter(coordinate, 2);
        if (how == 1) coordinate = std::ldexp(coordinate, -static_cast<int>(random.below(80)));
      }
}

}  // namespace

MovingPoints random_sweep(std::uint64_t seed) {
  Random random(seed);
  const std::uint32_t form = random.below(3);
  MovingPoints points = form == 0 || (form == 2 && random.chance(0.3)) ? generic(random) : on_grid(random);
  points.are_edges = random.chance(0.5);
  if (form != 2) return points;
  for (std::uint32_t changes = 1 + random.below(3); changes > 0; --changes) {
    switch (random.below(6)) {
      case 0:
        flatten(random, points);
        break;
      case 1:
        translate(random, points);
        break;
      case 2:
        join(random, points);
        break;
      case 3:
        aim(random, points);
        break;
      case 4:
        graze_plane(random, points);
        break;
      default:
        disturb(random, points);
        break;
    }
  }
  return points;
}

}  // namespace graze::oracle
