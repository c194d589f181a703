#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "sweep/feature_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr int most_rounds = 64;
constexpr double least_progress = 0x1p-50;        ///< of a round, in time
constexpr double of_crossing_time = 1 - 0x1p-50;  ///< of the time at which a linear function reaches a value

/// The vectors between two features at time 0 and at time 1, from each point of the first feature to each
/// point of the second one. There are three of a vertex and a face, and four of two edges.
class Ways {
 public:
  Ways(SweptPair pair, const FeatureSweep& sweep) {
    const std::size_t of_first = pair == SweptPair::vertex_face ? 1 : 2;
    for (std::size_t from = 0; from < of_first; ++from)
      for (std::size_t to = of_first; to < 4; ++to) {
        start_[count_] = sweep.start[to] - sweep.start[from];
        end_[count_] = sweep.end[to] - sweep.end[from];
        size_ = std::max(
            {size_, start_[count_].lpNorm<Eigen::Infinity>(), end_[count_].lpNorm<Eigen::Infinity>()});
        ++count_;
      }
  }

  [[nodiscard]] std::array<Eigen::Vector3d, 4> at(double time) const {
    std::array<Eigen::Vector3d, 4> way;
    for (std::size_t i = 0; i < count_; ++i) way[i] = start_[i] + (end_[i] - start_[i]) * time;
    return way;
  }

  /// Up to when the features are certainly more than `gap` apart along a unit vector, if they are so at
  /// `time`. Otherwise it is `time`. The length along a vector is linear in time.
  [[nodiscard]] double apart_until(const Eigen::Vector3d& direction, double gap, double time) const {
    const double error = size_ * 0x1p-47;  // of a product: below 16 roundings of size_
    double until = never;
    for (std::size_t i = 0; i < count_; ++i) {
      const double start = direction.dot(start_[i]) - error;
      const double end = direction.dot(end_[i]) - error;
      if (!(start + (end - start) * time > gap)) return time;
      if (end <= gap) until = std::min(until, (start - gap) / (start - end) * of_crossing_time);
    }
    return std::max(until, time);
  }

 private:
  std::array<Eigen::Vector3d, 4> start_, end_;
  std::size_t count_ = 0;
  double size_ = 0;  ///< the largest component of all
};

/// The way square to the line through two points.
Eigen::Vector3d square_way(const Eigen::Vector3d& first, const Eigen::Vector3d& second) {
  const Eigen::Vector3d line = second - first;
  return first - line * (first.dot(line) / line.squaredNorm());
}

/// The shortest way between two features at one time is one of nine: between two points, from a point to a
/// line, or square to a plane or to two lines.
class Directions {
 public:
  Directions(SweptPair pair, const std::array<Eigen::Vector3d, 4>& way) {
    if (pair == SweptPair::vertex_face) {
      for (std::size_t i = 0; i < 3; ++i) {
        add(way[i]);
        add(square_way(way[i], way[(i + 1) % 3]));
      }
    } else {
      for (const Eigen::Vector3d& between_points : way) add(between_points);
      add(square_way(way[0], way[1]));
      add(square_way(way[2], way[3]));
      add(square_way(way[0], way[2]));
      add(square_way(way[1], way[3]));
    }
    const Eigen::Vector3d normal = (way[1] - way[0]).cross(way[2] - way[0]);
    add(normal.dot(way[0]) < 0 ? Eigen::Vector3d(-normal) : normal);
  }

  [[nodiscard]] auto begin() const { return directions_.begin(); }
  [[nodiscard]] auto end() const { return directions_.begin() + count_; }

 private:
  /// Leaves out what has no direction.
  void add(const Eigen::Vector3d& vector) {
    const double largest = vector.lpNorm<Eigen::Infinity>();
    if (!(largest > 0x1p-900 && largest < 0x1p900)) return;
    directions_[static_cast<std::size_t>(count_++)] = (vector / largest).normalized();
  }

  std::array<Eigen::Vector3d, 9> directions_;
  std::ptrdiff_t count_ = 0;
};

/// Goes forward to the latest time until which one of the directions keeps the features apart, until none
/// goes further.
std::optional<double> approach(SweptPair pair, const FeatureSweep& sweep, double gap) {
  const Ways ways(pair, sweep);
  double time = 0;
  for (int round = 0; round < most_rounds; ++round) {
    double until = time;
    for (const Eigen::Vector3d& direction : Directions(pair, ways.at(time)))
      until = std::max(until, ways.apart_until(direction, gap, time));
    if (until == never) return std::nullopt;
    const bool is_there = until <= time + least_progress;
    time = until;
    if (is_there) break;
  }
  return time;
}

}  // namespace

std::optional<double> approach_vertex_face(const FeatureSweep& sweep, double gap) {
  return approach(SweptPair::vertex_face, sweep, gap);
}

std::optional<double> approach_edge_edge(const FeatureSweep& sweep, double gap) {
  return approach(SweptPair::edge_edge, sweep, gap);
}

}  // namespace graze
