#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace graze::tools {

/// Quantiles of measured values.
class Distribution {
 public:
  explicit Distribution(std::vector<double> values);

  /// The smallest value that at least `part` of the values do not exceed; NaN without values.
  [[nodiscard]] double quantile(double part) const;
  [[nodiscard]] double median() const { return quantile(0.5); }
  /// p50, p99, p99.9 and max.
  [[nodiscard]] nlohmann::ordered_json figures() const;

 private:
  std::vector<double> sorted_;
};

}  // namespace graze::tools
