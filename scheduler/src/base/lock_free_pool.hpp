#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/growing_array.hpp"

namespace graze {

/// A pool of elements, named by indices, that any thread may acquire and release without a lock. Elements
/// never move. The pool allocates only when no released element is left.
///
/// The free elements form a stack linked by `next`. The head of the stack holds a tag beside the index, and
/// each acquisition changes the tag. The tag solves the ABA problem. Suppose that a thread reads the head and
/// the link of that element, and then sleeps. Meanwhile other threads may acquire and release the element.
/// Without the tag the thread would then install an outdated link. It would take 2^32 acquisitions during
/// that sleep to make the tag equal again.
template <typename Element>
class LockFreePool {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Returns the index of an element: a released one as it was left, or a new, default-constructed one. If
  /// there is no memory for a new one it throws std::bad_alloc and uses up no index.
  [[nodiscard]] std::uint32_t acquire() {
    std::uint64_t head = free_.load(std::memory_order_acquire);
    while (index_of(head) != none) {
      // Another thread that has just acquired this element may write the link at the same time. The head then
      // has another tag, so the exchange below fails and the value is not used.
      const std::uint32_t next = link(index_of(head)).load(std::memory_order_relaxed);
      // Acquire: the thread that released the element no longer uses it. Acquisitions in between are
      // read-modify-writes, which continue the release sequence.
      if (free_.compare_exchange_weak(head, head_of(next, tag_of(head) + 1), std::memory_order_acquire))
        return index_of(head);
    }
    std::uint32_t index = made_.load(std::memory_order_relaxed);
    do entries_.make(index);
    while (!made_.compare_exchange_weak(index, index + 1, std::memory_order_relaxed));
    return index;
  }

  void release(std::uint32_t index) noexcept { release(index, index); }
  /// Releases a chain of elements in which links lead from `first` to `last`.
  void release(std::uint32_t first, std::uint32_t last) noexcept {
    std::uint64_t head = free_.load(std::memory_order_relaxed);
    do link(last).store(index_of(head), std::memory_order_relaxed);
    while (!free_.compare_exchange_weak(head, head_of(first, tag_of(head)), std::memory_order_release,
                                        std::memory_order_relaxed));
  }

  /// Every index that was ever returned is below this number.
  [[nodiscard]] std::uint32_t made_count() const noexcept { return made_.load(std::memory_order_relaxed); }
  /// The element at an index that was returned at least once.
  [[nodiscard]] Element& operator[](std::uint32_t index) const noexcept { return entries_[index].element; }
  /// The element at any index, or null where no element was made.
  [[nodiscard]] Element* find(std::uint32_t index) const noexcept {
    auto* const entry = entries_.find(index);
    return entry == nullptr ? nullptr : &entry->element;
  }
  /// The link of an element. The thread that holds the element may use it to form chains.
  [[nodiscard]] std::atomic<std::uint32_t>& link(std::uint32_t index) const noexcept {
    return entries_[index].next;
  }

  /// Makes `count` elements.
  void reserve(std::size_t count) {
    for (std::size_t index = 0; index < count; ++index) entries_.make(static_cast<std::uint32_t>(index));
  }
  /// The bytes of the elements made, without the memory that these hold.
  [[nodiscard]] std::size_t byte_count() const noexcept { return entries_.byte_count(); }

 private:
  struct Entry {
    std::atomic<std::uint32_t> next{none};
    Element element{};
  };
  static std::uint32_t index_of(std::uint64_t head) noexcept { return static_cast<std::uint32_t>(head); }
  static std::uint32_t tag_of(std::uint64_t head) noexcept { return static_cast<std::uint32_t>(head >> 32); }
  static std::uint64_t head_of(std::uint32_t index, std::uint32_t tag) noexcept {
    return std::uint64_t{tag} << 32 | index;
  }

  GrowingArray<Entry> entries_;
  std::atomic<std::uint32_t> made_{0};
  std::atomic<std::uint64_t> free_{none};
};

}  // namespace graze
