#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

#include "base/working_memory.hpp"
#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"

namespace graze {

/// A set of keys. It keeps them in sorted runs, each less than half as long as the one before, so that adding
/// one of n keys costs log n moves. That matters because two flat grids that lie on each other have as many
/// ties as features.
class KeySet {
 public:
  void clear() {
    keys_.clear();
    begins_.clear();
  }
  void assign(const FeaturePairKey& key) {
    keys_.assign(1, key);
    begins_.assign(1, 0);
  }
  [[nodiscard]] bool empty() const { return keys_.empty(); }
  /// One of the keys. It is the lowest after `merge_runs`.
  [[nodiscard]] const FeaturePairKey& front() const { return keys_.front(); }
  /// All keys, ascending after `merge_runs`.
  [[nodiscard]] const std::vector<FeaturePairKey>& keys() const { return keys_; }

  [[nodiscard]] bool contains(const FeaturePairKey& key) const {
    for (std::size_t run = begins_.size(); run-- > 0;)
      if (std::binary_search(at(begins_[run]), at(end_of(run)), key)) return true;
    return false;
  }
  /// One that is not contained.
  void add(const FeaturePairKey& key) {
    constexpr std::size_t short_run = 32;
    if (begins_.empty() || keys_.size() - begins_.back() >= short_run) begins_.push_back(keys_.size());
    keys_.insert(std::lower_bound(at(begins_.back()), keys_.cend(), key), key);
    while (begins_.size() > 1 && 2 * length_of(begins_.size() - 1) >= length_of(begins_.size() - 2))
      merge_last();
  }
  void merge_runs() {
    while (begins_.size() > 1) merge_last();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.keys_, self.begins_, self.merged_);
  }
  void reserve(const PairRoom& room) {
    keys_.reserve(room.ties);
    begins_.reserve(std::numeric_limits<std::size_t>::digits);
    merged_.reserve(room.ties);
  }

 private:
  using Iterator = std::vector<FeaturePairKey>::const_iterator;
  [[nodiscard]] Iterator at(std::size_t index) const {
    return keys_.cbegin() + static_cast<std::ptrdiff_t>(index);
  }
  [[nodiscard]] std::size_t end_of(std::size_t run) const {
    return run + 1 < begins_.size() ? begins_[run + 1] : keys_.size();
  }
  [[nodiscard]] std::size_t length_of(std::size_t run) const { return end_of(run) - begins_[run]; }

  void merge_last() {
    const std::size_t middle = begins_.back();
    begins_.pop_back();
    merged_.clear();
    std::merge(at(begins_.back()), at(middle), at(middle), keys_.cend(), std::back_inserter(merged_));
    std::copy(merged_.begin(), merged_.end(), keys_.begin() + static_cast<std::ptrdiff_t>(begins_.back()));
  }

  std::vector<FeaturePairKey> keys_;
  std::vector<std::size_t> begins_;  ///< of the runs
  std::vector<FeaturePairKey> merged_;
};

}  // namespace graze
