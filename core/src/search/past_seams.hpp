#pragma once

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/pair_answer.hpp"
#include "core/pair/pair_query.hpp"

namespace graze {

/// Leaves out contacts of `ContactDetail::nearest` that lie past a seam of hidden faces. The seen face goes
/// on behind a seam, so what is nearest to a point past it is no place of this surface. What is nearest to a
/// vertex of a seam may also lie far to the other side of it, where the seen face is nearer. Where the way
/// leads within 10.2° of square to the seen face, or a vertex is inside a solid, the contact stays.
void leave_out_past_seams(const SurfacePair& pair, const PairQuery& query, PairAnswer& answer);

}  // namespace graze
