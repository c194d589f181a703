#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace graze::tools {

/// The cost of something, and its error: less is better in both.
struct CostAndError {
  double cost = 0;
  double error = 0;
};

/// Returns the points that no other point beats. A point beats another if its cost and its error are at most
/// those of the other, and one of them is less. The result is sorted by cost, then by index. Equal points
/// of the front are all listed.
std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace graze::tools
