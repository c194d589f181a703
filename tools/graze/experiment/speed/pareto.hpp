#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace graze::tools {

/// What something costs, and how wrong it is: less is better.
struct CostAndError {
  double cost = 0;
  double error = 0;
};

/// Those that no other beats: none is at most as dear and at most as wrong, and better in one. By cost, then
/// as they come; those that are equal are all of it.
std::vector<std::size_t> pareto_front(std::span<const CostAndError> points);

}  // namespace graze::tools
