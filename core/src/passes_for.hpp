#pragma once

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

}  // namespace graze
