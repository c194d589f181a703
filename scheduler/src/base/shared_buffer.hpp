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

/// Memory that the threads of a step put lists into: one room for all, of which each list takes the next part
/// by one atomic addition. Which part is chance and shows nowhere. Lists that find no room have memory of
/// their own until `grow_to_demand`, which makes the room larger than all of them were.
template <typename Element>
class SharedBuffer {
 public:
  static_assert(std::is_trivially_destructible_v<Element> &&
                alignof(Element) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);

  explicit SharedBuffer(unsigned workers) : overflow_(workers) {}

  /// Forgets all lists. Stepping thread only, as are all but `keep`.
  void begin() noexcept { used_.store(0, std::memory_order_relaxed); }
  /// A copy of the list that stays until the next `begin` or `grow_to_demand`. The calls of one worker do not
  /// overlap.
  std::span<const Element> keep(std::span<const Element> list, unsigned worker) {
    if (list.empty()) return {};
    // Relaxed: each part has one writer, and who reads it has waited for the tasks.
    const std::size_t begin = used_.fetch_add(list.size(), std::memory_order_relaxed);
    if (begin + list.size() > size_) return overflow_[worker].emplace_back(list.begin(), list.end());
    Element* const part = reinterpret_cast<Element*>(buffer_.get()) + begin;
    std::uninitialized_copy(list.begin(), list.end(), part);
    return {part, list.size()};
  }
  /// Makes room for lists like those kept since `begin`, and forgets them.
  void grow_to_demand() {
    const std::size_t used = used_.exchange(0, std::memory_order_relaxed);
    if (used <= size_) return;
    for (auto& lists : overflow_) lists = {};
    reserve(with_growth_room(used));
  }
  void reserve(std::size_t count) {
    if (size_ >= count) return;
    size_ = 0;
    buffer_ = nullptr;  // first, so that both are never there at once
    buffer_ = std::make_unique_for_overwrite<std::byte[]>(count * sizeof(Element));
    size_ = count;
  }
  [[nodiscard]] std::size_t byte_count() const { return size_ * sizeof(Element); }

 private:
  std::unique_ptr<std::byte[]> buffer_;  ///< not touched before something is kept there
  std::size_t size_ = 0;                 ///< elements that it has room for
  std::atomic<std::size_t> used_{0};
  std::vector<std::vector<std::vector<Element>>> overflow_;  ///< by worker; empty between steps
};

}  // namespace graze
