#pragma once

#include <array>

#include "sweep/feature_signs.hpp"
#include "sweep/moving_features.hpp"

namespace graze {

/// The volume of four moving points in plain double, as a Bernstein polynomial over [0, 1] or over a part of
/// it. It is 0 where the points lie in a plane.
struct CoplanarCubic {
  std::array<double, 4> coefficient{};
  /// No coefficient and no value is further from the true one than this. It holds for parts down to
  /// `most_halvings` too. It is infinite where the sizes leave the range of the proof.
  double error = 0;

  static constexpr int most_halvings = 8;

  static CoplanarCubic of(SweptPair pair, const FeatureSweep& sweep);

  /// 1 or -1 where a value is certainly positive or negative, and 0 otherwise.
  [[nodiscard]] int sign_of(double value) const { return value > error ? 1 : value < -error ? -1 : 0; }

  /// Says what the coefficients tell of the roots inside.
  enum class Roots : unsigned char { unsure, none, one };
  [[nodiscard]] Roots roots() const;

  /// The value at a time from 0 to 1 of the interval.
  [[nodiscard]] double value_at(double time) const;

  /// Cuts the interval in its middle.
  [[nodiscard]] std::array<CoplanarCubic, 2> halves() const;
};

}  // namespace graze
