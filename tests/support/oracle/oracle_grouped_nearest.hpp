#pragma once

#include <vector>

#include "support/oracle/oracle.hpp"

namespace graze::oracle {

/// The contacts of `nearest` among features that are looked at: of each vertex the closest point on the faces
/// that it is looked at with, edges that no such face leads nearer or that bound a patch, and what pierces.
std::vector<Named> nearest(const Shape& a, const Shape& b, double threshold, const Shape& rest_a,
                           const Shape& rest_b, const FacePairs& pairs);

}  // namespace graze::oracle
