#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "base/growing_array.hpp"

namespace graze {

/// Elements that are lent and given back from any thread without a lock, and named by indices. They never
/// move, and what is lent is never taken from the allocator while one given back is left.
///
/// The free ones are a stack linked by `next`. Its head holds a tag beside the index, which changes with
/// every acquisition: without it a thread that has read the head and that element's link, and then sleeps
/// while the element is taken and given back, would put a link in place that is no longer so. (The tag would
/// have to come round, 2^32 acquisitions, during that sleep.)
template <typename Element>
class LockFreePool {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Lends an element, as it was given back or, a new one, default-constructed. Where there is no memory for
  /// that (std::bad_alloc), no index is used up.
  [[nodiscard]] std::uint32_t acquire() {
    std::uint64_t head = free_.load(std::memory_order_acquire);
    while (index_of(head) != none) {
      // The link may be read while another thread that has just taken the element writes it; then the head
      // has another tag, and what was read is not used.
      const std::uint32_t next = link(index_of(head)).load(std::memory_order_relaxed);
      // Acquire: whoever gave the element back has done with it. (Takes between are read-modify-writes, which
      // keep the release of the one who gave back.)
      if (free_.compare_exchange_weak(head, head_of(next, tag_of(head) + 1), std::memory_order_acquire))
        return index_of(head);
    }
    std::uint32_t index = made_.load(std::memory_order_relaxed);
    do entries_.make(index);
    while (!made_.compare_exchange_weak(index, index + 1, std::memory_order_relaxed));
    return index;
  }

  void release(std::uint32_t index) noexcept { release(index, index); }
  /// Gives back a chain: `last` is reached from `first` by links.
  void release(std::uint32_t first, std::uint32_t last) noexcept {
    std::uint64_t head = free_.load(std::memory_order_relaxed);
    do link(last).store(index_of(head), std::memory_order_relaxed);
    while (!free_.compare_exchange_weak(head, head_of(first, tag_of(head)), std::memory_order_release,
                                        std::memory_order_relaxed));
  }

  /// Indices that were lent once are below this.
  [[nodiscard]] std::uint32_t made_count() const noexcept { return made_.load(std::memory_order_relaxed); }
  /// An element that was lent once.
  [[nodiscard]] Element& operator[](std::uint32_t index) const noexcept { return entries_[index].element; }
  /// The same of any index: null where no element was made.
  [[nodiscard]] Element* find(std::uint32_t index) const noexcept {
    auto* const entry = entries_.find(index);
    return entry == nullptr ? nullptr : &entry->element;
  }
  /// Its holder's to use, for chains of elements.
  [[nodiscard]] std::atomic<std::uint32_t>& link(std::uint32_t index) const noexcept {
    return entries_[index].next;
  }

  /// Makes that many elements.
  void reserve(std::size_t count) {
    for (std::size_t index = 0; index < count; ++index) entries_.make(static_cast<std::uint32_t>(index));
  }
  /// Bytes of the elements made; not what they hold themselves.
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
