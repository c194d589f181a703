#pragma once

#include <graze/surface.hpp>
#include <type_traits>

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

/// Calls `use` with the surface's points, which are floats or doubles.
template <typename Use>
auto with_points(const Surface& surface, const Use& use) {
  const PositionView positions = surface.positions();
  const std::uint32_t last = surface.mesh().vertex_count() - 1;
  if (positions.is_double())
    return use(kernels::PointArray<double>{static_cast<const double*>(positions.data()), last});
  return use(kernels::PointArray<float>{static_cast<const float*>(positions.data()), last});
}

}  // namespace graze
