#pragma once

#include <cstdint>
#include <filesystem>

#include "io/page/page_play.hpp"

namespace graze::tests {

/// Checks that a page has each `every`th frame of a scene, down to the bits of all numbers but positions.
/// Positions of deformable objects are as near as the page says.
void compare_page(const std::filesystem::path& file, const PagePlay& scene, std::uint64_t every);

}  // namespace graze::tests
