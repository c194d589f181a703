#pragma once

#include <algorithm>
#include <cstdint>

namespace graze::io {

/// How many numbers a file may unfold to where its nodes share meshes and its meshes share data: 2^26, or
/// four times what is in the file. 2^26 numbers are about 5 million vertices.
inline std::uint64_t most_unfolded(std::uint64_t in_file) {
  return std::max(std::uint64_t{1} << 26U, 4 * in_file);
}

/// So many numbers count for an object beside its vertices and corners.
inline constexpr std::uint64_t numbers_of_object = 100;

}  // namespace graze::io
