#pragma once

#include <graze/graze.hpp>
#include <span>
#include <vector>

namespace examples {

/// Returns at most four contacts of a pair that hold a rigid body as well as all of them, where the two touch
/// in one flat place. They are the deepest one; the furthest from it; the one that spans the largest triangle
/// with these; and the one that is furthest out on the other side of the first two.
///
/// Only contacts that push nearly the way of the deepest one are chosen from. So a corner that stands over
/// the rim of a box takes no place of those on its top. Places where an edge pierces a face are left out,
/// since they have no depth. Ties go to the first contact, so the choice is the same in every run.
std::vector<graze::Contact> manifold(std::span<const graze::Contact> contacts);

}  // namespace examples
