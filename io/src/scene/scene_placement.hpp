#pragma once

#include <graze/io/scene_file.hpp>
#include <vector>

#include "text/json_path.hpp"

namespace graze::io {

// Where objects of a scene file stand. Both throw InputError as JsonPath does.

/// An object's `transform`.
Placement read_placement(const JsonPath& json);

/// An object's `poses`, ascending by frame. A key leaves out what the transform says.
std::vector<KeyPose> read_poses(const JsonPath& json, const Placement& transform);

}  // namespace graze::io
