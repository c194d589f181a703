#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
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

  struct GiveBack {
    SparePositions* owner = nullptr;
    void operator()(Positions* positions) const noexcept { owner->keep(positions); }
  };
  /// Gives the buffer back when it goes; the spares must be there then.
  using Loan = std::unique_ptr<Positions, GiveBack>;

  SparePositions() = default;
  ~SparePositions() { clear(); }
  SparePositions(const SparePositions&) = delete;
  SparePositions& operator=(const SparePositions&) = delete;

  /// A buffer of whatever it held last.
  [[nodiscard]] Loan lend() {
    // A place is emptied by an exchange, so a buffer has one holder. Acquire: the last one has done with it.
    for (std::atomic<Positions*>& place : places_)
      if (Positions* const kept = place.exchange(nullptr, std::memory_order_acquire)) return {kept, {this}};
    return {new Positions, {this}};
  }
  void clear() noexcept {
    for (std::atomic<Positions*>& place : places_) delete place.exchange(nullptr, std::memory_order_acquire);
  }

 private:
  void keep(Positions* positions) noexcept {
    for (std::atomic<Positions*>& place : places_) {
      Positions* empty = nullptr;
      if (place.compare_exchange_strong(empty, positions, std::memory_order_release,
                                        std::memory_order_relaxed))
        return;
    }
    delete positions;
  }

  std::array<std::atomic<Positions*>, most_kept> places_{};
};

}  // namespace graze
