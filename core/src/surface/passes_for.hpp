#pragma once

#include <type_traits>

#include "core/surface/surface.hpp"
#include "kernels/positions.hpp"

namespace graze {

/// The passes in use over floats or doubles.
template <typename Number>
const kernels::PassesOf<Number>& passes_for() {
  if constexpr (std::is_same_v<Number, float>)
    return kernels::position_passes().floats;
  else
    return kernels::position_passes().doubles;
}

/// Positions that lie one beside the other, of the number that they have.
template <typename Number>
kernels::PointArray<Number> points_of(const PositionView& positions) {
  return {static_cast<const Number*>(positions.data()), static_cast<std::uint32_t>(positions.size() - 1)};
}

/// Calls `use` with the surface's points, which are floats or doubles.
template <typename Use>
auto with_points(const Surface& surface, const Use& use) {
  const PositionView positions = surface.positions();
  if (positions.is_double()) return use(points_of<double>(positions));
  return use(points_of<float>(positions));
}

}  // namespace graze
