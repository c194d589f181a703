#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "objects/filter_traits.hpp"
#include "objects/object.hpp"
#include "pairs/pair_set.hpp"

namespace graze {

/// Names pairs of which something has changed, up to a number. Beyond that it says that there are too many.
class ChangedPairs {
 public:
  void add(const PairSet::Pair& pair) {
    if (pairs_.size() < most)
      pairs_.push_back(pair);
    else
      are_too_many_ = true;
  }
  /// No value means that there are too many to name.
  [[nodiscard]] std::optional<std::span<const PairSet::Pair>> all() const {
    if (are_too_many_) return std::nullopt;
    return pairs_;
  }
  void clear() {
    pairs_.clear();
    are_too_many_ = false;
  }
  [[nodiscard]] std::size_t byte_count() const { return pairs_.capacity() * sizeof(PairSet::Pair); }

 private:
  static constexpr std::size_t most = 4096;

  std::vector<PairSet::Pair> pairs_;
  bool are_too_many_ = false;
};

/// The pairs of objects that Scene::ignore() took out as a whole, by serials, the lower first. Stepping
/// thread only, except for the const members.
class IgnoredObjects {
 public:
  /// Takes a pair out or puts it back. Names it in `changed` if that makes a difference. If this throws, it
  /// may be done again.
  void set(Object& a, Object& b, bool ignored, ChangedPairs& changed);
  /// Forgets the pairs of a removed object.
  void forget(Object& object);

  [[nodiscard]] bool is_empty() const { return pairs_.size() == 0; }
  [[nodiscard]] bool contains(const PairSet::Pair& serials) const { return pairs_.contains(serials); }
  /// The number of these pairs that no lasting filter takes out.
  [[nodiscard]] std::uint64_t counted() const { return counted_; }
  /// Calls `visit` with every pair, in no order.
  template <typename Visit>
  void visit(const Visit& visit) const {
    pairs_.visit(visit);
  }
  [[nodiscard]] std::size_t byte_count() const { return pairs_.byte_count() + partner_bytes_; }

 private:
  void make_room(Object& object);

  PairSet pairs_;
  bool some_erased_ = false;  ///< objects may have partners in their lists that are none any more
  std::uint64_t counted_ = 0;
  std::size_t partner_bytes_ = 0;  ///< of Object::ignored_partners
};

}  // namespace graze
