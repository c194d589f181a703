#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace graze::io {

/// Refuses what assimp (5.2) takes on trust and then reads out of bounds, divides by or misreads: accessors
/// whose numbers are no floats where it expects them, and counts that do not belong together. Throws
/// InputError.
void check_gltf(const std::filesystem::path& path, const nlohmann::json& document);

}  // namespace graze::io
