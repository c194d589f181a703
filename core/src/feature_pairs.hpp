#pragma once

#include <vector>

#include "contact_name.hpp"
#include "leaf_names.hpp"

namespace graze {

/// Appends the names of `ContactDetail::features` between two leaves: all contacts strictly closer than
/// `threshold` and every edge that pierces a face. A name may be met in several pairs of leaves.
void add_close_features(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, double threshold,
                        LeafScratch& scratch, std::vector<ContactName>& names);

/// The same of the features that the scratch has taken, whatever they are of.
void add_close_features(const SurfacePair& pair, double threshold, LeafScratch& scratch,
                        std::vector<ContactName>& names);

/// Keeps one of sorted names for each pair of features. Where two features meet in several pieces (a fold and
/// a triangle, two crossings), the nearest stands for them; a piercing sorts first, and of equally near ones
/// the first.
void keep_nearest_of_each(const SurfacePair& pair, std::vector<ContactName>& names);

}  // namespace graze
