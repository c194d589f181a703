#pragma once

#include <cstddef>

namespace graze::kernels {

/// How many contacts, or pairs of features, are worked on at once in double.
inline constexpr std::size_t contact_lanes = 8;

/// Coordinate k of a point of several of them: [k][lane].
using Points = double[3][contact_lanes];

}  // namespace graze::kernels
