#pragma once

#include <array>
#include <cstdint>

#include "support/oracle/oracle.hpp"

namespace graze::tools {

/// How hard the input of a kernel is.
enum class InputKind : std::uint8_t { random, nearly_degenerate, degenerate };

inline constexpr std::array<InputKind, 3> all_input_kinds = {InputKind::random, InputKind::nearly_degenerate,
                                                             InputKind::degenerate};
inline constexpr std::array<const char*, 3> input_names = {"random", "nearly degenerate", "degenerate"};

/// Two small surfaces about 1 in size, and the distance below which their contacts count.
struct KernelScene {
  oracle::Shape a, b;
  double threshold = 0;
};

/// Scene `index` of a kind, the same for the same arguments. Nearly degenerate scenes take turns. They are
/// far from the origin (2^20 to 2^40), needles (aspect 10^3 to 10^9), or almost parallel copies. Or they are
/// copies a few ulps off, corners almost over a border, or small beside large. The last are exactly parallel
/// needles, and parallel faces a few ulps off. Degenerate scenes take turns at coarse grids, collinear and
/// repeated corners, exact touch and coplanar overlap. One scene in four has its threshold at, or an ulp
/// beside, the distance of one of its contacts.
KernelScene kernel_scene(InputKind input, std::uint64_t seed, std::uint64_t index);

}  // namespace graze::tools
