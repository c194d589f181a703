#pragma once

#if defined(__AVX2__)
#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace graze::bench {

/// For each of eight bits, which lanes come first when those of its set bits are moved to the front.
inline constexpr std::array<std::array<std::uint32_t, 8>, 256> front_lanes = [] {
  std::array<std::array<std::uint32_t, 8>, 256> table{};
  for (std::uint32_t mask = 0; mask < 256; ++mask) {
    std::size_t next = 0;
    for (std::uint32_t lane = 0; lane < 8; ++lane)
      if ((mask >> lane & 1U) != 0) table[mask][next++] = lane;
  }
  return table;
}();

/// The lanes to permute by.
inline __m256i lanes_of(std::uint32_t mask) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(front_lanes[mask].data()));
}

}  // namespace graze::bench
#endif
