#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "scenes/played_scene.hpp"

namespace graze::scenes {

/// Scenes of surfaces that coincide exactly, and of their neighbours in which they do not: layered tissue
/// with one interface, touching bricks, copies in one place. Most positions have all the bits of a double.
/// They are the same on every machine all the same, since they are made by sums and products alone.
///
/// layers_on and layers_off, wall_touching and wall_turned, twins_on and twins_off, spheres_on and
/// spheres_off, boxes_flush and boxes_apart, copies, character.
std::vector<std::string_view> coinciding_scene_names();

/// The scene of a name at its start. Null where there is none.
std::unique_ptr<PlayedScene> make_coinciding_scene(std::string_view name);

}  // namespace graze::scenes
