#pragma once

#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// Cuts each human of a motion into head, body, arms and legs, "in order to have more control over the
/// regions" (section 4). The motion stays the same. The six objects are of one group, and each has a tree of
/// its own. Faces are divided. A vertex on a cut is in both parts. One frame in `every` is kept, and the last
/// frame is among them. `every` > 0.
RecordedMotion with_humans_in_parts(const RecordedMotion& motion, std::size_t every);

}  // namespace graze::tools
