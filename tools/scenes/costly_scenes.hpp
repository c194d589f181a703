#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "scenes/played_scene.hpp"

namespace graze::scenes {

/// Scenes that look like others and once cost far more, and these others, their neighbours. A small ball
/// flies over 20,000 long faces that lie across the axes, or two small bodies lie nearly in one place. They
/// are made by sums, products and roots alone, so that they are the same on every machine.
///
/// Over faces: strips_straight, strips_turned, strips_tilted, zigzag_straight, zigzag_turned, fan_of_hub,
/// fan_of_rim, road, cells. Two bodies: cones_same, cones_near and cones_apart, crates_ and balls_ alike.
std::vector<std::string_view> costly_scene_names();

/// The scene of a name at its start. Null where there is none.
std::unique_ptr<PlayedScene> make_costly_scene(std::string_view name);

/// The mesh of the two bodies of a scene. Null for a scene that is about faces.
std::shared_ptr<const Mesh> body_of_costly_scene(std::string_view name);

}  // namespace graze::scenes
