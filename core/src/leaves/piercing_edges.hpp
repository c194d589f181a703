#pragma once

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"

namespace graze {

/// The edges of two surfaces that pierce a face of the other surface, perhaps several times.
struct PiercingEdges {
  std::vector<std::uint32_t> of_a;
  std::vector<std::uint32_t> of_b;

  void clear() {
    of_a.clear();
    of_b.clear();
  }
  [[nodiscard]] bool empty() const { return of_a.empty() && of_b.empty(); }
  /// Takes the edge of a key for which `is_edge_through_face` holds.
  void add(const FeaturePairKey& key) {
    const bool is_of_a = key.a().feature.kind == FeatureKind::edge;
    auto& edges = is_of_a ? of_a : of_b;
    const std::uint32_t edge = is_of_a ? key.index_a() : key.index_b();
    if (edges.empty() || edges.back() != edge) edges.push_back(edge);
  }
  void add(const PiercingEdges& other) {
    of_a.insert(of_a.end(), other.of_a.begin(), other.of_a.end());
    of_b.insert(of_b.end(), other.of_b.begin(), other.of_b.end());
  }
  /// Sorts the edges, each once. `has_one` needs it.
  void sort() {
    for (auto* const edges : {&of_a, &of_b}) {
      std::sort(edges->begin(), edges->end());
      edges->erase(std::unique(edges->begin(), edges->end()), edges->end());
    }
  }
  /// Whether an edge of a or one of b is among them.
  [[nodiscard]] bool has_one(std::uint32_t edge_a, std::uint32_t edge_b) const {
    return std::binary_search(of_a.begin(), of_a.end(), edge_a) ||
           std::binary_search(of_b.begin(), of_b.end(), edge_b);
  }
  void reserve(std::size_t edges) {
    of_a.reserve(edges);
    of_b.reserve(edges);
  }
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.of_a, self.of_b);
  }
};

}  // namespace graze
