#include "broad_phase/filter_classes.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {

/// The objects of the shared bit may touch all, and be touched by all.
FilterClasses::FilterClasses() {
  touching_.fill(std::uint64_t{1} << shared_bit);
  touching_[shared_bit] = ~std::uint64_t{0};
}

void FilterClasses::add(std::uint32_t slot, const FilterTraits& traits) {
  const Member member{traits.group, sort_of(traits), bit_of(traits)};
  if (member.group != 0) make_room_for_group();
  if (slot == members_.size()) members_.emplace_back();
  members_[slot] = member;
  filtered_ += pairs_with(member);
  count(member, true);
}

void FilterClasses::rename(std::span<const std::uint32_t> new_slots, std::size_t count_now) {
  for (std::size_t slot = 0; slot < new_slots.size(); ++slot) {
    if (new_slots[slot] != no_slot) continue;
    count(members_[slot], false);
    filtered_ -= pairs_with(members_[slot]);
  }
  renumber(members_, new_slots, count_now);
}

WantedFilter FilterClasses::wanted_by(const NodeFilter& node) const {
  WantedFilter wanted{0, node.group};
  for (std::uint64_t left = node.classes; left != 0; left &= left - 1)
    wanted.classes |= touching_[static_cast<std::size_t>(std::countr_zero(left))];
  return wanted;
}

/// The sort of an object without its group. It takes the place of one that has no objects, or is new.
std::uint32_t FilterClasses::sort_of(FilterTraits traits) {
  traits.group = 0;
  std::size_t free = sorts_.size();
  for (std::size_t sort = 0; sort < sorts_.size(); ++sort) {
    if (sorts_[sort].traits == traits) return static_cast<std::uint32_t>(sort);
    if (sorts_[sort].count == 0) free = std::min(free, sort);
  }
  if (free == sorts_.size()) sorts_.emplace_back();
  sorts_[free] = {traits, 0};
  return static_cast<std::uint32_t>(free);
}

/// The bit of an object: of its own sort and group if there is one left, else of its sort alone.
std::uint32_t FilterClasses::bit_of(FilterTraits traits) {
  for (const auto& [begin, end] : {std::pair(0U, group_bits), std::pair(group_bits, shared_bit)}) {
    std::uint32_t free = end;
    for (std::uint32_t bit = begin; bit < end; ++bit) {
      if (bits_[bit].count > 0 && bits_[bit].traits == traits) return bit;
      if (bits_[bit].count == 0) free = std::min(free, bit);
    }
    if (free < end) {
      bits_[free] = {traits, 0};
      find_touching(free);
      return free;
    }
    traits.group = 0;
  }
  return shared_bit;
}

void FilterClasses::find_touching(std::uint32_t bit) {
  for (std::uint32_t other = 0; other < shared_bit; ++other) {
    const bool touch = lasting_verdict(bits_[bit].traits, bits_[other].traits) == PairVerdict::tested;
    const auto set = [touch](std::uint64_t& bits, std::uint32_t at) {
      bits = (bits & ~(std::uint64_t{1} << at)) | (std::uint64_t{touch} << at);
    };
    set(touching_[bit], other);
    set(touching_[other], bit);
  }
}

/// The pairs of an object with all that are counted.
FilteredPairs FilterClasses::pairs_with(const Member& member) const {
  FilteredPairs pairs;
  const FilterTraits& traits = sorts_[member.sort].traits;
  for (std::uint32_t other = 0; other < sorts_.size(); ++other) {
    const PairVerdict verdict = lasting_verdict(traits, sorts_[other].traits);
    if (verdict == PairVerdict::fixed)
      pairs.fixed += sorts_[other].count;
    else if (verdict == PairVerdict::layer)
      pairs.by_layer += sorts_[other].count;
    else if (member.group != 0)
      pairs.in_group += count_in_group(member.group, other);
    if (verdict == PairVerdict::elsewhere)
      pairs.elsewhere += sorts_[other].count - (member.group == 0 ? 0 : count_in_group(member.group, other));
  }
  return pairs;
}

void FilterClasses::count(const Member& member, bool is_added) {
  for (std::uint64_t* const count : {&sorts_[member.sort].count, &bits_[member.bit].count})
    is_added ? ++*count : --*count;
  if (member.group == 0) return;
  GroupCount& entry = group_counts_[entry_of(member.group, member.sort)];
  if (entry.group == 0) {
    entry = {member.group, member.sort, 0};
    ++group_entries_;
  }
  is_added ? ++entry.count : --entry.count;
}

/// The entry of a group and class, or the free one in which it would be.
std::size_t FilterClasses::entry_of(std::uint64_t group, std::uint32_t sort) const {
  std::uint64_t mixed = (group + std::uint64_t{sort} * 0xbf58476d1ce4e5b9U) * 0x9e3779b97f4a7c15U;
  mixed ^= mixed >> 32U;
  const std::size_t mask = group_counts_.size() - 1;
  std::size_t at = mixed & mask;
  while (group_counts_[at].group != 0 && (group_counts_[at].group != group || group_counts_[at].sort != sort))
    at = (at + 1) & mask;
  return at;
}

/// Makes room for another entry. Drops those that count 0 where there is none left.
void FilterClasses::make_room_for_group() {
  if (2 * (group_entries_ + 1) <= group_counts_.size()) return;
  std::size_t used = 0;
  for (const GroupCount& entry : group_counts_) used += entry.count > 0 ? 1U : 0U;
  old_counts_.swap(group_counts_);
  group_counts_.assign(std::max(room_for_entries(used + 1), old_counts_.size()), {});
  group_entries_ = 0;
  for (const GroupCount& entry : old_counts_) {
    if (entry.count == 0) continue;
    group_counts_[entry_of(entry.group, entry.sort)] = entry;
    ++group_entries_;
  }
}

/// The size of a table that is to hold so many entries: it is at most half full after as many again.
std::size_t FilterClasses::room_for_entries(std::size_t entries) {
  constexpr std::size_t least = 4;
  return std::bit_ceil(4 * std::max(least, entries));
}

void FilterClasses::reserve(std::size_t objects) {
  members_.reserve(objects);
  group_counts_.reserve(room_for_entries(objects));
  old_counts_.reserve(room_for_entries(objects));
}

std::size_t FilterClasses::byte_count() const {
  return bytes_of(sorts_) + bytes_of(members_) + bytes_of(group_counts_) + bytes_of(old_counts_);
}

}  // namespace graze
