#pragma once

#include "support/oracle/oracle_swept.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::oracle {

/// Two moving features of a seed. A third of them is generic, a third lies on a coarse grid, and a third is
/// made so that doubles are likely to be unsure: features that always lie in one plane or on one line, that
/// touch at the start, that hit corners or sides of each other, that do not move or have no size.
MovingPoints random_sweep(std::uint64_t seed);

}  // namespace graze::oracle
