#include "mesh/middle_vertex.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "arithmetic/arithmetic.hpp"
#include "core/base/box.hpp"

namespace graze {
namespace {

/// A sum of doubles that loses nothing as long as three doubles can hold it.
class LosslessSum {
 public:
  void add(double term) {
    term = pushed(first_, term);
    term = pushed(second_, term);
    term = pushed(third_, term);
    lost_ = lost_ || term != 0;
  }
  /// Takes away this many times a double.
  void subtract(double number, double factor) {
    lost_ = lost_ || number >= 0x1p26;
    // Halves of the factor's digits, so that products are exact.
    const double shifted = 0x1.0000002p27 * factor;
    const double upper = shifted - (shifted - factor);
    add(-number * upper);
    add(-number * (factor - upper));
  }
  [[nodiscard]] bool is_lost() const { return lost_; }
  [[nodiscard]] std::array<double, 3> terms() const { return {first_, second_, third_}; }
  /// The sum rounded, and what is left. Of equal sums they are equal. Nothing where two doubles do not do.
  [[nodiscard]] bool as_two(double& rounded, double& left) const {
    double low = second_, high = first_;
    double lowest = pushed(low, third_);
    low = pushed(high, low);
    lowest = pushed(low, lowest);
    left = pushed(high, low);
    rounded = high;
    return !lost_ && lowest == 0;
  }

 private:
  /// Adds a term and returns what rounding loses (Knuth).
  static double pushed(double& sum, double term) {
    const double before = sum;
    sum = before + term;
    const double added = sum - before;
    return (before - (sum - added)) + (term - added);
  }

  double first_ = 0, second_ = 0, third_ = 0;
  bool lost_ = false;
};

/// The way from one vertex to the average of n vertices, times n.
struct ScaledWay {
  std::uint32_t vertex = 0;
  std::array<LosslessSum, 3> axes;
  std::optional<Exact> square = std::nullopt;  ///< of its length, once it was asked for

  /// The magnitudes along the axes, ascending. Returns false where they need more than two doubles.
  [[nodiscard]] bool magnitudes(std::array<std::array<double, 2>, 3>& all) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto& [rounded, left] = all[axis];
      if (!axes[axis].as_two(rounded, left)) return false;
      if (rounded < 0) all[axis] = {-rounded, -left};
    }
    std::sort(all.begin(), all.end());
    return true;
  }
  [[nodiscard]] Ball squared_in_double() const {
    Ball sum;
    for (const LosslessSum& axis : axes) {
      Ball way;
      for (const double term : axis.terms()) way = way + Ball(term);
      sum = sum + way * way;
    }
    return sum;
  }
};

/// The square of the length without any rounding, of sums that lost nothing.
const Exact& exact_square(ScaledWay& way) {
  if (way.square) return *way.square;
  Exact sum(0.0);
  for (const LosslessSum& axis : way.axes) {
    const auto [first, second, third] = axis.terms();
    const Exact along = Exact(first) + Exact(second) + Exact(third);
    sum = sum + along * along;
  }
  return way.square.emplace(std::move(sum));
}

/// The order of two vertices' distances from the average, of sums that lost nothing.
int order_of(ScaledWay& left, ScaledWay& right) {
  std::array<std::array<double, 2>, 3> of_left, of_right;
  // Regular meshes are full of ties, and in most of them the ways are mirrored or turned.
  if (left.magnitudes(of_left) && right.magnitudes(of_right) && of_left == of_right) return 0;
  bool unsure = false;
  const int order = sign(left.squared_in_double() - right.squared_in_double(), unsure);
  return unsure ? (exact_square(left) - exact_square(right)).sign() : order;
}

/// n times the vector from a vertex to the average of n vertices, squared: the order of the distances without
/// a division. Everything is relative to the first vertex.
template <typename Number>
class ScaledDistance {
 public:
  ScaledDistance(std::span<const Eigen::Vector3d> positions, std::span<const std::uint32_t> vertices)
      : positions_(positions),
        origin_(positions[vertices.front()]),
        count_(static_cast<double>(vertices.size())) {
    sum_ = {Number(0.0), Number(0.0), Number(0.0)};
    for (const std::uint32_t vertex : vertices) sum_ = sum_ + difference<Number>(positions[vertex], origin_);
  }
  [[nodiscard]] Number squared(std::uint32_t vertex) const {
    const Vector<Number> gap = difference<Number>(positions_[vertex], origin_) * count_ - sum_;
    return dot(gap, gap);
  }

