#pragma once

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "base/working_memory.hpp"
#include "core/pair/near_list.hpp"

namespace graze {

/// The edges of two surfaces that touch the other surface, each perhaps several times, and perhaps others.
struct TouchingEdges {
  std::vector<std::uint32_t> of_a;
  std::vector<std::uint32_t> of_b;
  bool pierced = false;  ///< whether an edge pierces a face

  void clear() {
    of_a.clear();
    of_b.clear();
    pierced = false;
  }
  void add(const FeatureRef& segment, bool is_of_a) {
    auto& edges = is_of_a ? of_a : of_b;
    if (segment.kind == FeatureRefKind::edge && (edges.empty() || edges.back() != segment.index))
      edges.push_back(segment.index);
  }
  void add(const TouchingEdges& other) {
    of_a.insert(of_a.end(), other.of_a.begin(), other.of_a.end());
    of_b.insert(of_b.end(), other.of_b.begin(), other.of_b.end());
    pierced = pierced || other.pierced;
  }
  /// Makes room for this many edges of each surface ahead of time. SceneCapacity states it.
  static constexpr std::size_t reserved = 8192;
  void reserve() {
    of_a.reserve(reserved);
    of_b.reserve(reserved);
  }
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.of_a, self.of_b);
  }
};

}  // namespace graze
