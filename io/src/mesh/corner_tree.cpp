#include "mesh/corner_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace graze::io {
namespace {

bool is_before(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

/// The largest doubled area of a, b and a point of the box, as doubled_area() rounds it. Rounding keeps the
/// order of numbers, so no point of the box can have a larger one.
double largest_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2d point(b.y() > a.y() ? box.min().x() : box.max().x(),
                              b.x() > a.x() ? box.max().y() : box.min().y());
  return doubled_area(a, b, point);
}

}  // namespace

CornerTree::CornerTree(std::span<const Eigen::Vector2d> corners, const std::vector<bool>& is_in_way)
    : place_of_(corners.size()) {
  std::vector<std::uint32_t> sorted;
  for (std::uint32_t corner = 0; corner < corners.size(); ++corner)
    if (is_in_way[corner]) sorted.push_back(corner);
  std::ranges::sort(sorted,
                    [&](std::uint32_t a, std::uint32_t b) { return is_before(corners[a], corners[b]); });
  for (const std::uint32_t corner : sorted) {
    if (places_.empty() || places_.back() != corners[corner]) {
      places_.push_back(corners[corner]);
      corners_left_.push_back(0);
    }
    place_of_[corner] = static_cast<std::uint32_t>(places_.size() - 1);
    ++corners_left_.back();
  }
  position_of_.resize(places_.size());
  build();
}

/// Boxes hold the places that were left when the tree was built.
void CornerTree::build() {
  order_.clear();
  for (std::uint32_t place = 0; place < places_.size(); ++place)
    if (corners_left_[place] > 0) order_.push_back(place);
  nodes_.clear();
  build(0, 0, order_);
  for (std::uint32_t position = 0; position < order_.size(); ++position)
    position_of_[order_[position]] = position;
}

void CornerTree::build(std::size_t node, std::uint32_t begin, std::span<std::uint32_t> order) {
  if (nodes_.size() <= node) nodes_.resize(node + 1);
  Eigen::AlignedBox2d box;
  for (const std::uint32_t place : order) box.extend(places_[place]);
  const auto size = static_cast<std::uint32_t>(order.size());
  nodes_[node] = {box, begin, begin + size, size};
  if (is_leaf(nodes_[node])) return;
  const Eigen::Index axis = box.sizes().x() < box.sizes().y() ? 1 : 0;
  const std::size_t half = order.size() / 2;
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](std::uint32_t place) { return places_[place][axis]; });
  build(2 * node + 1, begin, order.first(half));
  build(2 * node + 2, begin + static_cast<std::uint32_t>(half), order.subspan(half));
}

void CornerTree::remove(std::size_t corner) {
  const std::uint32_t place = place_of_[corner];
  if (--corners_left_[place] > 0) return;
  for (std::size_t node = 0;;) {
    --nodes_[node].left;
    if (is_leaf(nodes_[node])) break;
    node = 2 * node + (position_of_[place] < nodes_[2 * node + 1].end ? 1 : 2);
  }
  // Boxes around places that are gone would let searches through.
  if (2 * nodes_[0].left < order_.size()) build();
}

bool CornerTree::any_inside(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                            const Eigen::Vector2d& c) const {
  const auto is_inside = [&](std::uint32_t place) {
    const Eigen::Vector2d& point = places_[place];
    if (corners_left_[place] == 0 || point == a || point == b || point == c) return false;
    return doubled_area(a, b, point) >= 0 && doubled_area(b, c, point) >= 0 && doubled_area(c, a, point) >= 0;
  };
  std::array<std::size_t, 64> open{0};
  for (std::size_t size = 1; size > 0;) {
    const std::size_t index = open[--size];
    const Node& node = nodes_[index];
    ++tests_;
    if (node.left == 0) continue;
    if (largest_area(a, b, node.box) < 0 || largest_area(b, c, node.box) < 0 ||
        largest_area(c, a, node.box) < 0)
      continue;
    if (!is_leaf(node)) {
      open[size++] = 2 * index + 2;
      open[size++] = 2 * index + 1;
      continue;
    }
    for (std::uint32_t position = node.begin; position < node.end; ++position)
      if (is_inside(order_[position])) return true;
  }
  return false;
}

}  // namespace graze::io
