#include "triangulate.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace graze::io {
namespace {

/// Newell's normal: right for concave polygons, and an average for those that are not flat.
Eigen::Vector3d polygon_normal(std::span<const Eigen::Vector3d> positions,
                               std::span<const std::uint32_t> polygon) {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = positions[polygon[0]];
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    normal += (positions[polygon[i]] - origin).cross(positions[polygon[i + 1]] - origin);
  return normal;
}

double doubled_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// A polygon in its plane, counter-clockwise, losing one corner after the other.
class EarClipper {
 public:
  EarClipper(std::span<const Eigen::Vector3d> positions, std::span<const std::uint32_t> polygon)
      : corners_(polygon.begin(), polygon.end()) {
    const Eigen::Vector3d normal = polygon_normal(positions, polygon);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index u = (axis + 1) % 3;
    const Eigen::Index v = (axis + 2) % 3;
    const double sign = normal[axis] < 0 ? -1.0 : 1.0;
    for (const auto vertex : polygon) flat_.emplace_back(positions[vertex][u], sign * positions[vertex][v]);
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t start = 0;
    while (corners_.size() > 3) {
      const std::size_t ear = find_ear(start);
      triangles.push_back({corners_[previous(ear)], corners_[ear], corners_[next(ear)]});
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(ear));
      flat_.erase(flat_.begin() + static_cast<std::ptrdiff_t>(ear));
      start = ear % corners_.size();
    }
    triangles.push_back({corners_[0], corners_[1], corners_[2]});
    return triangles;
  }

 private:
  [[nodiscard]] std::size_t previous(std::size_t i) const {
    return (i + corners_.size() - 1) % corners_.size();
  }
  [[nodiscard]] std::size_t next(std::size_t i) const { return (i + 1) % corners_.size(); }

  /// The first ear from `start` on; `start` itself where rounding or crossing edges leave none.
  [[nodiscard]] std::size_t find_ear(std::size_t start) const {
    for (std::size_t step = 0; step < corners_.size(); ++step) {
      const std::size_t corner = (start + step) % corners_.size();
      if (is_ear(corner)) return corner;
    }
    return start;
  }

  [[nodiscard]] bool is_ear(std::size_t corner) const {
    const auto& a = flat_[previous(corner)];
    const auto& b = flat_[corner];
    const auto& c = flat_[next(corner)];
    if (!(doubled_area(a, b, c) > 0)) return false;
    for (const auto& point : flat_) {
      if (point == a || point == b || point == c) continue;
      if (doubled_area(a, b, point) >= 0 && doubled_area(b, c, point) >= 0 && doubled_area(c, a, point) >= 0)
        return false;
    }
    return true;
  }

  std::vector<std::uint32_t> corners_;
  std::vector<Eigen::Vector2d> flat_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Eigen::Vector3d> positions,
                                                      std::span<const std::uint32_t> polygon) {
  return EarClipper(positions, polygon).run();
}

}  // namespace graze::io
