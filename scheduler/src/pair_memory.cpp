#include "pair_memory.hpp"

#include <graze/bytes_of.hpp>

namespace graze {

PairMemories::Place PairMemories::take() {
  if (free_.empty()) {
    memories_.emplace_back();
    return static_cast<Place>(memories_.size() - 1);
  }
  const Place place = free_.back();
  free_.pop_back();
  return place;
}

void PairMemories::release(Place place) {
  PairMemory& memory = memories_[place];
  memory.front.forget();
  memory.version_a = memory.version_b = 0;
  free_.push_back(place);
}

void PairMemories::reserve(std::size_t pairs, std::size_t leaf_pairs) {
  free_.reserve(pairs);
  for (std::size_t place = memories_.size(); place < pairs; ++place) {
    memories_.emplace_back();
    free_.push_back(static_cast<Place>(place));
  }
  for (PairMemory& memory : memories_) {
    reserved_bytes_ -= bytes_of(memory.front.leaves);
    memory.front.leaves.reserve(leaf_pairs);
    reserved_bytes_ += bytes_of(memory.front.leaves);
  }
}

std::size_t PairMemories::byte_count() const {
  return memories_.size() * sizeof(PairMemory) + reserved_bytes_ + bytes_of(free_);
}

}  // namespace graze
