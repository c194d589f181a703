#include "mesh/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
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

/// A polygon in its plane, counter-clockwise, losing one corner after the other. Cutting off an ear changes
/// what its two neighbours are and nothing else, so n corners of which r are not convex cost n·r tests,
/// whatever the polygon looks like.
class EarClipper {
 public:
  EarClipper(std::span<const Eigen::Vector3d> positions, std::span<const std::uint32_t> polygon)
      : polygon_(polygon), previous_(polygon.size()), next_(polygon.size()), is_ear_(polygon.size()) {
    const Eigen::Vector3d normal = polygon_normal(positions, polygon);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index u = (axis + 1) % 3;
    const Eigen::Index v = (axis + 2) % 3;
    const double sign = normal[axis] < 0 ? -1.0 : 1.0;
    for (const auto vertex : polygon) flat_.emplace_back(positions[vertex][u], sign * positions[vertex][v]);
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      previous_[i] = (i + n - 1) % n;
      next_[i] = (i + 1) % n;
    }
    for (std::size_t i = 0; i < n; ++i)
      if (!is_convex(i)) blocking_.push_back(i);
    for (std::size_t i = 0; i < n; ++i) set_ear(i, tests_as_ear(i));
  }

  std::vector<std::array<std::uint32_t, 3>> run() {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t ear = 0;
    for (std::size_t left = polygon_.size(); left > 3; --left) {
      ear = find_ear(ear);
      triangles.push_back({polygon_[previous_[ear]], polygon_[ear], polygon_[next_[ear]]});
      cut_off(ear);
      ear = next_[ear];
    }
    triangles.push_back({polygon_[previous_[ear]], polygon_[ear], polygon_[next_[ear]]});
    return triangles;
  }

 private:
  /// The first ear from `start` on; `start` itself where rounding or crossing edges leave none.
  [[nodiscard]] std::size_t find_ear(std::size_t start) const {
    if (ears_ == 0) return start;
    std::size_t corner = start;
    while (!is_ear_[corner]) corner = next_[corner];
    return corner;
  }

  void cut_off(std::size_t ear) {
    const std::array neighbours{previous_[ear], next_[ear]};
    next_[neighbours[0]] = neighbours[1];
    previous_[neighbours[1]] = neighbours[0];
    std::erase_if(blocking_, [&](std::size_t corner) {
      return corner == ear || ((corner == neighbours[0] || corner == neighbours[1]) && is_convex(corner));
    });
    set_ear(ear, false);
    for (const std::size_t corner : neighbours) set_ear(corner, tests_as_ear(corner));
  }

  void set_ear(std::size_t corner, bool is_ear) {
    if (is_ear != is_ear_[corner]) ears_ = is_ear ? ears_ + 1 : ears_ - 1;
    is_ear_[corner] = is_ear;
  }

  [[nodiscard]] bool is_convex(std::size_t corner) const {
    return doubled_area(flat_[previous_[corner]], flat_[corner], flat_[next_[corner]]) > 0;
  }

  /// Whether a corner can be cut off as an ear: it is convex and no other corner is in its triangle. Only
  /// corners that are not convex are tested, since at least one of the corners inside a triangle is not
  /// convex.
  [[nodiscard]] bool tests_as_ear(std::size_t corner) const {
    if (!is_convex(corner)) return false;
    const auto& a = flat_[previous_[corner]];
    const auto& b = flat_[corner];
    const auto& c = flat_[next_[corner]];
    return std::ranges::none_of(blocking_, [&](std::size_t other) {
      const auto& point = flat_[other];
      if (point == a || point == b || point == c) return false;
      return doubled_area(a, b, point) >= 0 && doubled_area(b, c, point) >= 0 &&
             doubled_area(c, a, point) >= 0;
    });
  }

  std::span<const std::uint32_t> polygon_;
  std::vector<Eigen::Vector2d> flat_;
  std::vector<std::size_t> previous_, next_;
  std::vector<bool> is_ear_;
  std::size_t ears_ = 0;
  /// The corners that are not convex.
  std::vector<std::size_t> blocking_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangulate(std::span<const Eigen::Vector3d> positions,
                                                      std::span<const std::uint32_t> polygon) {
  return EarClipper(positions, polygon).run();
}

}  // namespace graze::io
