#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace graze::tools {

/// For each value the median of the `count` values around it. At both ends it is the median of those that
/// there are. An even `count` counts as one more.
std::vector<double> running_median(std::span<const double> values, std::size_t count);

}  // namespace graze::tools
