#include "core/mesh/rest_reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {
namespace {

/// Squares along an edge of the cube, a power of two, so that directions are exact.
constexpr int squares = 8;
constexpr int corners = squares + 1;

std::size_t number_of(int axis, int along, int across) {
  return static_cast<std::size_t>((axis * corners + along) * corners + across);
}

/// Finds the furthest vertex in a direction, by the boxes of regions at rest.
class FurthestVertex {
 public:
  FurthestVertex(const IndexedMesh& mesh, Eigen::Vector3d centre)
      : mesh_(mesh), tree_(mesh.regions()), centre_(std::move(centre)), boxes_(tree_.region_count()) {
    for (std::uint32_t index = tree_.region_count(); index-- > 0;) {
      const Region& region = tree_.region(index);
      if (region.is_leaf())
        for (const std::uint32_t vertex : tree_.vertices(region)) boxes_[index].add(from_centre(vertex));
      for (std::uint32_t child = 0; child < region.child_count; ++child)
        boxes_[index].add(boxes_[region.first_child + child]);
    }
  }

  double reach_in(const Eigen::Vector3d& direction) {
    double furthest = -std::numeric_limits<double>::infinity();
    waiting_.assign(1, 0);
    while (!waiting_.empty()) {
      const std::uint32_t index = waiting_.back();
      waiting_.pop_back();
      if (bound(index, direction) <= furthest) continue;
      const Region& region = tree_.region(index);
      if (region.is_leaf())
        for (const std::uint32_t vertex : tree_.vertices(region))
          furthest = std::max(furthest, direction.dot(from_centre(vertex)));
      else
        add_children(region, direction);
    }
    return furthest;
  }

 private:
  [[nodiscard]] Eigen::Vector3d from_centre(std::uint32_t vertex) const {
    return mesh_.rest()[vertex] - centre_;
  }
  [[nodiscard]] double bound(std::uint32_t index, const Eigen::Vector3d& direction) const {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
      sum += direction[axis] * (direction[axis] > 0 ? boxes_[index].max[axis] : boxes_[index].min[axis]);
    return sum;
  }
  /// The region that reaches furthest is searched first.
  void add_children(const Region& region, const Eigen::Vector3d& direction) {
    const auto first = static_cast<std::ptrdiff_t>(waiting_.size());
    for (std::uint32_t child = 0; child < region.child_count; ++child)
      waiting_.push_back(region.first_child + child);
    std::sort(waiting_.begin() + first, waiting_.end(), [&](std::uint32_t left, std::uint32_t right) {
      return bound(left, direction) < bound(right, direction);
    });
  }

  const IndexedMesh& mesh_;
  const RegionTree& tree_;
  Eigen::Vector3d centre_;
  std::vector<Box> boxes_;  ///< of regions, from the centre
  std::vector<std::uint32_t> waiting_;
};

}  // namespace

RestReach::RestReach(const IndexedMesh& mesh) : reaches_(number_of(3, 0, 0)) {
  for (const std::uint32_t vertex : mesh.regions().vertices()) rest_.add(mesh.rest()[vertex]);
  centre_ = rest_.min + (rest_.max - rest_.min) / 2;
  furthest_ = rest_.min.cwiseAbs().cwiseMax(rest_.max.cwiseAbs());
  size_ = (rest_.max - rest_.min).sum();
  FurthestVertex furthest(mesh, centre_);
  for (int axis = 0; axis < 3; ++axis)
    for (int along = 0; along < corners; ++along)
      for (int across = 0; across < corners; ++across) {
        Eigen::Vector3d direction;
        direction[axis] = 1;
        direction[(axis + 1) % 3] = 2.0 * along / squares - 1;
        direction[(axis + 2) % 3] = 2.0 * across / squares - 1;
        reaches_[number_of(axis, along, across)] = {furthest.reach_in(direction),
                                                    furthest.reach_in(-direction)};
      }
}

RestReach::Both RestReach::reach_in(const Eigen::Vector3d& direction) const {
  int axis = 0;
  const double length = direction.cwiseAbs().maxCoeff(&axis);
  if (length == 0) return {};
  const auto squares_to = [&](int other) {
    return (direction[other] / direction[axis] + 1) * (squares / 2.0);
  };
  const double along = squares_to((axis + 1) % 3);
  const double across = squares_to((axis + 2) % 3);
  const int column = std::clamp(static_cast<int>(along), 0, squares - 1);
  const int row = std::clamp(static_cast<int>(across), 0, squares - 1);
  // The square's two triangles meet along the diagonal from its first corner.
  const double rest_along = along - column;
  const double rest_across = across - row;
  const bool is_below = rest_along >= rest_across;
  const double most = std::max(rest_along, rest_across);
  const double least = std::min(rest_along, rest_across);
  const Both& first = reaches_[number_of(axis, column, row)];
  const Both& second = reaches_[number_of(axis, column + (is_below ? 1 : 0), row + (is_below ? 0 : 1))];
  const Both& third = reaches_[number_of(axis, column + 1, row + 1)];
  const auto sum = [&](double Both::*side) {
    return length * (((1 - most) * first.*side + (most - least) * second.*side) + least * third.*side);
  };
  const Both both{sum(&Both::ahead), sum(&Both::behind)};
  return direction[axis] > 0 ? both : Both{both.behind, both.ahead};
}

double RestReach::slack_of(const double* row) const {
  // The listed reaches, the weights, the sums here and the vertices each have rounding errors. Together these
  // are fewer than a hundred roundings of numbers as large as this sum, and each loses less than the smallest
  // normal number.
  constexpr double roundings = 0x1p-46;
  constexpr double lost = 0x1p-1000;
  const Eigen::Vector3d direction = Eigen::Vector3d(row[0], row[1], row[2]).cwiseAbs();
  return (direction.dot(furthest_) + std::abs(row[3]) + direction.maxCoeff() * size_) * roundings + lost;
}

Box RestReach::box_at(const std::array<double, 12>& rows) const {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const double* const row = &rows[static_cast<std::size_t>(axis) * 4];
    const Eigen::Vector3d direction(row[0], row[1], row[2]);
    const Both reach = reach_in(direction);
    const double middle = direction.dot(centre_) + row[3];
    const double slack = slack_of(row);
    box.min[axis] = middle - reach.behind - slack;
    box.max[axis] = middle + reach.ahead + slack;
  }
  return box;
}

/// How far a point moves is convex, so that a corner of the box moves furthest.
double RestReach::motion_between(const std::array<double, 12>& before,
                                 const std::array<double, 12>& now) const {
  Eigen::Matrix<double, 3, 4> by;
  double slack = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t row = static_cast<std::size_t>(axis) * 4;
    for (std::size_t column = 0; column < 4; ++column)
      by(axis, static_cast<int>(column)) = now[row + column] - before[row + column];
    slack += slack_of(&before[row]) + slack_of(&now[row]);
  }
  double furthest_squared = 0;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = (corner >> axis & 1U) != 0 ? rest_.max[axis] : rest_.min[axis];
    furthest_squared = std::max(furthest_squared, (by.leftCols<3>() * point + by.col(3)).squaredNorm());
  }
  return (std::sqrt(furthest_squared) + slack) * round_up;
}

}  // namespace graze
