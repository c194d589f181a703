#pragma once

#include <graze/pair_query.hpp>
#include <vector>

#include "contact_name.hpp"
#include "leaf_names.hpp"
#include "leaf_pairs.hpp"

namespace graze {

/// Appends the names of `ContactDetail::vertices`: every pair of vertices strictly below the threshold. False
/// when the budget ran out.
bool find_vertex_pairs(const SurfacePair& pair, const PairQuery& query, LeafPairs& leaf_pairs,
                       LeafScratch& scratch, std::vector<ContactName>& names);

/// Appends the names of `ContactDetail::regions`: for each pair of leaves its closest pair of vertices (eq.
/// 5), where that is strictly below the threshold; ties go to the lowest a, then b. `closest` is overwritten.
bool find_region_pairs(const SurfacePair& pair, const PairQuery& query, LeafPairs& leaf_pairs,
                       LeafScratch& scratch, std::vector<ContactName>& closest,
                       std::vector<ContactName>& names);

/// Appends the pairs of vertices of two leaves that are strictly closer than `limit`.
void add_close_vertices(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, double limit,
                        LeafScratch& scratch, std::vector<ContactName>& names);

/// The closest pair of vertices of two leaves (eq. 5), ties to the lowest a, then b. `closest` is
/// overwritten.
ContactName closest_vertices(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b,
                             LeafScratch& scratch, std::vector<ContactName>& closest);

}  // namespace graze
