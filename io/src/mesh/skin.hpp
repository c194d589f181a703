#pragma once

#include <vector>

#include "mesh/rig.hpp"

namespace graze::io {

/// Finishes the skin of a body whose influences name joints, in any order. A vertex then has its influences
/// in order of bones, each bone once. The body gets those joints as bones that hold a vertex. Many bodies may
/// share a skin of many joints and each use a few.
void set_bones(Body& body, const std::vector<Bone>& joints);

}  // namespace graze::io