 private:
  std::span<const Eigen::Vector3d> positions_;
  Eigen::Vector3d origin_;
  Number count_;
  Vector<Number> sum_;
};

/// The nearest of some vertices to the average of all, where sums lose digits.
std::uint32_t nearest_of(std::span<const std::uint32_t> candidates,
                         std::span<const Eigen::Vector3d> positions,
                         std::span<const std::uint32_t> vertices) {
  const ScaledDistance<Ball> approximate(positions, vertices);
  std::optional<ScaledDistance<Exact>> exact;  // most regions never need it
  std::optional<Exact> best_exact;             // of `best`, once it was asked for
  std::uint32_t best = candidates.front();
  Ball best_squared = approximate.squared(best);
  for (const std::uint32_t vertex : candidates.subspan(1)) {
    const Ball squared = approximate.squared(vertex);
    std::optional<Exact> exact_squared;
    bool unsure = false;
    int order = sign(squared - best_squared, unsure);
    if (unsure) {
      if (!exact) exact.emplace(positions, vertices);
      if (!best_exact) best_exact = exact->squared(best);
      exact_squared = exact->squared(vertex);
      order = (*exact_squared - *best_exact).sign();
    }
    if (order > 0 || (order == 0 && vertex >= best)) continue;
    best = vertex;
    best_squared = squared;
    best_exact = std::move(exact_squared);
  }
  return best;
}

/// The vertices that may be nearest to the average, by plain doubles.
std::vector<std::uint32_t> candidates_of(std::span<const Eigen::Vector3d> positions,
                                         std::span<const std::uint32_t> vertices) {
  const Eigen::Vector3d origin = positions[vertices.front()];
  const auto count = static_cast<double>(vertices.size());
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  for (const std::uint32_t vertex : vertices) {
    const Eigen::Vector3d offset = positions[vertex] - origin;
    sum += offset;
    most = most.cwiseMax(offset.cwiseAbs());
  }
  const auto distance_squared = [&](std::uint32_t vertex) {
    return ((positions[vertex] - origin) * count - sum).squaredNorm();
  };
  double least = std::numeric_limits<double>::infinity();
  for (const std::uint32_t vertex : vertices) least = std::min(least, distance_squared(vertex));
  // Each of n sums rounds by 2^-53 of n times the furthest vertex at most, and a few operations more.
  const double off = (count + 8) * count * most.sum() * 0x1p-52 + 2 * lost_to_underflow;
  const double reach = (std::sqrt(least) * (1 + 0x1p-40) + 2 * off) * (1 + 0x1p-40);
  std::vector<std::uint32_t> candidates;
  for (const std::uint32_t vertex : vertices)
    if (distance_squared(vertex) <= reach * reach) candidates.push_back(vertex);
  return candidates;
}

}  // namespace

std::uint32_t middle_vertex(std::span<const Eigen::Vector3d> positions,
                            std::span<const std::uint32_t> vertices) {
  std::vector<std::uint32_t> candidates = candidates_of(positions, vertices);
  if (candidates.size() == 1) return candidates.front();
  std::sort(candidates.begin(), candidates.end());
  std::array<LosslessSum, 3> sum;
  for (const std::uint32_t vertex : vertices)
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis].add(positions[vertex][static_cast<int>(axis)]);
  ScaledWay best;
  for (const std::uint32_t vertex : candidates) {
    ScaledWay way{vertex, sum};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      way.axes[axis].subtract(static_cast<double>(vertices.size()),
                              positions[vertex][static_cast<int>(axis)]);
      if (way.axes[axis].is_lost()) return nearest_of(candidates, positions, vertices);
    }
    // Ties go to the lowest number, which comes first.
    if (vertex == candidates.front() || order_of(way, best) < 0) best = std::move(way);
  }
  return best.vertex;
}

}  // namespace graze
