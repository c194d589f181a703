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

}  // namespace graze::tools
