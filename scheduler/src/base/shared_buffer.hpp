#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "core/base/growth_policy.hpp"

namespace graze {

/// A buffer into which the threads of a step copy lists. Each list gets the next free part by one atomic
/// addition, so the order of lists in the buffer is a matter of chance. No result depends on that order. A
/// list that does not fit gets memory of its own until `grow_to_demand` enlarges the buffer.
template <typename Element>
class SharedBuffer {
 public:
  static_assert(std::is_trivially_destructible_v<Element> &&
                alignof(Element) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

  explicit SharedBuffer(unsigned workers) : overflow_(workers) {}

  /// Forgets all lists. Only the stepping thread calls this and all other members but `keep`.
  void begin() noexcept { used_.store(0, std::memory_order_relaxed); }
  /// Copies a list and returns the copy, which stays until the next `begin` or `grow_to_demand`. Any number
  /// of workers may call this at once, but the calls of one worker do not overlap.
  std::span<const Element> keep(std::span<const Element> list, unsigned worker) {
    if (list.empty()) return {};
    // Relaxed: each part has one writer, and readers have waited for the tasks to end.
    const std::size_t begin = used_.fetch_add(list.size(), std::memory_order_relaxed);
    if (begin + list.size() > size_) return overflow_[worker].emplace_back(list.begin(), list.end());
    Element* const part = reinterpret_cast<Element*>(buffer_.get()) + begin;
    std::uninitialized_copy(list.begin(), list.end(), part);
    return {part, list.size()};
  }
  /// Enlarges the buffer if the lists kept since `begin` did not fit, and forgets them.
  void grow_to_demand() {
    const std::size_t used = used_.exchange(0, std::memory_order_relaxed);
    if (used <= size_) return;
    for (auto& lists : overflow_) lists = {};
    reserve(with_growth_room(used));
  }
  void reserve(std::size_t count) {
    if (size_ >= count) return;
    size_ = 0;
    buffer_ = nullptr;  // first, so that the old and the new buffer never exist at once
    buffer_ = std::make_unique_for_overwrite<std::byte[]>(count * sizeof(Element));
    size_ = count;
  }
  [[nodiscard]] std::size_t byte_count() const { return size_ * sizeof(Element); }

 private:
  std::unique_ptr<std::byte[]> buffer_;  ///< uninitialized until a list is kept
  std::size_t size_ = 0;                 ///< capacity in elements
  std::atomic<std::size_t> used_{0};
  std::vector<std::vector<std::vector<Element>>> overflow_;  ///< by worker; empty between steps
};

}  // namespace graze
