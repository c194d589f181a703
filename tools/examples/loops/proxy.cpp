#include "examples/loops/proxy.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <bit>

namespace loops {
namespace {

constexpr double tolerance = 1e-6;  // mm

/// The three planes at most that hold the proxy, and one that it violates.
struct Candidates {
  std::array<ConstraintPlane, 4> planes;
  std::size_t count = 0;

  void add(const ConstraintPlane& plane) { planes[count++] = plane; }
  /// Returns the planes with a bit in `chosen`.
  [[nodiscard]] Candidates chosen(unsigned chosen) const {
    Candidates found;
    for (std::size_t i = 0; i < count; ++i)
      if ((chosen >> i & 1u) != 0) found.add(planes[i]);
    return found;
  }
  /// Returns how far a way leads behind the plane that it violates most.
  [[nodiscard]] double violation(const Eigen::Vector3d& way) const {
    double deepest = 0;
    for (std::size_t i = 0; i < count; ++i) deepest = std::max(deepest, planes[i].violation(way));
    return deepest;
  }
};

/// Finds the shortest way onto up to three planes. Returns false if they are nearly parallel, or if one of
/// them would have to pull.
bool find_way_onto(const Candidates& held, Eigen::Vector3d& way) {
  Eigen::Matrix3d directions = Eigen::Matrix3d::Zero(), system = Eigen::Matrix3d::Identity();
  Eigen::Vector3d wanted = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < held.count; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    directions.col(row) = held.planes[i].direction;
    wanted[row] = -held.planes[i].separation;
    for (Eigen::Index j = 0; j < row; ++j)
      system(row, j) = system(j, row) = directions.col(row).dot(directions.col(j));
  }
  if (system.determinant() < 0.01) return false;
  const Eigen::Vector3d pushes = system.inverse() * wanted;
  way = directions * pushes;
  return pushes.minCoeff() >= 0;
}

/// Returns the shortest way that violates no candidate, or else the one that violates them least. Keeps only
/// the candidates that hold it.
Eigen::Vector3d solve(Candidates& candidates) {
  Eigen::Vector3d best = Eigen::Vector3d::Zero();
  double best_violation = candidates.violation(best);
  unsigned best_chosen = 0;
  for (unsigned chosen = 1; chosen < 1u << candidates.count; ++chosen) {
    Eigen::Vector3d way;
    if (std::popcount(chosen) > 3 || !find_way_onto(candidates.chosen(chosen), way)) continue;
    const double violation = candidates.violation(way);
    const bool is_better = violation < best_violation - tolerance ||
                           (violation < best_violation + tolerance && way.norm() < best.norm());
    if (!is_better) continue;
    best = way;
    best_violation = violation;
    best_chosen = chosen;
  }
  candidates = candidates.chosen(best_chosen);
  return best;
}

}  // namespace

Eigen::Vector3d way_to_proxy(std::span<const ConstraintPlane> planes) {
  Candidates candidates;
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (int round = 0; round < 16; ++round) {
    const ConstraintPlane* worst = nullptr;
    double deepest = tolerance;
    for (const ConstraintPlane& plane : planes) {
      if (plane.violation(way) <= deepest) continue;
      deepest = plane.violation(way);
      worst = &plane;
    }
    if (worst == nullptr) break;
    candidates.add(*worst);
    way = solve(candidates);
  }
  return way;
}

}  // namespace loops
