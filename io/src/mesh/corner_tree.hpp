#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

namespace graze::io {

/// Twice the area of a triangle, positive where it is counter-clockwise.
inline double doubled_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The places of those corners of a polygon that are in the way of others. Corners of one place are one
/// entry.
class CornerTree {
 public:
  /// `is_in_way` says which of the corners are.
  CornerTree(std::span<const Eigen::Vector2d> corners, const std::vector<bool>& is_in_way);

  /// Takes out a corner, once.
  void remove(std::size_t corner);
  /// Whether a corner is in a triangle or on its border. Corners where its own are do not matter.
  [[nodiscard]] bool any_inside(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                const Eigen::Vector2d& c) const;
  /// How many boxes were tested so far.
  [[nodiscard]] std::uint64_t tests() const { return tests_; }

 private:
  /// The places of `order_` from `begin` to `end`. The children of node i are 2 i + 1 and 2 i + 2.
  struct Node {
    Eigen::AlignedBox2d box;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t left = 0;  ///< places that still have a corner
  };

  void build();
  void build(std::size_t node, std::uint32_t begin, std::span<std::uint32_t> order);
  [[nodiscard]] static bool is_leaf(const Node& node) { return node.end - node.begin <= 4; }

  std::vector<Eigen::Vector2d> places_;
  std::vector<std::uint32_t> corners_left_;  ///< at each place
  std::vector<std::uint32_t> place_of_;      ///< of each corner that is in the way
  std::vector<std::uint32_t> order_;         ///< the places in the order of the tree
  std::vector<std::uint32_t> position_of_;   ///< of each place, in `order_`
  std::vector<Node> nodes_;
  mutable std::uint64_t tests_ = 0;
};

}  // namespace graze::io
