#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <graze/position_view.hpp>
#include <memory>
#include <vector>

#include "core/base/bytes_of.hpp"

namespace graze {

/// A copy of one object's positions, packed, in the precision in which the caller gave them. The positions of
/// vertices that no face uses are undefined.
class CopiedPositions {
 public:
  /// Resizes to `count` positions, whose values are undefined.
  void resize(std::size_t count, bool in_double) {
    is_double_ = in_double;
    in_double ? in_double_.resize(count) : in_float_.resize(count);
  }
  [[nodiscard]] PositionView view() const {
    return is_double_ ? PositionView(in_double_) : PositionView(in_float_);
  }
  [[nodiscard]] std::byte* data() {
    void* const first = is_double_ ? static_cast<void*>(in_double_.data()) : in_float_.data();
    return static_cast<std::byte*>(first);
  }
  [[nodiscard]] std::size_t byte_count() const {
    return sizeof(CopiedPositions) + bytes_of(in_float_) + bytes_of(in_double_);
  }

 private:
  std::vector<Eigen::Vector3f> in_float_;
  std::vector<Eigen::Vector3d> in_double_;
  bool is_double_ = true;
};

/// The pool of buffers for one object's copied positions. Any thread may lend and return buffers without
/// waiting. If more are lent at once than the pool holds, it makes more and frees them when they come back.
class SparePositions {
 public:
  /// How many copies of one object's positions may wait for a step before the next copy allocates.
  static constexpr std::size_t most_waiting = 4;

  /// The bytes of all buffers, lent or kept, of any number of objects.
  using ByteCount = std::atomic<std::size_t>;

  struct GiveBack {
    SparePositions* owner = nullptr;
    ByteCount* byte_count = nullptr;
    /// Whether the object is gone, so that the buffer is freed when it is returned.
    bool is_last = false;
    void operator()(CopiedPositions* positions) const noexcept {
      is_last ? free(positions, *byte_count) : owner->keep(positions, *byte_count);
    }
  };
  /// A lent buffer. Its destructor returns it, so the pool and the byte count must outlive it.
  using Loan = std::unique_ptr<CopiedPositions, GiveBack>;

  SparePositions() = default;
  ~SparePositions() {
    for (std::atomic<CopiedPositions*>& slot : slots_) delete slot.load(std::memory_order_acquire);
  }
  SparePositions(const SparePositions&) = delete;
  SparePositions& operator=(const SparePositions&) = delete;

  /// Lends a buffer of `count` positions, whose values are undefined.
  [[nodiscard]] Loan lend(std::size_t count, bool in_double, ByteCount& byte_count) {
    Loan loan(acquire(byte_count), {this, &byte_count});
    const std::size_t before = loan->byte_count();
    loan->resize(count, in_double);
    const std::size_t now = loan->byte_count();
    if (now != before) byte_count.fetch_add(now - before, std::memory_order_relaxed);
    return loan;
  }
  void clear(ByteCount& byte_count) noexcept {
    for (std::atomic<CopiedPositions*>& slot : slots_)
      free(slot.exchange(nullptr, std::memory_order_acquire), byte_count);
  }

 private:
  CopiedPositions* acquire(ByteCount& byte_count) {
    // An exchange empties the slot, so a buffer has one holder. Acquire: the last holder no longer uses it.
    for (std::atomic<CopiedPositions*>& slot : slots_)
      if (CopiedPositions* const kept = slot.exchange(nullptr, std::memory_order_acquire)) return kept;
    auto fresh = std::make_unique<CopiedPositions>();
    byte_count.fetch_add(fresh->byte_count(), std::memory_order_relaxed);
    return fresh.release();
  }
  void keep(CopiedPositions* positions, ByteCount& byte_count) noexcept {
    for (std::atomic<CopiedPositions*>& slot : slots_) {
      CopiedPositions* empty = nullptr;
      if (slot.compare_exchange_strong(empty, positions, std::memory_order_release,
                                       std::memory_order_relaxed))
        return;
    }
    free(positions, byte_count);
  }
  static void free(CopiedPositions* positions, ByteCount& byte_count) noexcept {
    if (positions == nullptr) return;
    byte_count.fetch_sub(positions->byte_count(), std::memory_order_relaxed);
    delete positions;
  }

  /// There is one slot more than `most_waiting`, for the copy that the surface uses now.
  std::array<std::atomic<CopiedPositions*>, most_waiting + 1> slots_{};
};

}  // namespace graze
