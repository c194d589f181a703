#include "pairs/pair_set.hpp"

namespace graze {

std::size_t PairSet::home_of(const Pair& pair) const {
  std::uint64_t mixed = pair.first * 0x9e3779b97f4a7c15U + pair.second;
  mixed = (mixed ^ (mixed >> 29U)) * 0xbf58476d1ce4e5b9U;
  return (mixed ^ (mixed >> 32U)) & (places_.size() - 1);
}

std::size_t PairSet::find(const Pair& pair) const {
  std::size_t place = home_of(pair);
  while (places_[place] != nothing && places_[place] != pair) place = after(place);
  return place;
}

void PairSet::insert(const Pair& pair) {
  if (contains(pair)) return;
  if (is_full()) grow();
  places_[find(pair)] = pair;
  ++size_;
}

/// Moves those behind it up, so that none is further from its home than there is no gap.
void PairSet::erase(const Pair& pair) {
  if (!contains(pair)) return;
  std::size_t gap = find(pair);
  for (std::size_t place = after(gap); places_[place] != nothing; place = after(place)) {
    const std::size_t mask = places_.size() - 1;
    const std::size_t from_home = (place - home_of(places_[place])) & mask;
    if (from_home < ((place - gap) & mask)) continue;
    places_[gap] = places_[place];
    gap = place;
  }
  places_[gap] = nothing;
  --size_;
}

void PairSet::grow() {
  constexpr std::size_t least = 16;
  std::vector<Pair> grown(std::max(least, 2 * places_.size()), nothing);
  kept_.swap(places_);
  places_.swap(grown);
  for (const Pair& pair : kept_)
    if (pair != nothing) places_[find(pair)] = pair;
}

}  // namespace graze
