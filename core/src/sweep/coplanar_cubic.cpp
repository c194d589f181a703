#include "sweep/coplanar_cubic.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "sweep/swept_vectors.hpp"

namespace graze {
namespace {

/// A vector between two of the points, rounded, at both ends of the motion.
struct RoundedVector {
  Eigen::Vector3d start, end;

  RoundedVector(const FeatureSweep& sweep, Edge edge)
      : start(point(sweep.start, edge.to) - point(sweep.start, edge.from)),
        end(point(sweep.end, edge.to) - point(sweep.end, edge.from)) {}
  [[nodiscard]] double size() const {
    return std::max(start.lpNorm<Eigen::Infinity>(), end.lpNorm<Eigen::Infinity>());
  }
};

}  // namespace

CoplanarCubic CoplanarCubic::of(SweptPair pair, const FeatureSweep& sweep) {
  const std::array<Edge, 3>& edges = volume_edges_of(pair);
  const RoundedVector x(sweep, edges[0]);
  const RoundedVector u(sweep, edges[1]);
  const RoundedVector w(sweep, edges[2]);
  const Eigen::Vector3d area_start = u.start.cross(w.start);
  const Eigen::Vector3d area_middle = u.start.cross(w.end) + u.end.cross(w.start);
  const Eigen::Vector3d area_end = u.end.cross(w.end);
  CoplanarCubic cubic;
  cubic.coefficient = {x.start.dot(area_start), (x.end.dot(area_start) + x.start.dot(area_middle)) / 3,
                       (x.end.dot(area_middle) + x.start.dot(area_end)) / 3, x.end.dot(area_end)};
  const double size = x.size() * u.size() * w.size();
  cubic.error = size > 0x1p-700 ? size * 0x1p-45 : std::numeric_limits<double>::infinity();
  return cubic;
}

CoplanarCubic::Roots CoplanarCubic::roots() const {
  int changes = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const int sign = sign_of(coefficient[i]);
    if (sign == 0) return Roots::unsure;
    if (i > 0 && sign != sign_of(coefficient[i - 1])) ++changes;
  }
  return changes == 0 ? Roots::none : changes == 1 ? Roots::one : Roots::unsure;
}

double CoplanarCubic::value_at(double time) const {
  std::array<double, 4> value = coefficient;
  for (std::size_t last = 3; last > 0; --last)
    for (std::size_t i = 0; i < last; ++i) value[i] = value[i] * (1 - time) + value[i + 1] * time;
  return value[0];
}

std::array<CoplanarCubic, 2> CoplanarCubic::halves() const {
  std::array<CoplanarCubic, 2> half = {*this, *this};
  std::array<double, 4>& value = half[1].coefficient;
  for (std::size_t last = 3; last > 0; --last) {
    for (std::size_t i = 0; i < last; ++i) value[i] = (value[i] + value[i + 1]) / 2;
    half[0].coefficient[4 - last] = value[0];
  }
  return half;
}

}  // namespace graze
