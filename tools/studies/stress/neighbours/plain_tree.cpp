#include "stress/neighbours/plain_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace graze::tools {
namespace {

using Eigen::Array3d;
using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::uint32_t most_in_leaf = 4;

/// The squared distance of a point and a segment.
double squared_to_segment(const Vector3d& point, const Vector3d& from, const Vector3d& to) {
  const Vector3d along = to - from;
  const double length = along.squaredNorm();
  const double part = length > 0 ? std::clamp(along.dot(point - from) / length, 0.0, 1.0) : 0.0;
  return (point - from - part * along).squaredNorm();
}

}  // namespace

PlainTree::PlainTree(std::span<const std::array<std::uint32_t, 3>> triangles,
                     const std::vector<Vector3d>& positions)
    : triangles_(triangles), positions_(positions), order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.push_back({0, 0, static_cast<std::uint32_t>(order_.size())});
  for (std::uint32_t node = 0; node < nodes_.size(); ++node) split(node);
  boxes_.resize(nodes_.size());
  refit();
}

/// Halves a node along the longest side of its triangles' middles, unless it is small.
void PlainTree::split(std::uint32_t node) {
  const auto [child, first, count] = nodes_[node];
  if (count <= most_in_leaf) return;
  const auto begin = order_.begin() + first;
  Array3d low = Array3d::Constant(infinity);
  Array3d high = -low;
  for (std::uint32_t i = 0; i < count; ++i) {
    low = low.min(middle_of(order_[first + i]));
    high = high.max(middle_of(order_[first + i]));
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  std::nth_element(begin, begin + count / 2, begin + count, [&](std::uint32_t left, std::uint32_t right) {
    return middle_of(left)[axis] < middle_of(right)[axis];
  });
  nodes_[node].first_child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({0, first, count / 2});
  nodes_.push_back({0, first + count / 2, count - count / 2});
}

Array3d PlainTree::middle_of(std::uint32_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return (positions_[a] + positions_[b] + positions_[c]).array() / 3;
}

void PlainTree::refit() {
  for (std::size_t node = nodes_.size(); node-- > 0;) {
    Box box{Array3d::Constant(infinity), Array3d::Constant(-infinity)};
    const auto add = [&](const Array3d& low, const Array3d& high) {
      box = {box.low.min(low), box.high.max(high)};
    };
    if (const std::uint32_t child = nodes_[node].first_child; child > 0) {
      for (const std::uint32_t i : {child, child + 1}) add(boxes_[i].low, boxes_[i].high);
    } else {
      for (std::uint32_t i = 0; i < nodes_[node].count; ++i)
        for (const std::uint32_t corner : triangles_[order_[nodes_[node].first + i]])
          add(positions_[corner].array(), positions_[corner].array());
    }
    boxes_[node] = box;
  }
}

double PlainTree::squared_to_box(std::uint32_t node, const Vector3d& point) const {
  const Box& box = boxes_[node];
  return (box.low - point.array()).max(point.array() - box.high).max(0.0).square().sum();
}

/// By the region of Voronoi that holds the point: first the corners, then the sides, then the inside.
double PlainTree::squared_to(std::uint32_t triangle, const Vector3d& point) const {
  const auto& [first, second, third] = triangles_[triangle];
  const Vector3d& a = positions_[first];
  const Vector3d& b = positions_[second];
  const Vector3d& c = positions_[third];
  const Vector3d u = b - a;
  const Vector3d v = c - a;
  const Vector3d from_a = point - a;
  const double along_u = u.dot(from_a);
  const double along_v = v.dot(from_a);
  if (along_u <= 0 && along_v <= 0) return from_a.squaredNorm();
  const Vector3d from_b = point - b;
  const double past_u = u.dot(from_b);
  const double from_b_along_v = v.dot(from_b);
  if (past_u >= 0 && from_b_along_v <= past_u) return from_b.squaredNorm();
  const Vector3d from_c = point - c;
  const double past_v = v.dot(from_c);
  const double from_c_along_u = u.dot(from_c);
  if (past_v >= 0 && from_c_along_u <= past_v) return from_c.squaredNorm();
  const double over_ab = along_u * from_b_along_v - past_u * along_v;
  if (over_ab <= 0 && along_u >= 0 && past_u <= 0) return squared_to_segment(point, a, b);
  const double over_ac = from_c_along_u * along_v - along_u * past_v;
  if (over_ac <= 0 && along_v >= 0 && past_v <= 0) return squared_to_segment(point, a, c);
  const double over_bc = past_u * past_v - from_c_along_u * from_b_along_v;
  if (over_bc <= 0 && from_b_along_v >= past_u && from_c_along_u >= past_v)
    return squared_to_segment(point, b, c);
  const double sum = over_ab + over_ac + over_bc;
  return (from_a - u * (over_ac / sum) - v * (over_ab / sum)).squaredNorm();
}

double PlainTree::distance(const Vector3d& point) const {
  double nearest = infinity;
  std::array<std::pair<double, std::uint32_t>, 128> open;
  std::size_t count = 0;
  open[count++] = {squared_to_box(0, point), 0};
  while (count > 0) {
    const auto [lower, number] = open[--count];
    if (lower >= nearest) continue;
    const Node& node = nodes_[number];
    if (node.first_child == 0) {
      for (std::uint32_t i = 0; i < node.count; ++i)
        nearest = std::min(nearest, squared_to(order_[node.first + i], point));
      continue;
    }
    std::pair near{squared_to_box(node.first_child, point), node.first_child};
    std::pair far{squared_to_box(node.first_child + 1, point), node.first_child + 1};
    if (near.first > far.first) std::swap(near, far);
    if (far.first < nearest) open[count++] = far;
    if (near.first < nearest) open[count++] = near;
  }
  return std::sqrt(nearest);
}

}  // namespace graze::tools
