#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/temporary_folder.hpp"

namespace graze::fuzz {

/// Puts the files beside a scene file that its seeds name: plate.obj (4 vertices, two groups in pair.obj),
/// tent.ply, plate_#.off, plate.pc2, plate.mdd and turning.gltf, which has an animation.
void write_scene_files(const tests::TemporaryFolder& folder);

/// A vertex cache of small numbers.
std::string cache_seed(bool is_pc2, std::uint32_t vertices, std::uint32_t frames);

/// Scene files that use all of them.
std::vector<std::string> scene_file_seeds();

}  // namespace graze::fuzz
