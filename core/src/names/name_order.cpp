#include "names/name_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

#include "pair/room_in_time.hpp"

namespace graze {
namespace {

/// Below this comparing is cheaper.
constexpr std::size_t short_list = 64;

constexpr int digit_bits = 8;
constexpr std::size_t digit_count = std::size_t{1} << digit_bits;
constexpr int key_bits = std::numeric_limits<std::uint64_t>::digits;

ContactName::Widths widths_of(std::span<const ContactName> names) {
  std::uint32_t of_a = 0;
  std::uint32_t of_b = 0;
  for (const ContactName& name : names) {
    of_a |= name.a().feature.index;
    of_b |= name.b().feature.index;
  }
  return {static_cast<int>(std::bit_width(of_a)), static_cast<int>(std::bit_width(of_b))};
}

/// By kind and feature of a alone.
bool by_feature_of_a(const ContactName& left, const ContactName& right) {
  return left.of_a() < right.of_a();
}

/// Sorts those of one feature of a each, as they are left where those of a come in order: mostly a few.
void sort_groups(std::span<ContactName> names) {
  for (auto begin = names.begin(); begin != names.end();) {
    auto end = begin;
    while (++end != names.end() && end->of_a() == begin->of_a()) {
    }
    if (end - begin > 1) std::sort(begin, end);
    begin = end;
  }
}

std::size_t digit(std::uint64_t key, int shift) {
  return key >> shift & (digit_count - 1);
}

}  // namespace

/// From the lowest digit up. Each begins at a bit that is not the same in all keys.
void NameOrder::sort_keys() {
  std::uint64_t varying = 0;
  for (const std::uint64_t key : keys_) varying |= key ^ keys_.front();
  for (int shift = 0; shift < key_bits && varying >> shift != 0; shift += digit_bits) {
    shift += std::countr_zero(varying >> shift);
    std::array<std::uint32_t, digit_count> begin{};
    for (const std::uint64_t key : keys_) ++begin[digit(key, shift)];
    std::uint32_t sum = 0;
    for (std::uint32_t& entry : begin) sum += std::exchange(entry, sum);
    spare_.resize(keys_.size());
    for (const std::uint64_t key : keys_) spare_[begin[digit(key, shift)]++] = key;
    keys_.swap(spare_);
  }
}

void NameOrder::make_room(std::size_t count, TimeLimit* time) {
  if (time == nullptr || count < short_list) return;
  for (auto* const keys : {&keys_, &spare_})
    if (keys->size() < count) make_room_in_time(*keys, count, time);
}

void NameOrder::sort(std::span<ContactName> names) {
  if (std::is_sorted(names.begin(), names.end(), by_feature_of_a)) return sort_groups(names);
  if (names.size() < short_list) return std::sort(names.begin(), names.end());
  const ContactName::Widths widths = widths_of(names);
  if (widths.all() > key_bits) return std::sort(names.begin(), names.end());
  keys_.resize(names.size());
  std::transform(names.begin(), names.end(), keys_.begin(),
                 [&](const ContactName& name) { return name.packed(widths); });
  sort_keys();
  std::transform(keys_.begin(), keys_.end(), names.begin(),
                 [&](std::uint64_t key) { return ContactName::unpacked(key, widths); });
}

}  // namespace graze
