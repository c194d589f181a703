#include "leaves/nearest_of_vertices.hpp"

#include <algorithm>
#include <bit>

namespace graze {
namespace {

constexpr std::size_t least_slots = 256;

}  // namespace

void keep_nearer(const SurfacePair& pair, NearKey& kept, const NearKey& offered) {
  if (offered.squared.low > kept.squared.high) return;
  if (offered.key == kept.key) {
    kept.squared.low = std::max(kept.squared.low, offered.squared.low);
    kept.squared.high = std::min(kept.squared.high, offered.squared.high);
    return;
  }
  if (offered.squared.high >= kept.squared.low) {
    pair.check_time();
    const int order = compare_distances(pair, offered.key, kept.key);
    if (order > 0 || (order == 0 && kept.key < offered.key)) return;
  }
  kept = offered;
}

void NearestOfVertices::clear() {
  // Few of the slots are mostly taken.
  if (nearest_.size() < slots_.size() / 16)
    for (std::size_t i = 0; i < nearest_.size(); ++i) slot_that_holds(i) = no_entry;
  else
    std::fill(slots_.begin(), slots_.end(), no_entry);
  nearest_.clear();
  last_ = no_entry;
}

void NearestOfVertices::offer(const SurfacePair& pair, const VertexNearest& offered) {
  if (last_ != no_entry && nearest_[last_].vertex == offered.vertex)
    return keep_nearer(pair, nearest_[last_], offered);
  if (2 * nearest_.size() >= slots_.size()) make_slots(std::max(least_slots, 2 * slots_.size()));
  std::uint32_t& entry = find(offered.vertex);
  if (entry != no_entry) {
    last_ = entry;
    return keep_nearer(pair, nearest_[entry], offered);
  }
  last_ = entry = static_cast<std::uint32_t>(nearest_.size());
  nearest_.push_back(offered);
}

std::size_t NearestOfVertices::slot_of(VertexOfPair vertex) const {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 / the golden ratio
  const auto bits = static_cast<unsigned>(std::bit_width(slots_.size()) - 1);
  return static_cast<std::size_t>((vertex.number * odd) >> (64U - bits));
}

/// The slot of a vertex, or the free one where it belongs.
std::uint32_t& NearestOfVertices::find(VertexOfPair vertex) {
  std::size_t slot = slot_of(vertex);
  while (slots_[slot] != no_entry && nearest_[slots_[slot]].vertex != vertex)
    slot = (slot + 1) & (slots_.size() - 1);
  return slots_[slot];
}

/// The slot of an entry, also where slots before it have been freed.
std::uint32_t& NearestOfVertices::slot_that_holds(std::size_t entry) {
  std::size_t slot = slot_of(nearest_[entry].vertex);
  while (slots_[slot] != entry) slot = (slot + 1) & (slots_.size() - 1);
  return slots_[slot];
}

void NearestOfVertices::make_slots(std::size_t count) {
  slots_.assign(count, no_entry);
  for (std::size_t i = 0; i < nearest_.size(); ++i) find(nearest_[i].vertex) = static_cast<std::uint32_t>(i);
}

void NearestOfVertices::reserve_as(const NearestOfVertices& other) {
  nearest_.reserve(other.nearest_.capacity());
  if (slots_.size() < other.slots_.size()) make_slots(other.slots_.size());
}

void NearestOfVertices::reserve(const PairRoom& room) {
  nearest_.reserve(room.contacts);
  if (slots_.size() < 2 * room.contacts) make_slots(std::bit_ceil(std::max(least_slots, 2 * room.contacts)));
}

std::size_t NearestOfVertices::bytes_of() const {
  return graze::bytes_of(nearest_) + graze::bytes_of(slots_);
}

}  // namespace graze
