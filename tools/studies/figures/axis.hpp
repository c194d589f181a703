#pragma once

#include <limits>
#include <vector>

#include "figures/figure.hpp"

namespace graze::tools {

/// An axis of a figure. On a logarithmic axis 0 is drawn a decade below all else.
class Axis {
 public:
  Axis(const Figure& figure, char letter);

  [[nodiscard]] char letter() const { return letter_; }
  [[nodiscard]] bool is_log() const { return is_log_; }
  [[nodiscard]] bool has_zero() const { return has_zero_; }
  /// The value in whose place 0 is drawn on a logarithmic axis.
  [[nodiscard]] double zero() const;
  [[nodiscard]] double place(double value) const { return is_log_ && value <= 0 ? zero() : value; }
  /// The ends of the axis. It has some room on both sides of the values shown.
  [[nodiscard]] double first() const;
  [[nodiscard]] double last() const;
  /// 0 where the axis begins, 1 where it ends.
  [[nodiscard]] double part(double value) const;
  /// 1, 2 and 5 times the powers of 10, for a logarithmic axis of less than two decades. Otherwise none:
  /// gnuplot's own are well then.
  [[nodiscard]] std::vector<double> ticks() const;

 private:
  void add(double value);
  [[nodiscard]] double bottom() const { return has_zero_ ? zero() : low_; }
  [[nodiscard]] double top() const;
  [[nodiscard]] double room() const;

  char letter_;
  bool is_log_;
  bool ends_with_values_;                                 ///< no room after the last value
  double low_ = std::numeric_limits<double>::infinity();  ///< positive, or finite if not log
  double high_ = -std::numeric_limits<double>::infinity();
  bool has_zero_ = false;
};

}  // namespace graze::tools
