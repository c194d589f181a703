#pragma once

#include <graze/leaf_front.hpp>
#include <graze/pair_query.hpp>

#include "pair_search.hpp"
#include "region_distances.hpp"

namespace graze {

struct PairDetector::Scratch {
  PairSearch search;
  SearchScratch memory;
  RegionDistances region_distances;
  LeafFront no_front;
};

}  // namespace graze
