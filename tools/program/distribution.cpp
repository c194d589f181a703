#include "distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace graze::tools {

Distribution::Distribution(std::vector<double> values) : sorted_(std::move(values)) {
  std::sort(sorted_.begin(), sorted_.end());
}

double Distribution::quantile(double part) const {
  if (sorted_.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted_.size())));
  return sorted_[std::clamp<std::size_t>(rank, 1, sorted_.size()) - 1];
}

nlohmann::ordered_json Distribution::figures() const {
  return {{"p50", quantile(0.5)}, {"p99", quantile(0.99)}, {"p99.9", quantile(0.999)}, {"max", quantile(1)}};
}

}  // namespace graze::tools
