#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

namespace graze {

// Decisions about closest points that plain double is certain of, by error bounds that come from the
// features' sizes alone (docs/numerics.md). Ball and Exact decide the others, and would have decided these in
// the same way. Most pairs of features need neither.

/// The truth of a squared distance lies between these.
struct SquaredRange {
  double low = 0;
  double high = std::numeric_limits<double>::infinity();

  /// Whether the distance is certainly below a limit, or certainly not.
  [[nodiscard]] bool is_below(double limit) const { return high < limit * limit * (1 - 0x1p-50); }
  [[nodiscard]] bool is_beyond(double limit) const { return low > limit * limit * (1 + 0x1p-50) + 0x1p-1000; }
};

/// That of two points: five roundings at most, and what underflow loses.
inline SquaredRange squared_range(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double squared = (b - a).squaredNorm();
  return {squared * (1 - 0x1p-50) - 0x1p-1000, squared * (1 + 0x1p-50) + 0x1p-1000};
}

/// Whether two differences of points, rounded, are certainly of directions that are not parallel.
bool certainly_not_parallel(const Eigen::Vector3d& u, const Eigen::Vector3d& v);

/// The Voronoi region of a triangle (0, 1, 2) that a point lies in.
enum class VoronoiRegion : std::uint8_t {
  vertex0,
  vertex1,
  vertex2,
  edge01,
  edge12,
  edge20,
  inside,
  no_area
};

/// Finds the Voronoi region of `point`. Returns false where double is not certain of it.
bool certain_voronoi(const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& corner,
                     VoronoiRegion& region, SquaredRange& squared);

/// The position of a closest point on a segment.
enum class Along : std::uint8_t { first, second, inside };

/// Finds the positions of two segments' closest points. Returns false where double is not certain. They are
/// then one pair of points, and not inside a common stretch.
bool certain_along(const std::array<Eigen::Vector3d, 2>& a, const std::array<Eigen::Vector3d, 2>& b,
                   std::array<Along, 2>& along, SquaredRange& squared);

/// Whether two segments are certainly apart. It may say no of segments that are.
bool certainly_apart(const std::array<Eigen::Vector3d, 2>& a, const std::array<Eigen::Vector3d, 2>& b);

/// Whether a segment passes through the inside of a triangle, from one side of its plane to the other.
enum class Passing : std::uint8_t { unsure, no, yes };
Passing certain_passing(const std::array<Eigen::Vector3d, 2>& segment,
                        const std::array<Eigen::Vector3d, 3>& corner);

}  // namespace graze
