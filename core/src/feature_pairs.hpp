#pragma once

#include <graze/pair_query.hpp>
#include <vector>

#include "contact_name.hpp"
#include "dmv.hpp"
#include "leaf_features.hpp"

namespace graze {

struct FeatureScratch {
  DmvScratch dmv;
  LeafScratch leaves;
};

/// Appends the names of `ContactDetail::features`, sorted, each pair of features once. Both surfaces are
/// refitted by faces. False when the budget ran out.
bool find_feature_pairs(const SurfacePair& pair, const PairQuery& query, FeatureScratch& scratch,
                        WorkMeter& meter, std::vector<ContactName>& names);

}  // namespace graze
