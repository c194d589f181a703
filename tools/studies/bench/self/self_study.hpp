#pragma once

#include <cstddef>

#include "bench/peer_module.hpp"
#include "figures/result_table.hpp"

namespace graze::bench {

/// Lets a cloth fold into a heap, and finds in each frame where it is near itself: with graze and with
/// Bullet, at the same positions and on one thread. Where the module lacks Bullet's soft bodies, there are
/// graze's rows alone.
tools::ResultTable compare_self_contacts(const PeerModule& module, std::size_t frames);

}  // namespace graze::bench
