#pragma once

#include <graze/pair_query.hpp>
#include <vector>

#include "contact_name.hpp"
#include "dmv.hpp"

namespace graze {

struct VertexScratch {
  DmvScratch dmv;
  std::vector<ContactName> closest;
};

/// Appends the names of `ContactDetail::vertices`: every pair of vertices strictly below the threshold. Both
/// surfaces are refitted by vertices. False when the budget ran out.
bool find_vertex_pairs(const SurfacePair& pair, const PairQuery& query, VertexScratch& scratch,
                       WorkMeter& meter, std::vector<ContactName>& names);

/// Appends the names of `ContactDetail::regions`: for each pair of leaves its closest pair of vertices (eq.
/// 5), where that is strictly below the threshold; ties go to the lowest a, then b.
bool find_region_pairs(const SurfacePair& pair, const PairQuery& query, VertexScratch& scratch,
                       WorkMeter& meter, std::vector<ContactName>& names);

/// Appends the pairs of vertices of two leaves that are strictly closer than `limit`.
void add_close_vertices(const SurfacePair& pair, const Region& leaf_a, const Region& leaf_b, double limit,
                        std::vector<ContactName>& names);

/// The closest pair of vertices of two leaves (eq. 5), ties to the lowest a, then b. `scratch` is
/// overwritten.
ContactName closest_vertices(const SurfacePair& pair, const Region& leaf_a, const Region& leaf_b,
                             std::vector<ContactName>& scratch);

}  // namespace graze
