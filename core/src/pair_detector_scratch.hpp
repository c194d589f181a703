#pragma once

#include <graze/leaf_front.hpp>
#include <graze/pair_query.hpp>

#include "pair_search.hpp"

namespace graze {

struct PairDetector::Scratch {
  PairSearch search;
  SearchScratch memory;
  LeafFront no_front;
};

}  // namespace graze
