#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

namespace graze {

/// The first rows of all that are offered, sorted, in memory of the caller's.
template <typename Row, typename IsBefore>
class NearestRows {
 public:
  NearestRows(std::span<Row> room, const IsBefore& is_before) : room_(room), is_before_(is_before) {}

  [[nodiscard]] std::span<Row> rows() const { return room_.first(count_); }
  [[nodiscard]] bool is_full() const { return count_ == room_.size(); }
  /// The row that is equal to another in the order, or null.
  [[nodiscard]] Row* find(const Row& row) const {
    const auto place = std::lower_bound(rows().begin(), rows().end(), row, is_before_);
    return place == rows().end() || is_before_(row, *place) ? nullptr : &*place;
  }
  /// Adds a row that is equal to none, and drops the last if there is no room.
  void add(const Row& row) {
    const auto before = rows();
    const auto place = static_cast<std::size_t>(
        std::upper_bound(before.begin(), before.end(), row, is_before_) - before.begin());
    if (place == room_.size()) return;
    if (!is_full()) ++count_;
    std::move_backward(room_.begin() + static_cast<std::ptrdiff_t>(place), rows().end() - 1, rows().end());
    room_[place] = row;
  }

 private:
  std::span<Row> room_;
  IsBefore is_before_;
  std::size_t count_ = 0;
};

}  // namespace graze
