#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace graze {

/// An unordered set of pairs of numbers: a hash table with open addressing, at most half full.
class PairSet {
 public:
  /// A pair of numbers, neither of which is the largest 64-bit number.
  using Pair = std::pair<std::uint64_t, std::uint64_t>;

  [[nodiscard]] bool contains(const Pair& pair) const { return size_ > 0 && slots_[find(pair)] == pair; }
  void insert(const Pair& pair);
  /// Returns whether it was there.
  bool erase(const Pair& pair);
  /// Erases every pair for which `is_gone` holds.
  template <typename IsGone>
  void erase_if(const IsGone& is_gone) {
    kept_.clear();
    for (const Pair& pair : slots_)
      if (pair != nothing && !is_gone(pair)) kept_.push_back(pair);
    std::fill(slots_.begin(), slots_.end(), nothing);
    size_ = 0;
    for (const Pair& pair : kept_) insert(pair);
  }
  /// Calls `visit` with every pair, in no order.
  template <typename Visit>
  void visit(const Visit& visit) const {
    for (const Pair& pair : slots_)
      if (pair != nothing) visit(pair);
  }
  /// Whether the next new pair makes the array grow.
  [[nodiscard]] bool is_full() const { return 2 * (size_ + 1) > slots_.size(); }
  void grow();

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }
  [[nodiscard]] std::size_t byte_count() const {
    return (slots_.capacity() + kept_.capacity()) * sizeof(Pair);
  }

 private:
  static constexpr Pair nothing{~std::uint64_t{0}, ~std::uint64_t{0}};

  [[nodiscard]] std::size_t home_of(const Pair& pair) const;
  /// The slot of the pair, or the slot in which it would be inserted.
  [[nodiscard]] std::size_t find(const Pair& pair) const;
  [[nodiscard]] std::size_t after(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  std::vector<Pair> slots_;  ///< as many as a power of two
  std::vector<Pair> kept_;
  std::size_t size_ = 0;
};

}  // namespace graze
