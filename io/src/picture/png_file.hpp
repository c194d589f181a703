#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace graze::io {

/// Writes 8-bit RGB rows, top row first, as a PNG. Throws InputError when the file cannot be written.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace graze::io
