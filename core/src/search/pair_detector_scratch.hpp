#pragma once

#include "core/pair/leaf_front.hpp"
#include "core/search/pair_detector.hpp"
#include "paper/region_distances.hpp"
#include "search/pair_search.hpp"

namespace graze {

struct PairDetector::Scratch {
  PairSearch search;
  SearchScratch memory;
  RegionDistances region_distances;
  LeafFront no_front;
};

}  // namespace graze
