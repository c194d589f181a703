#pragma once

#include <cstddef>
#include <cstdint>

namespace graze::kernels {

/// How many contacts, or pairs of features, are worked on at once in double.
inline constexpr std::size_t contact_lanes = 8;

/// Coordinate k of a point of several of them: [k][lane].
using Points = double[3][contact_lanes];

/// Points of three numbers each, and the number of the last: behind that nothing may be read.
template <typename Number>
struct PointArray {
  const Number* numbers;
  std::uint32_t last;
};

}  // namespace graze::kernels
