#pragma once

#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// The same motion with each human cut into head, body, arms and legs, "in order to have more control over
/// the regions" (section 4): six objects of one group, each with a tree of its own. Faces are divided; a
/// vertex on a cut is in both parts.
RecordedMotion with_humans_in_parts(const RecordedMotion& motion);

}  // namespace graze::tools
