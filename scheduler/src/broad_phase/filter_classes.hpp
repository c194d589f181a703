#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/slot_pair.hpp"
#include "objects/filter_traits.hpp"

namespace graze {

/// How many pairs of all objects each lasting filter takes out. A pair counts at the first that does.
struct FilteredPairs {
  std::uint64_t fixed = 0;
  std::uint64_t by_layer = 0;
  std::uint64_t in_group = 0;
  std::uint64_t elsewhere = 0;  ///< PairVerdict::elsewhere

  FilteredPairs& operator+=(const FilteredPairs& more) {
    fixed += more.fixed;
    by_layer += more.by_layer;
    in_group += more.in_group;
    elsewhere += more.elsewhere;
    return *this;
  }
  FilteredPairs& operator-=(const FilteredPairs& fewer) {
    fixed -= fewer.fixed;
    by_layer -= fewer.by_layer;
    in_group -= fewer.in_group;
    elsewhere -= fewer.elsewhere;
    return *this;
  }
};

/// The filters of some objects together, such as those in a node of a tree.
struct NodeFilter {
  std::uint64_t classes = 0;  ///< a bit for each class of theirs
  std::uint64_t group = 0;    ///< ObjectSettings::group, where all have the same

  /// Adds the objects of another node.
  void add(const NodeFilter& other) {
    if (classes == 0)
      group = other.group;
    else if (other.classes != 0 && group != other.group)
      group = 0;
    classes |= other.classes;
  }
};

/// The objects that some objects can touch.
struct WantedFilter {
  std::uint64_t classes = ~std::uint64_t{0};
  std::uint64_t group = 0;  ///< the group of which they can touch no object, or 0

  /// Whether one of them may touch one of `others`. The answer is exact for single objects, unless
  /// FilterClasses::needs_check.
  [[nodiscard]] bool may_touch(const NodeFilter& others) const {
    return (classes & others.classes) != 0 && (group == 0 || group != others.group);
  }
};

/// Counts the pairs that can never touch, and sorts objects into up to 64 classes for a tree's nodes.
///
/// Objects of equal traits are in one class. If there are many groups, classes of later objects leave the
/// group open. The last class is of all objects that find no other. Stepping thread only, except for the
/// const members.
class FilterClasses {
 public:
  FilterClasses();

  /// Adds an object in a slot, which is the next one, or was left free by `rename`.
  void add(std::uint32_t slot, const FilterTraits& traits);
  /// Renames slots as BoxTree::rename does.
  void rename(std::span<const std::uint32_t> new_slots, std::size_t count);

  /// The numbers of all pairs that can never touch.
  [[nodiscard]] const FilteredPairs& filtered() const { return filtered_; }
  /// Whether there is a pair that can never touch.
  [[nodiscard]] bool filters_some() const {
    return filtered_.fixed + filtered_.by_layer + filtered_.in_group + filtered_.elsewhere > 0;
  }
  /// Whether there are so many sorts of objects that WantedFilter may let pairs pass that never touch.
  [[nodiscard]] bool needs_check() const { return bits_[shared_bit].count > 0; }

  [[nodiscard]] NodeFilter filter_of(std::uint32_t slot) const {
    return {std::uint64_t{1} << members_[slot].bit, members_[slot].group};
  }
  [[nodiscard]] WantedFilter wanted_by(const NodeFilter& node) const;

  void reserve(std::size_t objects);
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// The bits below are of classes of one group, or of none.
  static constexpr std::uint32_t group_bits = 48;
  static constexpr std::uint32_t shared_bit = 63;

  /// Objects of equal traits.
  struct Sort {
    FilterTraits traits;
    std::uint64_t count = 0;
  };
  struct Member {
    std::uint64_t group = 0;
    std::uint32_t sort = 0;  ///< into `sorts_`
    std::uint32_t bit = 0;
  };
  /// The number of objects of one group and one sort: an entry of a hash table with open addressing.
  struct GroupCount {
    std::uint64_t group = 0;  ///< 0 in a free entry
    std::uint32_t sort = 0;
    std::uint32_t count = 0;
  };

  std::uint32_t sort_of(FilterTraits traits);
  std::uint32_t bit_of(FilterTraits traits);
  void find_touching(std::uint32_t bit);
  [[nodiscard]] FilteredPairs pairs_with(const Member& member) const;
  void count(const Member& member, bool is_added);
  [[nodiscard]] std::size_t entry_of(std::uint64_t group, std::uint32_t sort) const;
  [[nodiscard]] std::uint32_t count_in_group(std::uint64_t group, std::uint32_t sort) const {
    return group_counts_.empty() ? 0 : group_counts_[entry_of(group, sort)].count;
  }
  void make_room_for_group();
  static std::size_t room_for_entries(std::size_t entries);

  std::vector<Sort> sorts_;  ///< without their groups
  std::array<Sort, shared_bit + 1> bits_;
  std::array<std::uint64_t, shared_bit + 1> touching_{};  ///< for each bit: those that it may touch
  std::vector<Member> members_;                           ///< by slot
  std::vector<GroupCount> group_counts_;                  ///< as many as a power of two, at most half in use
  std::vector<GroupCount> old_counts_;
  std::size_t group_entries_ = 0;  ///< in use, also those that count 0
  FilteredPairs filtered_;
};

}  // namespace graze
