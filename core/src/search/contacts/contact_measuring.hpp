#pragma once

#include <cstddef>
#include <span>

#include "closest_features/feature_pair_key.hpp"
#include "search/contacts/key_ordering.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"

namespace graze {

/// The part of a search for contacts that measures the contacts of ordered keys, in slices.
class ContactMeasuring {
 public:
  ContactMeasuring(SearchedPair& pair, SearchSlices& slices, const OrderedKeys& ordered)
      : pair_(pair), slices_(slices), ordered_(ordered) {}

  /// Makes the slices, and room in the answer.
  void begin(SearchWorker& worker);
  /// Measures the contacts of a slice, and returns them. Any number of threads, one for each slice.
  std::span<Contact> run(SearchSlice& slice, SearchWorker& worker) const;
  /// The lowest key at the least distance, once all have been measured.
  [[nodiscard]] FeaturePairKey lowest(SearchWorker& worker) const;

 private:
  void keep_time_back(std::size_t contacts, SearchWorker& worker) const;
  [[nodiscard]] std::span<const FeaturePairKey> keys_of(const SearchSlice& slice) const;
  [[nodiscard]] std::span<Contact> contacts_of(const SearchSlice& slice) const;

  SearchedPair& pair_;
  SearchSlices& slices_;
  const OrderedKeys& ordered_;
};

/// The nearer of two keys, and of equally near ones the lower.
FeaturePairKey lower_of(SearchWorker& worker, const FeaturePairKey& left, const FeaturePairKey& right);

}  // namespace graze
