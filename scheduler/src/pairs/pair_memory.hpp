#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "core/pair/leaf_front.hpp"

namespace graze {

/// What is remembered of a pair of objects from step to step.
struct PairMemory {
  LeafFront front;
  /// What the last complete answer was about; 0 where there was none.
  std::uint64_t version_a = 0;
  std::uint64_t version_b = 0;
  std::uint64_t rules_version = 0;
};

/// How many pairs of leaves a front has room for where room is made ahead; SceneCapacity says so.
inline constexpr std::size_t leaf_pairs_of_front = 64;

/// How much is remembered of a pair without taking memory.
struct PairMemoryRoom {
  std::size_t leaf_pairs = 0;  ///< of its front
  std::size_t features = 0;    ///< pairs of them, in its list
};

/// The memories of pairs of objects: only those of the n(n-1)/2 that are looked at have one (the paper's
/// numcd). Stepping thread only.
class PairMemories {
 public:
  /// Where a memory is.
  using Index = std::uint32_t;

  /// A memory that knows nothing, which stays in place until it is released.
  Index acquire();
  void release(Index index);
  [[nodiscard]] PairMemory& operator[](Index index) { return memories_[index]; }

  /// Makes room for so many pairs.
  void reserve(std::size_t pairs, const PairMemoryRoom& room);
  /// Bytes held; of the fronts only what was reserved.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void make_room(PairMemory& memory, const PairMemoryRoom& room);

  std::deque<PairMemory> memories_;  ///< a deque, so that they stay in place
  std::vector<Index> free_;
  std::size_t reserved_bytes_ = 0;  ///< of fronts
};

}  // namespace graze
