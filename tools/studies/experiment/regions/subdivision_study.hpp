#pragma once

#include "experiment/options.hpp"
#include "experiment/study.hpp"

namespace graze::tools {

/// The octree compared with other ways to divide a mesh into regions (section 3.1 of the paper names
/// clustering and edge collapse), with boxes and with the paper's spheres over them, in rigid motion and
/// under large deformation. Every near pair of vertices must be found over each. Otherwise there are
/// violations.
Study subdivision_study(const ExperimentOptions& options);

}  // namespace graze::tools
