#include "pairs/ignored_objects.hpp"

#include <algorithm>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {
namespace {

PairSet::Pair sorted_pair(std::uint64_t serial_a, std::uint64_t serial_b) {
  return std::minmax({serial_a, serial_b});
}

bool is_counted(const Object& a, const Object& b) {
  return lasting_verdict(filter_traits_of(a), filter_traits_of(b)) == PairVerdict::tested;
}

}  // namespace

void IgnoredObjects::set(Object& a, Object& b, bool ignored, ChangedPairs& changed) {
  const PairSet::Pair serials = sorted_pair(a.serial, b.serial);
  if (pairs_.contains(serials) == ignored) return;
  changed.add(serials);
  const bool counts = is_counted(a, b);
  if (!ignored) {
    pairs_.erase(serials);
    some_erased_ = true;
    if (counts) --counted_;
    return;
  }
  make_room(a);
  make_room(b);
  pairs_.insert(serials);
  a.ignored_partners.push_back({b.serial, counts});
  b.ignored_partners.push_back({a.serial, counts});
  if (counts) ++counted_;
}

/// Makes room for one partner more. Drops those of pairs that are not ignored any more where there is none
/// left.
void IgnoredObjects::make_room(Object& object) {
  auto& partners = object.ignored_partners;
  if (partners.size() < partners.capacity()) return;
  if (some_erased_) {
    std::sort(partners.begin(), partners.end());
    partners.erase(std::unique(partners.begin(), partners.end()), partners.end());
    std::erase_if(partners, [&](const IgnoredPartner& partner) {
      return !pairs_.contains(sorted_pair(object.serial, partner.serial));
    });
  }
  constexpr std::size_t least = 4;
  const std::size_t before = bytes_of(partners);
  if (2 * partners.size() >= partners.capacity()) partners.reserve(std::max(least, 2 * partners.capacity()));
  partner_bytes_ += bytes_of(partners) - before;
}

void IgnoredObjects::forget(Object& object) {
  for (const IgnoredPartner& partner : object.ignored_partners)
    if (pairs_.erase(sorted_pair(object.serial, partner.serial)) && partner.counts) --counted_;
  some_erased_ = some_erased_ || !object.ignored_partners.empty();
  partner_bytes_ -= bytes_of(object.ignored_partners);
  std::vector<IgnoredPartner>().swap(object.ignored_partners);  // with its memory
}

}  // namespace graze
