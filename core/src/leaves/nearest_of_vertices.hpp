#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "arithmetic/certain.hpp"
#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"

namespace graze {

/// A vertex of one of two surfaces. Numbers order the vertices of a before those of b.
struct VertexOfPair {
  std::uint64_t number = 0;

  static VertexOfPair of_a(std::uint32_t vertex) { return {vertex}; }
  static VertexOfPair of_b(std::uint32_t vertex) { return {std::uint64_t{1} << 32U | vertex}; }

  friend auto operator<=>(const VertexOfPair&, const VertexOfPair&) = default;
};

/// A vertex, and a feature of the other surface that its closest point may lie in, with their distance.
struct VertexNearest {
  VertexOfPair vertex;
  FeaturePairKey key;
  SquaredRange squared;
};

/// Keeps for each vertex the nearest of the keys that it is offered, and of equally near ones the lowest. The
/// result depends neither on their order nor on how often one comes.
class NearestOfVertices {
 public:
  /// Forgets all.
  void clear();
  void offer(const SurfacePair& pair, const VertexNearest& offered);
  /// The nearest of each vertex, in no order.
  [[nodiscard]] std::span<const VertexNearest> all() const { return nearest_; }

  void reserve_as(const NearestOfVertices& other);
  void reserve(const PairRoom& room);
  [[nodiscard]] std::size_t bytes_of() const;
  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.nearest_, self.slots_);
  }

 private:
  static constexpr std::uint32_t no_entry = ~std::uint32_t{0};

  [[nodiscard]] std::size_t slot_of(VertexOfPair vertex) const;
  std::uint32_t& find(VertexOfPair vertex);
  std::uint32_t& slot_that_holds(std::size_t entry);
  void make_slots(std::size_t count);

  std::vector<VertexNearest> nearest_;
  std::vector<std::uint32_t> slots_;  ///< indices into `nearest_`, by hash; a power of two of them
  std::uint32_t last_ = no_entry;     ///< the entry that was met last, which is mostly met again
};

/// Keeps the nearer of two keys of a vertex in `kept`, and of equally near ones the lower.
void keep_nearer(const SurfacePair& pair, VertexNearest& kept, const VertexNearest& offered);

}  // namespace graze
