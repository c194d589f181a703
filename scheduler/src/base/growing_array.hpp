#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace graze {

/// An array that grows from any thread without a lock and whose elements never move: they lie in chunks, each
/// twice as large as the one before. Elements are default-constructed with their chunk and destroyed with the
/// array.
template <typename Element>
class GrowingArray {
 public:
  GrowingArray() = default;
  ~GrowingArray() {
    for (std::atomic<Element*>& chunk : chunks_) delete[] chunk.load(std::memory_order_relaxed);
  }
  GrowingArray(const GrowingArray&) = delete;
  GrowingArray& operator=(const GrowingArray&) = delete;

  /// The element, or null where it was not made yet. Any index, any thread.
  [[nodiscard]] Element* find(std::uint32_t index) const noexcept {
    const Location location = location_of(index);
    // Acquire: the chunk's elements were constructed before it was put here.
    Element* const chunk = chunks_[location.chunk].load(std::memory_order_acquire);
    return chunk == nullptr ? nullptr : chunk + location.offset;
  }
  /// An element that was made.
  [[nodiscard]] Element& operator[](std::uint32_t index) const noexcept { return *find(index); }

  /// Makes the element and those before it in its chunk, unless they are there.
  Element& make(std::uint32_t index) {
    const Location location = location_of(index);
    std::atomic<Element*>& chunk = chunks_[location.chunk];
    if (Element* const made = chunk.load(std::memory_order_acquire)) return made[location.offset];
    auto fresh = std::make_unique<Element[]>(first_chunk << location.chunk);
    Element* made = nullptr;
    // Of several threads that make the same chunk one puts its own here; the others take that one.
    if (chunk.compare_exchange_strong(made, fresh.get(), std::memory_order_acq_rel)) made = fresh.release();
    return made[location.offset];
  }

  /// Bytes of the elements made; not what they hold themselves.
  [[nodiscard]] std::size_t byte_count() const noexcept {
    std::size_t bytes = 0;
    for (std::size_t chunk = 0; chunk < chunk_count; ++chunk)
      if (chunks_[chunk].load(std::memory_order_relaxed) != nullptr)
        bytes += (first_chunk << chunk) * sizeof(Element);
    return bytes;
  }

 private:
  static constexpr std::size_t first_chunk = 64;
  static constexpr std::size_t chunk_count = 27;  ///< for every 32-bit index
  struct Location {
    std::size_t chunk;
    std::size_t offset;
  };
  /// Chunk c begins at first_chunk (2^c - 1).
  static Location location_of(std::uint32_t index) noexcept {
    const std::size_t units = index / first_chunk + 1;
    const auto chunk = static_cast<std::size_t>(std::bit_width(units / 2));  // the logarithm, rounded down
    return {chunk, index - first_chunk * ((std::size_t{1} << chunk) - 1)};
  }

  std::array<std::atomic<Element*>, chunk_count> chunks_{};
};

}  // namespace graze
