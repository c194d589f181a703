#pragma once

#include <algorithm>
#include <cstdint>

namespace graze::tools {

/// How many errors there were, and the largest and mean of them. NaN counts as infinite.
class ErrorTally {
 public:
  void add(double error);

  [[nodiscard]] std::uint64_t count() const { return count_; }
  [[nodiscard]] double largest() const { return largest_; }
  [[nodiscard]] double mean() const { return count_ == 0 ? 0 : sum_ / static_cast<double>(count_); }

 private:
  std::uint64_t count_ = 0;
  double largest_ = 0;
  double sum_ = 0;
};

/// The part of a whole, from 0 to 1. Of nothing it is 1.
double share(std::uint64_t part, std::uint64_t whole);

}  // namespace graze::tools
