#pragma once

#include <Eigen/Geometry>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "examples/loops/organs.hpp"
#include "examples/loops/times.hpp"

namespace loops {

/// The place of the hand that holds an instrument, and that of the middle of the proxy's tip. The proxy turns
/// as the hand does.
struct Held {
  Eigen::Isometry3d hand = Eigen::Isometry3d::Identity();
  Eigen::Vector3d proxy = Eigen::Vector3d::Zero();
};

/// The points of both organs in one frame, the instruments, and when that frame began.
struct Snapshot {
  std::array<Held, 2> held;
  std::vector<Eigen::Vector3f> points[2];
  Clock::time_point begin;
};

/// Keeps the points of the last frames for the 1 kHz thread. A report says by its tag which frame it is
/// about, and its contacts are about the points of that frame. One thread writes, and one thread reads.
class OrganHistory {
 public:
  explicit OrganHistory(const Organs& organs) {
    for (Snapshot& snapshot : snapshots_)
      for (std::size_t i = 0; i < 2; ++i) snapshot.points[i] = organs.shapes[i].points;
  }

  /// Returns the memory for a new frame. It waits only if the reader has slept for as long as the history is.
  Snapshot& begin_frame(std::uint64_t frame) {
    newest_.store(frame);
    while (read_from_.load() + length <= frame) std::this_thread::yield();
    return snapshots_[frame % length];
  }

  /// Keeps a frame and the one before it from being written over. Returns false if it is too late for that:
  /// then the reader asks for a newer report.
  [[nodiscard]] bool hold(std::uint64_t frame) {
    read_from_.store(frame - 1);
    return newest_.load() < frame - 1 + length;
  }
  void release() { read_from_.store(nobody); }
  /// Returns a frame that is held, or one that the writer itself has written.
  [[nodiscard]] const Snapshot& at(std::uint64_t frame) const { return snapshots_[frame % length]; }

 private:
  static constexpr std::uint64_t length = 16, nobody = std::uint64_t{1} << 60;

  std::array<Snapshot, length> snapshots_;
  std::atomic<std::uint64_t> newest_ = 0, read_from_ = nobody;
};

}  // namespace loops
