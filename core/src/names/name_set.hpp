#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <vector>

#include "base/working_memory.hpp"
#include "core/mesh/pair_room.hpp"
#include "names/contact_name.hpp"

namespace graze {

/// Names, each once. They are kept in sorted runs, each less than half as long as the one before, so that
/// adding one of n costs log n moves: two flat grids that lie on each other have as many ties as features.
class NameSet {
 public:
  void clear() {
    names_.clear();
    begins_.clear();
  }
  void assign(const ContactName& name) {
    names_.assign(1, name);
    begins_.assign(1, 0);
  }
  [[nodiscard]] bool empty() const { return names_.empty(); }
  /// One of them; the lowest after `settle`.
  [[nodiscard]] const ContactName& front() const { return names_.front(); }
  /// All of them; ascending after `settle`.
  [[nodiscard]] const std::vector<ContactName>& names() const { return names_; }

  [[nodiscard]] bool contains(const ContactName& name) const {
    for (std::size_t run = begins_.size(); run-- > 0;)
      if (std::binary_search(at(begins_[run]), at(end_of(run)), name)) return true;
    return false;
  }
  /// One that is not contained.
  void add(const ContactName& name) {
    constexpr std::size_t short_run = 32;
    if (begins_.empty() || names_.size() - begins_.back() >= short_run) begins_.push_back(names_.size());
    names_.insert(std::lower_bound(at(begins_.back()), names_.cend(), name), name);
    while (begins_.size() > 1 && 2 * length_of(begins_.size() - 1) >= length_of(begins_.size() - 2))
      merge_last();
  }
  void settle() {
    while (begins_.size() > 1) merge_last();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.names_, self.begins_, self.merged_);
  }
  void reserve(const PairRoom& room) {
    names_.reserve(room.ties);
    begins_.reserve(std::numeric_limits<std::size_t>::digits);
    merged_.reserve(room.ties);
  }

 private:
  using Place = std::vector<ContactName>::const_iterator;
  [[nodiscard]] Place at(std::size_t place) const {
    return names_.cbegin() + static_cast<std::ptrdiff_t>(place);
  }
  [[nodiscard]] std::size_t end_of(std::size_t run) const {
    return run + 1 < begins_.size() ? begins_[run + 1] : names_.size();
  }
  [[nodiscard]] std::size_t length_of(std::size_t run) const { return end_of(run) - begins_[run]; }

  void merge_last() {
    const std::size_t middle = begins_.back();
    begins_.pop_back();
    merged_.clear();
    std::merge(at(begins_.back()), at(middle), at(middle), names_.cend(), std::back_inserter(merged_));
    std::copy(merged_.begin(), merged_.end(), names_.begin() + static_cast<std::ptrdiff_t>(begins_.back()));
  }

  std::vector<ContactName> names_;
  std::vector<std::size_t> begins_;  ///< of the runs
  std::vector<ContactName> merged_;
};

}  // namespace graze
