#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <graze/bytes_of.hpp>
#include <memory>
#include <vector>

namespace graze {

using Positions = std::vector<Eigen::Vector3d>;

/// The memory of one object's copied positions, used again and again: a few buffers that are lent and given
/// back from any thread without waiting. More are made where more are wanted at once, and freed when they
/// come back.
class SparePositions {
 public:
  /// Copies of one object's positions that may wait for a step without an allocation for the next.
  static constexpr std::size_t most_kept = 4;

  /// Bytes that buffers hold, lent or kept, of any number of objects.
  using ByteCount = std::atomic<std::size_t>;

  struct GiveBack {
    SparePositions* owner = nullptr;
    ByteCount* byte_count = nullptr;
    void operator()(Positions* positions) const noexcept { owner->keep(positions, *byte_count); }
  };
  /// Gives the buffer back when it goes; the spares and the count must be there then.
  using Loan = std::unique_ptr<Positions, GiveBack>;

  SparePositions() = default;
  ~SparePositions() {
    for (std::atomic<Positions*>& place : places_) delete place.load(std::memory_order_acquire);
  }
  SparePositions(const SparePositions&) = delete;
  SparePositions& operator=(const SparePositions&) = delete;

  /// A buffer of `count` positions, of whatever it held last.
  [[nodiscard]] Loan lend(std::size_t count, ByteCount& byte_count) {
    Loan loan(take(byte_count), {this, &byte_count});
    const std::size_t before = bytes_of(*loan);
    loan->resize(count);
    if (bytes_of(*loan) != before) byte_count.fetch_add(bytes_of(*loan) - before, std::memory_order_relaxed);
    return loan;
  }
  void clear(ByteCount& byte_count) noexcept {
    for (std::atomic<Positions*>& place : places_)
      free(place.exchange(nullptr, std::memory_order_acquire), byte_count);
  }

 private:
  Positions* take(ByteCount& byte_count) {
    // A place is emptied by an exchange, so a buffer has one holder. Acquire: the last one has done with it.
    for (std::atomic<Positions*>& place : places_)
      if (Positions* const kept = place.exchange(nullptr, std::memory_order_acquire)) return kept;
    auto fresh = std::make_unique<Positions>();
    byte_count.fetch_add(sizeof(Positions), std::memory_order_relaxed);
    return fresh.release();
  }
  void keep(Positions* positions, ByteCount& byte_count) noexcept {
    for (std::atomic<Positions*>& place : places_) {
      Positions* empty = nullptr;
      if (place.compare_exchange_strong(empty, positions, std::memory_order_release,
                                        std::memory_order_relaxed))
        return;
    }
    free(positions, byte_count);
  }
  static void free(Positions* positions, ByteCount& byte_count) noexcept {
    if (positions == nullptr) return;
    byte_count.fetch_sub(sizeof(Positions) + bytes_of(*positions), std::memory_order_relaxed);
    delete positions;
  }

  std::array<std::atomic<Positions*>, most_kept> places_{};
};

}  // namespace graze
