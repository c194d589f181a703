#include "pairs/self_pairs.hpp"

#include <algorithm>
#include <utility>

namespace graze {

void SelfPairs::find_slots(const ObjectStore& store) {
  if (std::exchange(found_at_, store.arrivals_and_departures()) == store.arrivals_and_departures()) return;
  slots_.clear();
  for (std::uint32_t slot = 0; slot < store.objects().size(); ++slot)
    if (store.objects()[slot]->self != nullptr) slots_.push_back(slot);
}

std::span<const SlotPair> SelfPairs::add_to(std::span<const SlotPair> pairs, const ObjectStore& store,
                                            const PairFilter& filter) {
  if (!are_tested_) return pairs;
  find_slots(store);
  if (slots_.empty()) return pairs;
  all_.clear();
  auto next = pairs.begin();
  for (const std::uint32_t slot : slots_) {
    const std::uint64_t serial = store.objects()[slot]->serial;
    if (filter.contains({serial, serial})) continue;
    const SlotPair pair = pair_of(slot, slot);
    const auto end = std::lower_bound(next, pairs.end(), pair);
    all_.insert(all_.end(), next, end);
    all_.push_back(pair);
    next = end;
  }
  all_.insert(all_.end(), next, pairs.end());
  return all_;
}

}  // namespace graze
