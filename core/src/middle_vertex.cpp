#include "middle_vertex.hpp"

#include <optional>

#include "arithmetic.hpp"

namespace graze {
namespace {

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

}  // namespace

std::uint32_t middle_vertex(std::span<const Eigen::Vector3d> positions,
                            std::span<const std::uint32_t> vertices) {
  const ScaledDistance<Ball> approximate(positions, vertices);
  std::optional<ScaledDistance<Exact>> exact;  // most regions never need it
  std::uint32_t best = vertices.front();
  Ball best_squared = approximate.squared(best);
  for (const std::uint32_t vertex : vertices) {
    const Ball squared = approximate.squared(vertex);
    bool unsure = false;
    int order = sign(squared - best_squared, unsure);
    if (unsure) {
      if (!exact) exact.emplace(positions, vertices);
      order = (exact->squared(vertex) - exact->squared(best)).sign();
    }
    if (order > 0 || (order == 0 && vertex >= best)) continue;
    best = vertex;
    best_squared = squared;
  }
  return best;
}

}  // namespace graze
