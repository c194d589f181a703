#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "models/models.hpp"

namespace graze::demo {

/// Each throws std::runtime_error for a file that cannot be written.

void write_obj(const std::filesystem::path& path, const models::MeshData& mesh);

/// Binary, little endian, positions in double.
void write_ply(const std::filesystem::path& path, const models::MeshData& mesh);

/// A vertex cache of one list of positions a frame.
void write_pc2(const std::filesystem::path& path, const std::vector<std::vector<Eigen::Vector3d>>& frames);

void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace graze::demo
