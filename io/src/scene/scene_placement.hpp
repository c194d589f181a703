#pragma once

#include <graze/io/scene_file.hpp>
#include <vector>

#include "text/json_place.hpp"

namespace graze::io {

// Where objects of a scene file stand. Both throw InputError as JsonPlace does.

/// An object's `transform`.
Placement read_placement(const JsonPlace& place);

/// An object's `poses`, ascending by frame. A key leaves out what the transform says.
std::vector<KeyPose> read_poses(const JsonPlace& place, const Placement& transform);

}  // namespace graze::io
