#pragma once

#include <cstddef>

#include "core/pair/pair_answer.hpp"

namespace graze {

/// Leaves in an answer of `ContactDetail::nearest` so many contacts at most: those of the lowest
/// contact_rank(), and of equal ones those that come first. Says so in PairFinding::cut.
void keep_deepest(PairAnswer& answer, std::size_t most);

}  // namespace graze
