#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace graze::tools {

/// Returns the middle one of some values, of which there is at least one. Of an even number it is the upper
/// of the two. Changes their order.
inline double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace graze::tools
