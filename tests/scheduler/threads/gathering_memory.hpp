#pragma once

#include <cstddef>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>
#include <memory>

namespace graze::tests {

/// Positions that are read by many threads at once, or else say so: each object's lie on a page of their own,
/// and the first touch of a closed page waits until `threads` threads have touched one, or 10 seconds. What
/// touches them is whatever thread a step reads positions on, which no public call would show. One at a time
/// in a process.
class GatheringMemory {
 public:
  /// Enough for steps that give a thread several dozens of objects at once.
  static constexpr std::size_t page_count = 1024;

  explicit GatheringMemory(unsigned threads);
  ~GatheringMemory();
  GatheringMemory(const GatheringMemory&) = delete;
  GatheringMemory& operator=(const GatheringMemory&) = delete;

  /// A triangle.
  static std::shared_ptr<const Mesh> mesh();
  /// Returns the positions of object `index`, which is far from all others.
  [[nodiscard]] PositionView positions(std::size_t index) const;
  /// From now on the next touch of each page waits.
  void close();
  /// How many threads touched a closed page before any of them went on: up to the number that is waited for.
  [[nodiscard]] unsigned threads_seen_at_once() const;

 private:
  std::byte* pages_ = nullptr;
};

}  // namespace graze::tests
