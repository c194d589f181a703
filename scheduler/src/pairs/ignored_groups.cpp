#include "pairs/ignored_groups.hpp"

namespace graze {

void IgnoredGroups::set(const Object& a, std::uint8_t group_a, const Object& b, std::uint8_t group_b,
                        bool ignored, ChangedPairs& changed) {
  if (b.serial < a.serial) return set(b, group_b, a, group_a, ignored, changed);
  const Serials serials{a.serial, b.serial};
  auto found = pairs_.find(serials);
  if (found == pairs_.end()) {
    if (!ignored) return;
    const bool counts = a.serial != b.serial &&
                        lasting_verdict(filter_traits_of(a), filter_traits_of(b)) == PairVerdict::tested;
    found = pairs_.emplace(serials, Known{GroupFilter(a.face_groups, b.face_groups), counts}).first;
  }
  changed.add(serials);
  Known& known = found->second;
  known.filter.set_ignored(group_a, group_b, ignored);
  if (a.serial == b.serial) known.filter.set_ignored(group_b, group_a, ignored);
  known.version = ++version_;
}

void IgnoredGroups::regroup(std::uint64_t serial, const std::shared_ptr<const FaceGroups>& groups,
                            ChangedPairs& changed) {
  for (auto& [serials, known] : pairs_) {
    if (serials.first != serial && serials.second != serial) continue;
    changed.add(serials);
    if (serials.first == serial) known.filter.set_groups_of_a(groups);
    if (serials.second == serial) known.filter.set_groups_of_b(groups);
    known.version = ++version_;
  }
}

void IgnoredGroups::forget(std::uint64_t serial) {
  std::erase_if(
      pairs_, [&](const auto& known) { return known.first.first == serial || known.first.second == serial; });
}

bool IgnoredGroups::ignores_all(std::uint64_t serial_a, std::uint64_t serial_b) const {
  const auto found = pairs_.find({serial_a, serial_b});
  return found != pairs_.end() && !found->second.filter.leaves_some();
}

PairGroups IgnoredGroups::of(std::uint64_t serial_a, std::uint64_t serial_b) const {
  const auto found = pairs_.find({serial_a, serial_b});
  if (found == pairs_.end()) return {};
  const GroupFilter& filter = found->second.filter;
  const bool is_needed = filter.leaves_some() && !filter.leaves_all();
  return {is_needed ? &filter : nullptr, found->second.version};
}

std::uint64_t IgnoredGroups::counted_besides(const IgnoredObjects& whole) const {
  std::uint64_t count = 0;
  for (const auto& [serials, known] : pairs_)
    if (known.counts && !known.filter.leaves_some() && !whole.contains(serials)) ++count;
  return count;
}

std::size_t IgnoredGroups::byte_count() const {
  constexpr std::size_t bytes_of_node = 4 * sizeof(void*);
  std::size_t bytes = 0;
  for (const auto& [serials, known] : pairs_)
    bytes +=
        bytes_of_node + sizeof(serials) + sizeof(known) - sizeof(known.filter) + known.filter.byte_count();
  return bytes;
}

}  // namespace graze
