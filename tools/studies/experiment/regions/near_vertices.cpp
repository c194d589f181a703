#include "experiment/regions/near_vertices.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/box.hpp"

namespace graze::tools {
namespace {

using Cell = std::array<std::int64_t, 3>;

class Grid {
 public:
  Grid(const PlacedMesh& placed, double cell_size) : positions_(placed.positions), cell_size_(cell_size) {
    for (std::uint32_t vertex = 0; vertex < positions_.size(); ++vertex)
      if (placed.mesh.is_used(vertex)) {
        cells_.emplace_back(cell_of(positions_[vertex]), vertex);
        box_.add(positions_[vertex]);
      }
    std::sort(cells_.begin(), cells_.end());
  }

  /// Calls `found(vertex)` for every vertex in the cell of `point` and those around it, by ascending number.
  template <typename Found>
  void around(const Eigen::Vector3d& point, const Found& found) {
    if ((point - box_.min).minCoeff() < -cell_size_ || (box_.max - point).minCoeff() < -cell_size_) return;
    const Cell centre = cell_of(point);
    vertices_.clear();
    for (std::int64_t x = centre[0] - 1; x <= centre[0] + 1; ++x)
      for (std::int64_t y = centre[1] - 1; y <= centre[1] + 1; ++y) {
        // Cells that follow each other along z are one range.
        const auto first = std::pair(Cell{x, y, centre[2] - 1}, 0U);
        const auto last = std::pair(Cell{x, y, centre[2] + 2}, 0U);
        for (auto place = std::lower_bound(cells_.begin(), cells_.end(), first);
             place != cells_.end() && *place < last; ++place)
          vertices_.push_back(place->second);
      }
    std::sort(vertices_.begin(), vertices_.end());
    for (const std::uint32_t vertex : vertices_) found(vertex);
  }

 private:
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& point) const {
    Cell cell;
    for (std::size_t axis = 0; axis < 3; ++axis)
      cell[axis] = static_cast<std::int64_t>(std::floor(point[static_cast<Eigen::Index>(axis)] / cell_size_));
    return cell;
  }

  std::span<const Eigen::Vector3d> positions_;
  double cell_size_;
  Box box_;
  std::vector<std::pair<Cell, std::uint32_t>> cells_;
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

std::vector<NearVertexPair> near_vertices(const PlacedMesh& a, const PlacedMesh& b, double distance) {
  constexpr double wider = 1 + 0x1p-20;  // a quotient at a cell's border may round to either side
  Grid grid(a, distance * wider);
  std::vector<NearVertexPair> pairs;
  for (std::uint32_t vertex = 0; vertex < b.positions.size(); ++vertex)
    if (b.mesh.is_used(vertex))
      grid.around(b.positions[vertex], [&](std::uint32_t other) {
        if (is_near(a.positions[other], b.positions[vertex], distance)) pairs.push_back({other, vertex});
      });
  return pairs;
}

}  // namespace graze::tools
