#include "figures/axis.hpp"

#include <algorithm>
#include <cmath>

namespace graze::tools {

Axis::Axis(const Figure& figure, char letter)
    : letter_(letter),
      is_log_(letter == 'x' ? figure.log_x : figure.log_y),
      ends_with_values_(letter == 'x' && figure.named_at_ends) {
  for (const Series& series : figure.series)
    for (const double value : letter == 'x' ? series.x : series.y) add(value);
}

void Axis::add(double value) {
  if (is_log_ && value <= 0) {
    has_zero_ = true;
  } else if (std::isfinite(value)) {
    low_ = std::min(low_, value);
    high_ = std::max(high_, value);
  }
}

double Axis::zero() const {
  return std::isfinite(low_) ? std::pow(10, std::floor(std::log10(low_) + 1e-9) - 1) : 1e-3;
}

double Axis::top() const {
  return std::isfinite(high_) ? high_ : zero();
}

double Axis::room() const {
  return std::max(1.3, std::pow(top() / bottom(), 0.07));
}

double Axis::first() const {
  if (is_log_) return bottom() / room();
  return low_ >= 0 && low_ < 0.5 * high_ ? 0 : low_ - 0.05 * (high_ - low_);
}

double Axis::last() const {
  if (is_log_) return top() * room();
  if (high_ <= first()) return first() + 1;
  return ends_with_values_ ? high_ : high_ + 0.07 * (high_ - first());
}

double Axis::part(double value) const {
  if (is_log_) return std::log(place(value) / first()) / std::log(last() / first());
  return (value - first()) / (last() - first());
}

std::vector<double> Axis::ticks() const {
  std::vector<double> ticks;
  if (!is_log_ || has_zero_ || last() >= 100 * first()) return ticks;
  for (double decade = std::pow(10, std::floor(std::log10(first()))); decade <= last(); decade *= 10)
    for (const double tick : {decade, 2 * decade, 5 * decade})
      if (tick >= first() && tick <= last()) ticks.push_back(tick);
  return ticks;
}

}  // namespace graze::tools
