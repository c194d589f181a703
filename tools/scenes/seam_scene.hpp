#pragma once

#include <memory>

#include "scenes/played_scene.hpp"

namespace graze::scenes {

/// A sheet that is sewn to a second one along a seam, and cut, while a ball presses into both. Faces along
/// the seam are in groups that are ignored and watched again. A cut replaces the mesh of the sheet.
std::unique_ptr<PlayedScene> make_seam_scene();

}  // namespace graze::scenes
