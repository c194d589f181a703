#include "pair_memory.hpp"

namespace graze {

void PairMemories::begin() {
  last_.swap(entries_);
  entries_.clear();
  next_ = 0;
}

/// Frees the places of the last step's pairs below `key`; of all that are left for null.
void PairMemories::skip_to(const Key* key) {
  for (; next_ < last_.size() && (key == nullptr || last_[next_].key < *key); ++next_) {
    PairMemory& memory = memories_[last_[next_].place];
    memory.front.forget();
    memory.version_a = memory.version_b = 0;
    free_.push_back(last_[next_].place);
  }
}

PairMemory& PairMemories::of(const Key& key) {
  skip_to(&key);
  std::uint32_t place = 0;
  if (next_ < last_.size() && last_[next_].key == key) {
    place = last_[next_++].place;
  } else if (!free_.empty()) {
    place = free_.back();
    free_.pop_back();
  } else {
    place = static_cast<std::uint32_t>(memories_.size());
    memories_.emplace_back();
  }
  entries_.push_back({key, place});
  return memories_[place];
}

void PairMemories::end() {
  skip_to(nullptr);
}

std::size_t PairMemories::byte_count() const {
  std::size_t bytes = memories_.size() * sizeof(PairMemory) + free_.capacity() * sizeof(std::uint32_t) +
                      (last_.capacity() + entries_.capacity()) * sizeof(Entry);
  for (const PairMemory& memory : memories_) bytes += memory.front.leaves.capacity() * sizeof(RegionPair);
  return bytes;
}

}  // namespace graze
