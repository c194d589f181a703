#pragma once

#include <tuple>

#include "closest_features/closest_set.hpp"
#include "closest_features/key_bins.hpp"
#include "closest_features/key_order.hpp"
#include "leaves/leaf_feature_pairs.hpp"
#include "leaves/nearest_of_vertices.hpp"
#include "measure/measure_batch.hpp"
#include "measure/nearest_keys.hpp"
#include "measure/parallel.hpp"
#include "paper/paper.hpp"
#include "search/workers/way_out_scratch.hpp"
#include "solid/solid_scratch.hpp"
#include "vertices/near_vertices.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

/// Working memory for edges of which it is found out whether they are sunk.
struct SettledEdges {
  std::vector<Contact> contacts;
  std::vector<FeaturePairKey> keys;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.contacts, self.keys);
  }
  void reserve(const PairRoom& room) {
    contacts.reserve(room.contacts);
    keys.reserve(room.contacts);
  }
};

/// Working memory of one thread.
struct SearchScratch {
  LeafPairScratch leaf_pairs;
  NearVerticesScratch vertices;
  LeafScratch features;
  NearestOfVertices nearest_of_vertices;
  Closest nearest_of_leaves;
  PaperScratch paper;
  Closest lowest;
  ParallelScratch parallel;
  KeyBinning binning;
  KeyOrder order;
  MeasureScratch measure;
  NearestKeysScratch nearest_keys;
  SettledEdges settled_edges;
  SolidScratch solid;
  WayOutScratch way_out;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.leaf_pairs, self.vertices, self.features, self.nearest_of_vertices,
                    self.nearest_of_leaves, self.paper, self.lowest, self.parallel, self.binning, self.order,
                    self.measure, self.nearest_keys, self.settled_edges, self.solid, self.way_out);
  }
};

}  // namespace graze
