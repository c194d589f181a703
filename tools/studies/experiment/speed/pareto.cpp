#include "experiment/speed/pareto.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace graze::tools {

std::vector<std::size_t> pareto_front(std::span<const CostAndError> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {},
                           [&](std::size_t i) { return std::tie(points[i].cost, points[i].error); });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const CostAndError& point = points[i];
    if (!front.empty()) {
      const CostAndError& last = points[front.back()];
      const bool is_equal = point.cost == last.cost && point.error == last.error;
      if (!is_equal && point.error >= last.error) continue;
    }
    front.push_back(i);
  }
  return front;
}

}  // namespace graze::tools
