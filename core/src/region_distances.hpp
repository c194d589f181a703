#pragma once

#include <graze/pair_query.hpp>

#include "contact_name.hpp"
#include "dmv.hpp"

namespace graze {

/// The distances of a pair that are alive (the paper's cd, section 3.2): walks the regions level by level and
/// lists the pairs that pass the mode's test, until there are `query.region_distance_limit`. Both surfaces
/// are refitted now.
void find_region_distances(const SurfacePair& pair, const PairQuery& query, DmvScratch& scratch,
                           PairAnswer& answer);

}  // namespace graze
