#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/wide.hpp"

namespace graze {

/// The unit vector along a vector of which the leading bits are given, each component to a relative error of
/// some 2^-50. Returns nothing for zero.
inline std::optional<Eigen::Vector3d> unit(const std::array<Exact::Scaled, 3>& scaled) {
  std::optional<int> exponent;
  for (const Exact::Scaled& part : scaled)
    if (part.fraction != 0) exponent = std::max(exponent.value_or(part.exponent), part.exponent);
  if (!exponent) return std::nullopt;
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis) {
    const Exact::Scaled& part = scaled[static_cast<std::size_t>(axis)];
    result[axis] =
        part.fraction == 0 ? 0 : std::ldexp(part.fraction, std::max(part.exponent - *exponent, -2000));
  }
  return result.normalized();
}

/// The unit vector along `vector.operator()<Number>()`, within some 2^-44 of the true one. Returns nothing
/// where that is zero.
template <typename VectorOf>
std::optional<Eigen::Vector3d> unit_direction(DecisionCount& count, const VectorOf& vector) {
  const Vector<Ball> ball = vector.template operator()<Ball>();
  const Eigen::Vector3d middle(ball.x.value, ball.y.value, ball.z.value);
  // The sum in the order of the kernels in kernels/measure_kernels.inc.
  const double size =
      std::sqrt((middle.x() * middle.x() + middle.y() * middle.y()) + middle.z() * middle.z());
  const double radius = ball.x.radius + ball.y.radius + ball.z.radius;
  if (size > 0x1p-450 && size < 0x1p450 && radius <= size * 0x1p-44) return middle / size;
  const Vector<Wide> wide = vector.template operator()<Wide>();
  const auto x = scaled(wide.x);
  const auto y = scaled(wide.y);
  const auto z = scaled(wide.z);
  if (x && y && z) return unit({*x, *y, *z});
  ++count.exact;
  const Vector<Exact> exact = vector.template operator()<Exact>();
  return unit({exact.x.scaled(), exact.y.scaled(), exact.z.scaled()});
}

}  // namespace graze
