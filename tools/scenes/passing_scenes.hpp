#pragma once

#include <memory>

#include "scenes/played_scene.hpp"

namespace graze::scenes {

/// Ribbons that fold onto themselves and through themselves, and a ring that is posed. All of them are tested
/// against themselves. Groups of the first ribbon's faces are ignored against each other and watched again.
std::unique_ptr<PlayedScene> make_self_scene();

/// Balls that fly through a wall, through each other and through a ribbon that swings through itself. Most of
/// it is swept, with a gap. In each frame something jumps.
std::unique_ptr<PlayedScene> make_swept_scene();

}  // namespace graze::scenes
