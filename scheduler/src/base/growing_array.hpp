#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace graze {

/// An array that grows from any thread without a lock and whose elements never move. It keeps them in chunks,
/// each twice as large as the one before. A chunk's elements are default-constructed with the chunk and
/// destroyed with the array.
template <typename Element>
class GrowingArray {
 public:
  GrowingArray() = default;
  ~GrowingArray() {
    for (std::atomic<Element*>& chunk : chunks_) delete[] chunk.load(std::memory_order_relaxed);
  }
  GrowingArray(const GrowingArray&) = delete;
  GrowingArray& operator=(const GrowingArray&) = delete;

  /// The element at an index, or null where none was made yet. Takes any index, from any thread.
  [[nodiscard]] Element* find(std::uint32_t index) const noexcept {
    const Location location = location_of(index);
    // Acquire: the chunk's elements were constructed before the chunk was published.
    Element* const chunk = chunks_[location.chunk].load(std::memory_order_acquire);
    return chunk == nullptr ? nullptr : chunk + location.offset;
  }
  /// The element at an index that `make` has returned.
  [[nodiscard]] Element& operator[](std::uint32_t index) const noexcept { return *find(index); }

  /// Makes the element at an index and the earlier ones of its chunk, unless they exist.
  Element& make(std::uint32_t index) {
    const Location location = location_of(index);
    std::atomic<Element*>& chunk = chunks_[location.chunk];
    if (Element* const made = chunk.load(std::memory_order_acquire)) return made[location.offset];
    auto fresh = std::make_unique<Element[]>(first_chunk << location.chunk);
    Element* made = nullptr;
    // If several threads make one chunk at once, one of them publishes its own. The others use that one.
    if (chunk.compare_exchange_strong(made, fresh.get(), std::memory_order_acq_rel)) made = fresh.release();
    return made[location.offset];
  }

  /// The bytes of the elements made, without the memory that these hold.
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
  /// The chunk of an index and the offset in it. Chunk c begins at index first_chunk (2^c - 1).
  static Location location_of(std::uint32_t index) noexcept {
    const std::size_t units = index / first_chunk + 1;
    const auto chunk = static_cast<std::size_t>(std::bit_width(units / 2));  // the logarithm, rounded down
    return {chunk, index - first_chunk * ((std::size_t{1} << chunk) - 1)};
  }

  std::array<std::atomic<Element*>, chunk_count> chunks_{};
};

}  // namespace graze
