#pragma once

#include <graze/pair_query.hpp>
#include <vector>

#include "contact_name.hpp"
#include "leaf_names.hpp"
#include "leaf_pairs.hpp"

namespace graze {

/// Appends the names of `ContactDetail::features`, sorted, each pair of features once. False when the budget
/// ran out.
bool find_feature_pairs(const SurfacePair& pair, const PairQuery& query, LeafPairs& leaf_pairs,
                        LeafScratch& scratch, std::vector<ContactName>& names);

}  // namespace graze
