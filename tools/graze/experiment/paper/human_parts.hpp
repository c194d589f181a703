#pragma once

#include "experiment/recorded_motion.hpp"

namespace graze::tools {

/// The same motion with each human cut into head, body, arms and legs, "in order to have more control over
/// the regions" (section 4): six objects of one group, each with a tree of its own. Faces are divided; a
/// vertex on a cut is in both parts. Of the frames one in `every` is kept, the last among them; `every` > 0.
RecordedMotion with_humans_in_parts(const RecordedMotion& motion, std::size_t every);

}  // namespace graze::tools
