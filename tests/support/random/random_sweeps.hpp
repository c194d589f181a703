#pragma once

#include "support/oracle/oracle_swept.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::oracle {

/// Two moving features of a seed. A third of them is generic, and a third lies on a coarse grid.
///
/// The last third is made so that doubles are likely to be unsure. These features always lie in one plane or
/// on one line, or they touch at the start. Others hit corners or sides of each other, do not move, or have
/// no size.
MovingPoints random_sweep(std::uint64_t seed);

}  // namespace graze::oracle
