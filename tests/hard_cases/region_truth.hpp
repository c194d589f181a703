#pragma once

#include <gmpxx.h>

#include <vector>

#include "core/surface/surface.hpp"

namespace graze::tests {

/// The smallest distance of a vertex of one region and one of another, for all pairs of regions of two
/// surfaces: brute force in double with a bound on its rounding, and exactly where that does not decide.
class RegionTruth {
 public:
  RegionTruth(const Surface& a, const Surface& b);

  /// Whether lower ≤ the smallest distance between the vertices of two regions, by their numbers.
  [[nodiscard]] bool is_at_least(std::uint32_t region_a, std::uint32_t region_b, double lower) const;
  /// Whether that distance ≤ upper.
  [[nodiscard]] bool is_at_most(std::uint32_t region_a, std::uint32_t region_b, double upper) const;
  /// How many questions went to exact arithmetic.
  [[nodiscard]] std::size_t exact_count() const { return exact_count_; }

 private:
  [[nodiscard]] double squared(std::uint32_t region_a, std::uint32_t region_b) const {
    return squared_[std::size_t{region_a} * count_b_ + region_b];
  }
  [[nodiscard]] mpq_class exact_squared(std::uint32_t region_a, std::uint32_t region_b) const;
  void fill_leaves();
  void fill_parents();

  const Surface& a_;
  const Surface& b_;
  std::size_t count_b_;
  std::vector<double> squared_;  ///< in double, by both regions' numbers
  mutable std::size_t exact_count_ = 0;
};

}  // namespace graze::tests
