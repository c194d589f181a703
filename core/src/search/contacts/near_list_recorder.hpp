#pragma once

#include <cstddef>

#include "pair/near_listing.hpp"
#include "search/workers/search_slices.hpp"
#include "search/workers/search_worker.hpp"
#include "search/workers/searched_pair.hpp"

namespace graze {

/// Watches a search for contacts, and lists features that are near for the next steps. Where the surfaces
/// move more it does nothing.
class NearListRecorder {
 public:
  explicit NearListRecorder(const SearchedPair& pair) : pair_(pair) {}

  /// Decides for a new search whether it makes a list.
  void begin();
  /// The search makes no list, and the one that there is stays.
  void keep_old_list() { slack_ = 0; }

  [[nodiscard]] bool is_recording() const { return slack_ > 0; }
  /// How much further apart than the threshold features are listed. It is 0 where none are.
  [[nodiscard]] double slack() const { return slack_; }
  /// The list of a slice, which may be nowhere.
  [[nodiscard]] NearListing listing_in(SearchSlice& slice) const;
  /// Forgets the list of a slice that is too long already.
  void drop_if_too_long(SearchSlice& slice) const;
  /// Puts what all slices have listed together, once they have all been run.
  void finish(const SearchSlices& slices, SearchWorker& worker) const;

 private:
  const SearchedPair& pair_;
  double slack_ = 0;
};

}  // namespace graze
