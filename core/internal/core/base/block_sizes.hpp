#pragma once

#include <cstdint>

namespace graze {

/// Vertices of a block (VertexBlocks), and boxes of which one box of the next level is made.
inline constexpr std::uint32_t vertices_per_block = 8;
inline constexpr std::uint32_t boxes_per_group = 16;
inline constexpr std::uint32_t vertices_per_group = vertices_per_block * boxes_per_group;
/// Vertices of a stretch (VertexStretches). Meshes of no more vertices than `most_without_stretches` have
/// none.
inline constexpr std::uint32_t vertices_per_stretch = 64;
inline constexpr std::uint32_t most_without_stretches = 8192;

}  // namespace graze
