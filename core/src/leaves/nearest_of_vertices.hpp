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
  /// How many there are, where both surfaces are tested.
  static std::size_t count(const Surface& a, const Surface& b) {
    return std::size_t{a.mesh().vertex_count()} + b.mesh().vertex_count();
  }
  /// The vertex at an index below `count`, or after all of them.
  static VertexOfPair at(std::size_t index, const Surface& a) {
    const std::size_t of_a_count = a.mesh().vertex_count();
    return index < of_a_count ? of_a(static_cast<std::uint32_t>(index))
                              : of_b(static_cast<std::uint32_t>(index - of_a_count));
  }
  [[nodiscard]] bool is_of_a() const { return number >> 32U == 0; }
  [[nodiscard]] std::uint32_t index() const { return static_cast<std::uint32_t>(number); }

  friend auto operator<=>(const VertexOfPair&, const VertexOfPair&) = default;
};

/// Two features and the range of their distance.
struct NearKey {
  FeaturePairKey key;
  SquaredRange squared;
};

/// A vertex and a feature of the other surface that its closest point may lie in.
struct VertexNearest : NearKey {
  VertexOfPair vertex;
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
  std::vector<std::uint32_t> slots_;  ///< indices into `nearest_`, by hash, a power of two of them
  std::uint32_t last_ = no_entry;     ///< the entry that was met last, which is mostly met again
};

/// Keeps the nearer of two keys in `kept`, and of equally near ones the lower.
void keep_nearer(const SurfacePair& pair, NearKey& kept, const NearKey& offered);

}  // namespace graze
