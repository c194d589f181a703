#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <graze/error.hpp>
#include <graze/weld.hpp>
#include <string>
#include <unordered_map>

#include "core/base/floating_point_scope.hpp"

namespace graze {
namespace {

/// A cell of a grid. Its numbers are whole, or are the coordinates of a point where points join only if they
/// are equal.
using Cell = std::array<double, 3>;

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const double number : cell)
      hash = std::rotl((hash ^ std::bit_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15U, 29);
    return static_cast<std::size_t>(hash);
  }
};

/// Points that stay, found by their place.
class PointGrid {
 public:
  explicit PointGrid(double distance) : distance_(distance) {}

  /// Returns the number of the first point added that is at most the distance away, or Mesh::no_vertex.
  [[nodiscard]] std::uint32_t first_near(const Eigen::Vector3d& point) const {
    std::uint32_t first = Mesh::no_vertex;
    const Cell middle = cell_of(point);
    const int reach = distance_ > 0 ? 1 : 0;
    for (int x = -reach; x <= reach; ++x)
      for (int y = -reach; y <= reach; ++y)
        for (int z = -reach; z <= reach; ++z)
          first = std::min(first, first_in({middle[0] + x, middle[1] + y, middle[2] + z}, point));
    return first;
  }

  void add(const Eigen::Vector3d& point) {
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(point);
    numbers_[cell_of(point)].push_back(number);
  }

  [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }

 private:
  /// Cells are twice as wide as the distance. So points that are near each other are in cells that touch, and
  /// rounding of the quotients does not change that. Adding zero makes -0 into 0.
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& point) const {
    Cell cell{};
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          (distance_ > 0 ? std::floor(point[axis] / (2 * distance_)) : point[axis]) + 0.0;
    return cell;
  }

  [[nodiscard]] std::uint32_t first_in(const Cell& cell, const Eigen::Vector3d& point) const {
    const auto found = numbers_.find(cell);
    if (found == numbers_.end()) return Mesh::no_vertex;
    for (const std::uint32_t number : found->second)
      if ((points_[number] - point).stableNorm() <= distance_) return number;
    return Mesh::no_vertex;
  }

  double distance_;
  std::vector<Eigen::Vector3d> points_;
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> numbers_;
};

/// A face's corners without those that repeat the corner before. It is empty where no surface is left.
class WeldedFace {
 public:
  WeldedFace(std::span<const std::uint32_t> face, const std::vector<std::uint32_t>& new_of_old) {
    for (const std::uint32_t old : face)
      if (const std::uint32_t corner = new_of_old[old]; count_ == 0 || corners_[count_ - 1] != corner)
        corners_[count_++] = corner;
    while (count_ > 1 && corners_[count_ - 1] == corners_[0]) --count_;
    const bool is_folded = count_ == 4 && (corners_[0] == corners_[2] || corners_[1] == corners_[3]);
    if (count_ < 3 || is_folded) count_ = 0;
  }

  [[nodiscard]] std::span<const std::uint32_t> corners() const { return {corners_.data(), count_}; }

 private:
  std::array<std::uint32_t, 4> corners_{};
  std::size_t count_ = 0;
};

}  // namespace

WeldedMesh weld(const Mesh& mesh, double distance) {
  if (!(distance >= 0 && std::isfinite(distance)))
    throw Error("weld: the distance is " + std::to_string(distance) + "; give a finite one of 0 or more");
  const FloatingPointScope scope;

  PointGrid grid(distance);
  std::vector<std::uint32_t> new_of_old(mesh.vertex_count(), Mesh::no_vertex);
  for (std::uint32_t old = 0; old < mesh.vertex_count(); ++old) {
    if (!mesh.is_used(old)) continue;
    const std::uint32_t first = grid.first_near(mesh.rest()[old]);
    new_of_old[old] = first != Mesh::no_vertex ? first : static_cast<std::uint32_t>(grid.points().size());
    if (first == Mesh::no_vertex) grid.add(mesh.rest()[old]);
  }

  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> corner_counts;
  std::vector<std::uint32_t> new_face_of_old(mesh.face_count(), WeldedMesh::no_face);
  for (std::uint32_t old = 0; old < mesh.face_count(); ++old) {
    const WeldedFace face(mesh.face(old), new_of_old);
    if (face.corners().empty()) continue;
    new_face_of_old[old] = static_cast<std::uint32_t>(corner_counts.size());
    corners.insert(corners.end(), face.corners().begin(), face.corners().end());
    corner_counts.push_back(static_cast<std::uint32_t>(face.corners().size()));
  }
  if (corner_counts.empty())
    throw Error("weld: no face has three corners that are further apart than " + std::to_string(distance));
  return {Mesh::from_polygons(grid.points(), corners, corner_counts), std::move(new_of_old),
          std::move(new_face_of_old)};
}

}  // namespace graze
