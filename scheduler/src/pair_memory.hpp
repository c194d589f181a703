#pragma once

#include <cstdint>
#include <deque>
#include <graze/leaf_front.hpp>
#include <utility>
#include <vector>

namespace graze {

/// What is remembered of a pair of objects from step to step.
struct PairMemory {
  LeafFront front;
  /// What the last complete answer was about; 0 where there was none.
  std::uint64_t version_a = 0;
  std::uint64_t version_b = 0;
  std::uint64_t rules_version = 0;
};

/// The memories of the pairs that the last step looked at: those of the n(n-1)/2 that have an entry in the
/// paper's numcd. Stepping thread only.
class PairMemories {
 public:
  /// The serials of a pair's objects.
  using Key = std::pair<std::uint64_t, std::uint64_t>;

  /// Begins a step. Pairs that are not asked for before the next are forgotten.
  void begin();
  /// The memory of a pair, a new one where there was none. Keys are asked for in ascending order. It stays in
  /// place until the step after.
  PairMemory& of(const Key& key);
  /// Ends a step's asking.
  void end();

  /// Makes room for so many pairs with fronts of up to `leaf_pairs`. Not between `begin` and `end`.
  void reserve(std::size_t pairs, std::size_t leaf_pairs);
  /// Bytes held; of the fronts only what was reserved.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  struct Entry {
    Key key;
    std::uint32_t place;
  };
  void skip_to(const Key* key);

  std::deque<PairMemory> memories_;  ///< a deque, so that they stay in place
  std::vector<std::uint32_t> free_;
  std::vector<Entry> last_;  ///< ascending
  std::vector<Entry> entries_;
  std::size_t next_ = 0;            ///< into last_
  std::size_t reserved_bytes_ = 0;  ///< of fronts
};

}  // namespace graze
