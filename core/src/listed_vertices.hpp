#pragma once

#include <cstdint>
#include <graze/surface.hpp>
#include <span>

#include "filter_frame.hpp"

namespace graze {

/// Listed vertices of a surface in a frame. Of those too large for the kernels the coordinates are left out,
/// and the size says so.
void bring(const Surface& surface, std::span<const std::uint32_t> vertices, const FilterFrame& frame,
           kernels::Point* brought);

}  // namespace graze
