#include "name_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace graze {
namespace {

/// Below this comparing is cheaper.
constexpr std::size_t short_list = 64;

constexpr int digit_bits = 8;
constexpr std::size_t digit_count = std::size_t{1} << digit_bits;
constexpr int most_digits = 64 / digit_bits;

/// A name as a number of the same order: kind, feature a, feature b, meeting, pieces, from the top.
class Packing {
 public:
  explicit Packing(const std::vector<ContactName>& names) {
    std::uint32_t of_a = 0;
    std::uint32_t of_b = 0;
    for (const ContactName& name : names) {
      of_a |= name.a.feature.index;
      of_b |= name.b.feature.index;
    }
    index_a_bits_ = static_cast<int>(std::bit_width(of_a));
    index_b_bits_ = static_cast<int>(std::bit_width(of_b));
  }
  [[nodiscard]] int bits() const { return 3 + 2 + index_a_bits_ + 2 + index_b_bits_ + 3 * 2; }

  [[nodiscard]] std::uint64_t key(const ContactName& name) const {
    auto key = static_cast<std::uint64_t>(name.kind);
    key = key << 2 | static_cast<std::uint64_t>(name.a.feature.kind);
    key = key << index_a_bits_ | name.a.feature.index;
    key = key << 2 | static_cast<std::uint64_t>(name.b.feature.kind);
    key = key << index_b_bits_ | name.b.feature.index;
    key = key << 2 | static_cast<std::uint64_t>(name.meeting);
    key = key << 2 | static_cast<std::uint64_t>(name.a.piece);
    return key << 2 | static_cast<std::uint64_t>(name.b.piece);
  }
  [[nodiscard]] ContactName name(std::uint64_t key) const {
    const auto take = [&](int bits) {
      const std::uint64_t taken = key & ((std::uint64_t{1} << bits) - 1);
      key >>= bits;
      return static_cast<std::uint32_t>(taken);
    };
    ContactName name;
    name.b.piece = static_cast<Piece>(take(2));
    name.a.piece = static_cast<Piece>(take(2));
    name.meeting = static_cast<Meeting>(take(2));
    name.b.feature.index = take(index_b_bits_);
    name.b.feature.kind = static_cast<FeatureKind>(take(2));
    name.a.feature.index = take(index_a_bits_);
    name.a.feature.kind = static_cast<FeatureKind>(take(2));
    name.kind = static_cast<ContactKind>(take(3));
    return name;
  }

 private:
  int index_a_bits_ = 0;
  int index_b_bits_ = 0;
};

std::size_t digit(std::uint64_t key, int place) {
  return key >> (place * digit_bits) & (digit_count - 1);
}

}  // namespace

/// From the lowest digit up; digits that all keys share are passed over.
void NameOrder::sort_keys() {
  std::uint64_t varying = 0;
  for (const std::uint64_t key : keys_) varying |= key ^ keys_.front();
  for (int place = 0; place < most_digits; ++place) {
    if (digit(varying, place) == 0) continue;
    std::array<std::uint32_t, digit_count> begin{};
    for (const std::uint64_t key : keys_) ++begin[digit(key, place)];
    std::uint32_t sum = 0;
    for (std::uint32_t& entry : begin) sum += std::exchange(entry, sum);
    spare_.resize(keys_.size());
    for (const std::uint64_t key : keys_) spare_[begin[digit(key, place)]++] = key;
    keys_.swap(spare_);
  }
}

void NameOrder::sort(std::vector<ContactName>& names) {
  if (names.size() < short_list) return std::sort(names.begin(), names.end());
  const Packing packing(names);
  if (packing.bits() > 64) return std::sort(names.begin(), names.end());
  keys_.resize(names.size());
  std::transform(names.begin(), names.end(), keys_.begin(),
                 [&](const ContactName& name) { return packing.key(name); });
  sort_keys();
  std::transform(keys_.begin(), keys_.end(), names.begin(),
                 [&](std::uint64_t key) { return packing.name(key); });
}

}  // namespace graze
