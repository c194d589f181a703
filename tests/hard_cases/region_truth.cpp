#include "hard_cases/region_truth.hpp"

#include <algorithm>
#include <limits>

namespace graze::tests {
namespace {

/// More than rounding adds to the square of a distance of two points. Three differences,
/// three squares and two sums are each off by at most 2^-53.
constexpr double slack = 0x1p-48;

mpq_class exact_square(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
  mpq_class sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const mpq_class difference = mpq_class(p[axis]) - mpq_class(q[axis]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

RegionTruth::RegionTruth(const Surface& a, const Surface& b)
    : a_(a),
      b_(b),
      count_b_(b.mesh().regions().regions().size()),
      squared_(a.mesh().regions().regions().size() * count_b_, std::numeric_limits<double>::infinity()) {
  fill_leaves();
  fill_parents();
}

void RegionTruth::fill_leaves() {
  const RegionTree& tree_a = a_.mesh().regions();
  const RegionTree& tree_b = b_.mesh().regions();
  for (std::uint32_t i = 0; i < tree_a.regions().size(); ++i) {
    if (!tree_a.region(i).is_leaf()) continue;
    for (std::uint32_t j = 0; j < count_b_; ++j) {
      if (!tree_b.region(j).is_leaf()) continue;
      double& least = squared_[i * count_b_ + j];
      for (const std::uint32_t p : tree_a.vertices(tree_a.region(i)))
        for (const std::uint32_t q : tree_b.vertices(tree_b.region(j)))
          least = std::min(least, (b_.position(q) - a_.position(p)).squaredNorm());
    }
  }
}

/// A region's vertices are those of its children, whose numbers are higher.
void RegionTruth::fill_parents() {
  const RegionTree& tree_a = a_.mesh().regions();
  const RegionTree& tree_b = b_.mesh().regions();
  for (std::uint32_t i = 0; i < tree_a.regions().size(); ++i) {
    if (!tree_a.region(i).is_leaf()) continue;
    for (auto j = static_cast<std::uint32_t>(count_b_); j-- > 1;) {
      double& parent = squared_[i * count_b_ + tree_b.region(j).parent];
      parent = std::min(parent, squared(i, j));
    }
  }
  for (auto i = static_cast<std::uint32_t>(tree_a.regions().size()); i-- > 1;)
    for (std::uint32_t j = 0; j < count_b_; ++j) {
      double& parent = squared_[std::size_t{tree_a.region(i).parent} * count_b_ + j];
      parent = std::min(parent, squared(i, j));
    }
}

mpq_class RegionTruth::exact_squared(std::uint32_t region_a, std::uint32_t region_b) const {
  ++exact_count_;
  const RegionTree& tree_a = a_.mesh().regions();
  const RegionTree& tree_b = b_.mesh().regions();
  const double limit = squared(region_a, region_b) * (1 + 4 * slack);
  mpq_class least = -1;
  for (const std::uint32_t p : tree_a.vertices(tree_a.region(region_a)))
    for (const std::uint32_t q : tree_b.vertices(tree_b.region(region_b))) {
      if ((b_.position(q) - a_.position(p)).squaredNorm() > limit) continue;
      const mpq_class square = exact_square(a_.position(p), b_.position(q));
      if (least < 0 || square < least) least = square;
    }
  return least;
}

bool RegionTruth::is_at_least(std::uint32_t region_a, std::uint32_t region_b, double lower) const {
  const double square = squared(region_a, region_b);
  if (lower * lower <= square * (1 - slack)) return true;
  return mpq_class(lower) * mpq_class(lower) <= exact_squared(region_a, region_b);
}

bool RegionTruth::is_at_most(std::uint32_t region_a, std::uint32_t region_b, double upper) const {
  const double square = squared(region_a, region_b);
  if (upper * upper >= square * (1 + slack)) return true;
  return mpq_class(upper) * mpq_class(upper) >= exact_squared(region_a, region_b);
}

}  // namespace graze::tests
