#include "pairs/self_pairs.hpp"

#include <algorithm>

namespace graze {

/// Serials ascend, so an equal count and an equal last serial mean that the objects are the same.
void SelfPairs::find_slots(std::span<const std::unique_ptr<Object>> objects) {
  const std::uint64_t last = objects.empty() ? 0 : objects.back()->serial;
  if (objects.size() == object_count_ && last == last_serial_) return;
  object_count_ = objects.size();
  last_serial_ = last;
  slots_.clear();
  for (std::uint32_t slot = 0; slot < objects.size(); ++slot)
    if (objects[slot]->self != nullptr) slots_.push_back(slot);
}

std::span<const SlotPair> SelfPairs::add_to(std::span<const SlotPair> pairs,
                                            std::span<const std::unique_ptr<Object>> objects,
                                            const PairFilter& filter) {
  if (!are_tested_) return pairs;
  find_slots(objects);
  if (slots_.empty()) return pairs;
  all_.clear();
  auto next = pairs.begin();
  for (const std::uint32_t slot : slots_) {
    const std::uint64_t serial = objects[slot]->serial;
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
