#pragma once

#include "support/exact/exact_distance.hpp"

namespace graze::oracle {

/// The exact square of the smallest distance between two surfaces, diagonals and insides included.
Rational smallest_distance_squared(const ExactShape& a, const ExactShape& b, const FacePairs& pairs = {});

/// Whether an edge of one passes through a face of the other.
bool is_pierced(const ExactShape& a, const ExactShape& b, const FacePairs& pairs = {});

}  // namespace graze::oracle
