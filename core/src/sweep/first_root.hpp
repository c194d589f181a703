#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "sweep/exact_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

/// Finds the first root of a polynomial in ]0, 1[ at which a condition holds. The condition is
/// `holds(time, near)`, with a TimeAsNumber or a TimeAsRoot, and a ball that holds that time.
///
/// It goes through the roots from the left. An interval between doubles is halved until it holds one root.
/// Roots that are closer than `finest_width` are told apart by exact numbers, as far as the budget goes.
template <typename Number, typename Condition>
class FirstRoot {
 public:
  /// The bounds of a reported time are at most this far apart. Its eighth is a unit of doubles below 1.
  static constexpr double finest_width = 0x1p-50;

  /// The polynomial is not zero everywhere.
  FirstRoot(const Polynomial<Number>& polynomial, const Condition& holds, std::uint64_t& budget)
      : polynomial_(without_ends(polynomial)), chain_(polynomial_), holds_(&holds), budget_(&budget) {}

  std::optional<SweptMeeting> find() {
    End from = end_at(0);
    const End last = end_at(1);
    while (from.changes > last.changes) {
      Interval interval = isolate(from, last);
      from = interval.high;
      if (const auto meeting = meeting_in(interval)) return meeting;
    }
    return std::nullopt;
  }

 private:
  /// A time that is no root, and how often the signs of the chain change there.
  struct End {
    double time = 0;
    int changes = 0;
  };
  struct Interval {
    End low, high;
    [[nodiscard]] int roots() const { return low.changes - high.changes; }
    [[nodiscard]] double width() const { return high.time - low.time; }
  };

  static Polynomial<Number> without_ends(Polynomial<Number> polynomial) {
    polynomial.remove_root_at_zero();
    polynomial.remove_root_at_one();
    return polynomial;
  }

  [[nodiscard]] End end_at(double time) const { return {time, chain_.signs_at(Number(time)).changes}; }

  /// The first part of an interval that holds one root, or more than one at the finest width.
  [[nodiscard]] Interval isolate(const End& low, const End& high) const {
    Interval interval = {low, high};
    while (interval.roots() > 1 && interval.width() > finest_width) {
      const End middle = end_at(split(interval.low.time, interval.high.time));
      (interval.low.changes > middle.changes ? interval.high : interval.low) = middle;
    }
    return interval;
  }

  /// A number between two others that is no root. Of four, one is none, since there are three roots at most.
  template <typename Time>
  [[nodiscard]] Time split(const Time& low, const Time& high) const {
    for (const double fraction : {0.5, 0.25, 0.75}) {
      const Time time = low + (high - low) * Time(fraction);
      if (polynomial_.value_at(Number(time)).sign() != 0) return time;
    }
    return low + (high - low) * Time(0.375);
  }

  std::optional<SweptMeeting> meeting_in(Interval& interval) {
    if (interval.roots() > 1) return meeting_at_close_roots(interval);
    if (const std::optional<double> time = refine(interval)) {
      const TimeAsNumber<Number> exact = {Number(*time)};
      if ((*holds_)(exact, Ball(*time))) return SweptMeeting{*time, *time, ImpactStatus::certain};
      return std::nullopt;
    }
    const Number low(interval.low.time);
    const Number high(interval.high.time);
    const TimeAsRoot<Number> root = {&polynomial_, &low, &high};
    if ((*holds_)(root, ball_of(interval))) return certain(interval);
    return std::nullopt;
  }

  /// Makes an interval with one root as small as `finest_width`. Returns the root if it hits it.
  std::optional<double> refine(Interval& interval) const {
    const double guess = guess_root(interval.low.time, interval.high.time);
    for (double off = finest_width / 2; off < 1 && interval.width() > finest_width; off *= 0x1p12)
      for (const double time : {guess - off, guess + off})
        if (hits(interval, time)) return time;
    while (interval.width() > finest_width) {
      const double time = interval.low.time + interval.width() / 2;
      if (hits(interval, time)) return time;
    }
    return std::nullopt;
  }

  /// Cuts off the side of a time on which the root is not. Returns whether the time is the root.
  bool hits(Interval& interval, double time) const {
    if (time <= interval.low.time || time >= interval.high.time) return false;
    const auto signs = chain_.signs_at(Number(time));
    if (signs.first == 0) return true;
    (interval.low.changes > signs.changes ? interval.high : interval.low) = {time, signs.changes};
    return false;
  }

  /// The root in double, without any certainty: a multiple of 2^-53.
  [[nodiscard]] double guess_root(double low, double high) const {
    std::array<double, Polynomial<Number>::max_degree + 1> coefficient{};
    int exponent = polynomial_[polynomial_.degree()].scaled().exponent;
    for (int i = 0; i <= polynomial_.degree(); ++i)
      if (polynomial_[i].sign() != 0) exponent = std::max(exponent, polynomial_[i].scaled().exponent);
    for (int i = 0; i <= polynomial_.degree(); ++i) {
      const auto scaled = polynomial_[i].scaled();
      coefficient[static_cast<std::size_t>(i)] =
          std::ldexp(scaled.fraction, std::max(scaled.exponent - exponent, -2000));
    }
    const auto value = [&](double time) {
      return ((coefficient[3] * time + coefficient[2]) * time + coefficient[1]) * time + coefficient[0];
    };
    const auto slope = [&](double time) {
      return (3 * coefficient[3] * time + 2 * coefficient[2]) * time + coefficient[1];
    };
    // A root of even order shows in the slope.
    const double root =
        value(low) * value(high) < 0 ? bisected(value, low, high) : bisected(slope, low, high);
    return std::nearbyint(root * 0x1p53) * 0x1p-53;
  }

  template <typename Function>
  static double bisected(const Function& function, double low, double high) {
    const bool rises = function(high) > 0;
    for (int i = 0; i < 54; ++i) {
      const double middle = low + (high - low) / 2;
      ((function(middle) > 0) == rises ? high : low) = middle;
    }
    return low;
  }

  std::optional<SweptMeeting> meeting_at_close_roots(const Interval& interval) {
    Number low(interval.low.time);
    const Number end(interval.high.time);
    int low_changes = interval.low.changes;
    while (low_changes > interval.high.changes) {
      Number high = end;
      int high_changes = interval.high.changes;
      while (low_changes - high_changes > 1) {
        if (*budget_ == 0) return SweptMeeting{interval.low.time, interval.high.time, ImpactStatus::possible};
        --*budget_;
        const Number middle = split(low, high);
        const int changes = chain_.signs_at(middle).changes;
        (low_changes > changes ? high : low) = middle;
        (low_changes > changes ? high_changes : low_changes) = changes;
      }
      const TimeAsRoot<Number> root = {&polynomial_, &low, &high};
      if ((*holds_)(root, ball_of(interval))) return certain(interval);
      low = high;
      low_changes = high_changes;
    }
    return std::nullopt;
  }

  static SweptMeeting certain(const Interval& interval) {
    return {interval.low.time, interval.high.time, ImpactStatus::certain};
  }

  /// A ball around an interval. The middle rounds by 2^-54 at most.
  static Ball ball_of(const Interval& interval) {
    return {interval.low.time + interval.width() / 2, interval.width() / 2 + 0x1p-53};
  }

  Polynomial<Number> polynomial_;
  SturmChain<Number> chain_;
  const Condition* holds_;
  std::uint64_t* budget_;
};

}  // namespace graze
