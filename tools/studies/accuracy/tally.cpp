#include "accuracy/tally.hpp"

#include <cmath>
#include <limits>

namespace graze::tools {

void ErrorTally::add(double error) {
  if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
  ++count_;
  largest_ = std::max(largest_, error);
  sum_ += error;
}

double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 1 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace graze::tools
