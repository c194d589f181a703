#include "mesh/triangulate.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/corner_tree.hpp"

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

/// A polygon in its plane, counter-clockwise, losing one corner after the other. Cutting off an ear changes
/// what its two neighbours are and nothing else. Which corners are in the way of an ear is asked of a tree of
/// their places, so n corners cost about n times the square root of n.
class EarClipper {
 public:
  EarClipper(std::span<const Eigen::Vector3d> positions, std::span<const std::uint32_t> polygon)
      : polygon_(polygon), flat_(flattened(positions, polygon)) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
      previous_.push_back((i + n - 1) % n);
      next_.push_back((i + 1) % n);
    }
    for (std::size_t i = 0; i < n; ++i) is_blocking_.push_back(!is_convex(i));
    places_.emplace(flat_, is_blocking_);
    for (std::size_t i = 0; i < n; ++i) set_ear(i, tests_as_ear(i));
  }

  /// Nothing where the search takes too long.
  std::optional<std::vector<std::array<std::uint32_t, 3>>> run() {
    constexpr std::uint64_t most_tests = 200'000'000;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t ear = 0;
    for (std::size_t left = polygon_.size(); left > 3; --left) {
      ear = find_ear(ear);
      triangles.push_back({polygon_[previous_[ear]], polygon_[ear], polygon_[next_[ear]]});
      cut_off(ear);
      ear = next_[ear];
      if (places_->tests() > most_tests) return std::nullopt;
    }
    triangles.push_back({polygon_[previous_[ear]], polygon_[ear], polygon_[next_[ear]]});
    return triangles;
  }

 private:
  static std::vector<Eigen::Vector2d> flattened(std::span<const Eigen::Vector3d> positions,
                                                std::span<const std::uint32_t> polygon) {
    const Eigen::Vector3d normal = polygon_normal(positions, polygon);
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const Eigen::Index u = (axis + 1) % 3;
    const Eigen::Index v = (axis + 2) % 3;
    const double sign = normal[axis] < 0 ? -1.0 : 1.0;
    std::vector<Eigen::Vector2d> flat;
    // Numbers that are not finite have no order. A mesh that uses one is refused later.
    const auto finite = [](double number) { return std::isfinite(number) ? number : 0.0; };
    for (const auto vertex : polygon)
      flat.emplace_back(finite(positions[vertex][u]), finite(sign * positions[vertex][v]));
    return flat;
  }

  /// The first ear from `start` on, or `start` itself where rounding or crossing edges leave none.
  [[nodiscard]] std::size_t find_ear(std::size_t start) const {
    if (ears_.empty()) return start;
    const auto ear = ears_.lower_bound(start);
    return ear == ears_.end() ? *ears_.begin() : *ear;
  }

  void cut_off(std::size_t ear) {
    const std::array neighbours{previous_[ear], next_[ear]};
    next_[neighbours[0]] = neighbours[1];
    previous_[neighbours[1]] = neighbours[0];
    stop_blocking(ear);
    for (const std::size_t corner : neighbours)
      if (is_convex(corner)) stop_blocking(corner);
    set_ear(ear, false);
    for (const std::size_t corner : neighbours) set_ear(corner, tests_as_ear(corner));
  }

  void set_ear(std::size_t corner, bool is_ear) {
    if (is_ear)
      ears_.insert(corner);
    else
      ears_.erase(corner);
  }

  void stop_blocking(std::size_t corner) {
    if (!is_blocking_[corner]) return;
    is_blocking_[corner] = false;
    places_->remove(corner);
  }

  [[nodiscard]] bool is_convex(std::size_t corner) const {
    return doubled_area(flat_[previous_[corner]], flat_[corner], flat_[next_[corner]]) > 0;
  }

  /// Whether a corner can be cut off as an ear: it is convex and no other corner is in its triangle. Only
  /// corners that are not convex are tested, since at least one of the corners inside a triangle is not
  /// convex.
  [[nodiscard]] bool tests_as_ear(std::size_t corner) const {
    return is_convex(corner) &&
           !places_->any_inside(flat_[previous_[corner]], flat_[corner], flat_[next_[corner]]);
  }

  std::span<const std::uint32_t> polygon_;
  std::vector<Eigen::Vector2d> flat_;
  std::vector<std::size_t> previous_, next_;
  std::set<std::size_t> ears_;
  std::vector<bool> is_blocking_;     ///< whether a corner is not convex
  std::optional<CornerTree> places_;  ///< of the corners that block
};

}  // namespace

std::optional<std::vector<std::array<std::uint32_t, 3>>> triangulate(
    std::span<const Eigen::Vector3d> positions, std::span<const std::uint32_t> polygon) {
  return EarClipper(positions, polygon).run();
}

}  // namespace graze::io
