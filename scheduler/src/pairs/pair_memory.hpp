#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "core/pair/leaf_front.hpp"

namespace graze {

/// The data of a pair of objects that is kept from step to step.
struct PairMemory {
  LeafFront front;
  /// The versions of surfaces and rules for which the last complete answer holds. The surface versions are 0
  /// if there is none.
  std::uint64_t version_a = 0;
  std::uint64_t version_b = 0;
  std::uint64_t rules_version = 0;
  /// PairGroups::version of the groups with which the front was made.
  std::uint64_t groups_version = 0;
  float nanoseconds = 0;  ///< JobWork's estimate of the last test of the pair

  /// Forgets all of it and keeps its room.
  void forget() {
    front.forget();
    version_a = version_b = groups_version = 0;
    nanoseconds = 0;
  }
};

/// The number of leaf pairs that a front has reserved room for. SceneCapacity states it.
inline constexpr std::size_t leaf_pairs_of_front = 64;

/// The capacity that a pair's memory gets ahead of time.
struct PairMemoryRoom {
  std::size_t leaf_pairs = 0;  ///< of its front
  std::size_t features = 0;    ///< pairs of them, in its list
};

/// The memories of pairs of objects. Of the n(n-1)/2 pairs only those that are tested have one (the paper's
/// numcd). Stepping thread only.
class PairMemories {
 public:
  /// The index of a memory.
  using Index = std::uint32_t;

  /// Returns the index of an empty memory, which keeps its address until it is released.
  Index acquire();
  void release(Index index);
  [[nodiscard]] PairMemory& operator[](Index index) { return memories_[index]; }

  /// Reserves memory for that many pairs.
  void reserve(std::size_t pairs, const PairMemoryRoom& room);
  /// Reserves memory for what is remembered of solids, in all memories that are reserved now or later.
  void reserve_for_solids();
  /// The bytes held. Of the fronts it counts only reserved memory.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void make_room(PairMemory& memory, const PairMemoryRoom& room);

  std::deque<PairMemory> memories_;  ///< a deque, so that they stay in place
  std::vector<Index> free_;
  std::size_t reserved_bytes_ = 0;  ///< of fronts
  bool is_for_solids_ = false;      ///< whether reserved memories have room for what is inside
};

}  // namespace graze
