#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace graze::tools {

/// What an expert writes in an hour: a hierarchy of boxes over triangles, in plain double. It finds the
/// distance of a point and the nearest triangle, and says neither which feature is nearest nor on which side.
class PlainTree {
 public:
  /// Made from the triangles where they are at first. Both arguments stay in place while the tree is used.
  PlainTree(std::span<const std::array<std::uint32_t, 3>> triangles,
            const std::vector<Eigen::Vector3d>& positions);

  /// Takes up where the triangles are now.
  void refit();
  [[nodiscard]] double distance(const Eigen::Vector3d& point) const;

 private:
  struct Box {
    Eigen::Array3d low, high;
  };
  /// A leaf has no children. Those of another node follow each other.
  struct Node {
    std::uint32_t first_child = 0;
    std::uint32_t first = 0, count = 0;
  };

  void split(std::uint32_t node);
  [[nodiscard]] Eigen::Array3d middle_of(std::uint32_t triangle) const;
  [[nodiscard]] double squared_to(std::uint32_t triangle, const Eigen::Vector3d& point) const;
  [[nodiscard]] double squared_to_box(std::uint32_t node, const Eigen::Vector3d& point) const;

  std::span<const std::array<std::uint32_t, 3>> triangles_;
  const std::vector<Eigen::Vector3d>& positions_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;  ///< children after their parents
  std::vector<Box> boxes_;
};

}  // namespace graze::tools
