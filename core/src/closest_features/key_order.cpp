#include "closest_features/key_order.hpp"

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
constexpr int packed_bits = std::numeric_limits<std::uint64_t>::digits;

FeaturePairKey::Widths widths_of(std::span<const FeaturePairKey> keys) {
  std::uint32_t of_a = 0;
  std::uint32_t of_b = 0;
  for (const FeaturePairKey& key : keys) {
    of_a |= key.a().feature.index;
    of_b |= key.b().feature.index;
  }
  return {static_cast<int>(std::bit_width(of_a)), static_cast<int>(std::bit_width(of_b))};
}

/// By kind and feature of a alone.
bool by_feature_of_a(const FeaturePairKey& left, const FeaturePairKey& right) {
  return left.of_a() < right.of_a();
}

/// Sorts those of one feature of a each, as they are left where those of a come in order: mostly a few.
void sort_groups(std::span<FeaturePairKey> keys) {
  for (auto begin = keys.begin(); begin != keys.end();) {
    auto end = begin;
    while (++end != keys.end() && end->of_a() == begin->of_a()) {
    }
    if (end - begin > 1) std::sort(begin, end);
    begin = end;
  }
}

std::size_t digit(std::uint64_t packed, int shift) {
  return packed >> shift & (digit_count - 1);
}

}  // namespace

/// Sorts from the lowest digit up. Each digit begins at a bit that is not equal in all keys.
void KeyOrder::sort_packed() {
  std::uint64_t varying = 0;
  for (const std::uint64_t packed : packed_) varying |= packed ^ packed_.front();
  for (int shift = 0; shift < packed_bits && varying >> shift != 0; shift += digit_bits) {
    shift += std::countr_zero(varying >> shift);
    std::array<std::uint32_t, digit_count> begin{};
    for (const std::uint64_t packed : packed_) ++begin[digit(packed, shift)];
    std::uint32_t sum = 0;
    for (std::uint32_t& entry : begin) sum += std::exchange(entry, sum);
    spare_.resize(packed_.size());
    for (const std::uint64_t packed : packed_) spare_[begin[digit(packed, shift)]++] = packed;
    packed_.swap(spare_);
  }
}

void KeyOrder::make_room(std::size_t count, TimeLimit* time) {
  if (time == nullptr || count < short_list) return;
  for (auto* const list : {&packed_, &spare_})
    if (list->size() < count) make_room_in_time(*list, count, time);
}

void KeyOrder::sort(std::span<FeaturePairKey> keys) {
  if (std::is_sorted(keys.begin(), keys.end(), by_feature_of_a)) return sort_groups(keys);
  if (keys.size() < short_list) return std::sort(keys.begin(), keys.end());
  const FeaturePairKey::Widths widths = widths_of(keys);
  if (widths.all() > packed_bits) return std::sort(keys.begin(), keys.end());
  packed_.resize(keys.size());
  std::transform(keys.begin(), keys.end(), packed_.begin(),
                 [&](const FeaturePairKey& key) { return key.packed(widths); });
  sort_packed();
  std::transform(packed_.begin(), packed_.end(), keys.begin(),
                 [&](std::uint64_t packed) { return FeaturePairKey::unpacked(packed, widths); });
}

}  // namespace graze
