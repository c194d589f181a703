#include "pairs/pair_set.hpp"

namespace graze {

std::size_t PairSet::home_of(const Pair& pair) const {
  std::uint64_t mixed = pair.first * 0x9e3779b97f4a7c15U + pair.second;
  mixed = (mixed ^ (mixed >> 29U)) * 0xbf58476d1ce4e5b9U;
  return (mixed ^ (mixed >> 32U)) & (slots_.size() - 1);
}

std::size_t PairSet::find(const Pair& pair) const {
  std::size_t slot = home_of(pair);
  while (slots_[slot] != nothing && slots_[slot] != pair) slot = after(slot);
  return slot;
}

void PairSet::insert(const Pair& pair) {
  if (contains(pair)) return;
  if (is_full()) grow();
  slots_[find(pair)] = pair;
  ++size_;
}

/// Erases a pair. Moves later pairs up, so that no gap is left between a pair and its home slot.
bool PairSet::erase(const Pair& pair) {
  if (!contains(pair)) return false;
  std::size_t gap = find(pair);
  for (std::size_t slot = after(gap); slots_[slot] != nothing; slot = after(slot)) {
    const std::size_t mask = slots_.size() - 1;
    const std::size_t from_home = (slot - home_of(slots_[slot])) & mask;
    if (from_home < ((slot - gap) & mask)) continue;
    slots_[gap] = slots_[slot];
    gap = slot;
  }
  slots_[gap] = nothing;
  --size_;
  return true;
}

void PairSet::grow() {
  constexpr std::size_t least = 16;
  std::vector<Pair> grown(std::max(least, 2 * slots_.size()), nothing);
  kept_.swap(slots_);
  slots_.swap(grown);
  for (const Pair& pair : kept_)
    if (pair != nothing) slots_[find(pair)] = pair;
}

}  // namespace graze
