#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace graze::fuzz {

/// Stands in every diagnostic that a made recording tells of.
inline constexpr std::string_view made_message = "made";

/// Writes a recording that the bytes choose: meshes, and records of every kind. Most of them fit the objects
/// that are there, and some do not. Checksums, hashes and the index are right.
void make_recording(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace graze::fuzz
