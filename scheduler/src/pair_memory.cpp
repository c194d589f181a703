#include "pair_memory.hpp"

#include <graze/bytes_of.hpp>

namespace graze {
namespace {

/// So many pairs before it is asked for a memory begins to come from further away.
constexpr std::size_t ahead = 12;

}  // namespace

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
    // Most pairs come again, and of most that is all that is asked of their memory.
    if (next_ + ahead < last_.size()) __builtin_prefetch(&memories_[last_[next_ + ahead].place].version_a);
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

void PairMemories::reserve(std::size_t pairs, std::size_t leaf_pairs) {
  free_.reserve(pairs);
  last_.reserve(pairs);
  entries_.reserve(pairs);
  for (std::size_t place = memories_.size(); place < pairs; ++place) {
    memories_.emplace_back();
    free_.push_back(static_cast<std::uint32_t>(place));
  }
  for (PairMemory& memory : memories_) {
    reserved_bytes_ -= bytes_of(memory.front.leaves);
    memory.front.leaves.reserve(leaf_pairs);
    reserved_bytes_ += bytes_of(memory.front.leaves);
  }
}

std::size_t PairMemories::byte_count() const {
  return memories_.size() * sizeof(PairMemory) + reserved_bytes_ + bytes_of(free_) + bytes_of(last_) +
         bytes_of(entries_);
}

}  // namespace graze
