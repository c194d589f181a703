#pragma once

#include <cstddef>
#include <cstdint>
#include <graze/settings.hpp>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "core/base/bytes_of.hpp"
#include "objects/object_store.hpp"
#include "pairs/pair_filter.hpp"

namespace graze {

/// The pairs of objects with themselves (ObjectSettings::self). A scene without one only looks for them when
/// objects come or go. Stepping thread only.
class SelfPairs {
 public:
  explicit SelfPairs(const SceneSettings& settings)
      : are_tested_(settings.detail != ContactDetail::regions &&
                    settings.accuracy.mode() != AccuracyMode::paper) {}

  /// Returns pairs of two objects with those of one in their places. Both ascend. The result is valid until
  /// the next call, and as long as `pairs` is.
  std::span<const SlotPair> add_to(std::span<const SlotPair> pairs, const ObjectStore& store,
                                   const PairFilter& filter);
  /// How many objects are tested against themselves, of those of the last call.
  [[nodiscard]] std::size_t count() const { return slots_.size(); }

  void reserve(std::size_t pairs) { all_.reserve(pairs); }
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(slots_) + bytes_of(all_); }

 private:
  void find_slots(const ObjectStore& store);

  bool are_tested_;
  std::uint64_t found_at_ = 0;        ///< ObjectStore::arrivals_and_departures, when slots were found
  std::vector<std::uint32_t> slots_;  ///< of the objects, ascending
  std::vector<SlotPair> all_;
};

}  // namespace graze
