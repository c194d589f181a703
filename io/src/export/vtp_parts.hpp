#pragma once

#include <filesystem>
#include <graze/io/scene_snapshot.hpp>

namespace graze::io {

// The parts of a frame of a time series. Each is a file of VTK's PolyData.

/// All faces, quads as quads. Throws InputError where the frame is too large.
void write_vtp_surfaces(const std::filesystem::path& path, const SceneSnapshot& snapshot);
/// All contacts, as points.
void write_vtp_contacts(const std::filesystem::path& path, const SceneSnapshot& snapshot);
/// The witnesses of all rows, and the region distances, as lines.
void write_vtp_lines(const std::filesystem::path& path, const SceneSnapshot& snapshot);

}  // namespace graze::io
