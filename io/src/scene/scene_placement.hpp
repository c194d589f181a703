#pragma once

#include <graze/io/scene_file.hpp>
#include <vector>

#include "text/json_path.hpp"

namespace graze::io {

// Readers for the transforms and poses of objects in a scene file. Both throw InputError as JsonPath does.

/// An object's `transform`.
Placement read_placement(const JsonPath& json);

/// An object's `poses`, ascending by frame. A key leaves out what the transform says.
std::vector<KeyPose> read_poses(const JsonPath& json, const Placement& transform);

}  // namespace graze::io
