#include "figures/running_median.hpp"

#include <algorithm>

namespace graze::tools {
namespace {

double median_of(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

}  // namespace

std::vector<double> running_median(std::span<const double> values, std::size_t count) {
  const std::size_t reach = count / 2;
  std::vector<double> medians;
  medians.reserve(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t first = i < reach ? 0 : i - reach;
    const std::size_t end = std::min(values.size(), i + reach + 1);
    const std::span<const double> around = values.subspan(first, end - first);
    medians.push_back(median_of({around.begin(), around.end()}));
  }
  return medians;
}

}  // namespace graze::tools
