#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <graze/bytes_of.hpp>
#include <span>
#include <vector>

namespace graze {

/// Memory that the threads of a step put lists into: one room for all, of which each list takes the next part
/// by one atomic addition. Which part is chance and shows nowhere. Lists that find no room have memory of
/// their own until `even_out`, which makes the room as large as all of them were.
template <typename Element>
class SharedRoom {
 public:
  explicit SharedRoom(unsigned workers) : beyond_(workers) {}

  /// Forgets all lists. Stepping thread only, as are all but `keep`.
  void begin() noexcept { used_.store(0, std::memory_order_relaxed); }
  /// A copy of the list that stays until the next `begin` or `even_out`. The calls of one worker do not
  /// overlap.
  std::span<const Element> keep(std::span<const Element> list, unsigned worker) {
    if (list.empty()) return {};
    // Relaxed: each part has one writer, and who reads it has waited for the tasks.
    const std::size_t begin = used_.fetch_add(list.size(), std::memory_order_relaxed);
    if (begin + list.size() > room_.size()) return beyond_[worker].emplace_back(list.begin(), list.end());
    const auto part = std::span(room_).subspan(begin, list.size());
    std::copy(list.begin(), list.end(), part.begin());
    return part;
  }
  /// Makes room for lists like those kept since `begin`, and forgets them.
  void even_out() {
    const std::size_t used = used_.exchange(0, std::memory_order_relaxed);
    const std::size_t size = room_.size();
    if (used <= size) return;
    room_.clear();
    room_.resize(std::max(used, size + size / 2));
    for (auto& lists : beyond_) lists = {};
  }
  void reserve(std::size_t count) {
    if (room_.size() < count) room_.resize(count);
  }
  [[nodiscard]] std::size_t byte_count() const { return bytes_of(room_); }

 private:
  std::vector<Element> room_;
  std::atomic<std::size_t> used_{0};
  std::vector<std::vector<std::vector<Element>>> beyond_;  ///< by worker; empty between steps
};

}  // namespace graze
