#pragma once

#include <algorithm>
#include <array>
#include <graze/contact.hpp>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/certain.hpp"
#include "closest_features/closest_features.hpp"
#include "core/pair/group_filter.hpp"
#include "core/surface/surface.hpp"
#include "pair/time_limit.hpp"

namespace graze {

/// The two surfaces of a query, where its undecided questions are counted, and how long it may take.
struct SurfacePair {
  const Surface& a;
  const Surface& b;
  DecisionCount& count;
  TimeLimit* time = nullptr;              ///< null where it may take as long as it does
  const FeatureFilter* groups = nullptr;  ///< null where all features may be tested

  /// Before so many pieces of work of some hundred nanoseconds each. Throws TimeIsUp.
  void check_time(std::uint32_t pieces = 1) const {
    if (time != nullptr) time->check(pieces);
  }
  /// Whether a feature of a and one of b may be tested against each other.
  [[nodiscard]] bool may(const FeatureRef& of_a, const FeatureRef& of_b) const {
    return groups == nullptr || groups->may(of_a, of_b);
  }
  /// Whether it counts that an edge or fold pierces a face.
  [[nodiscard]] bool may_pierce(const FeatureRef& of_a, const FeatureRef& of_b) const {
    return groups == nullptr || groups->may_pierce(of_a, of_b);
  }
  [[nodiscard]] bool may_vertices(std::uint32_t of_a, std::uint32_t of_b) const {
    return groups == nullptr || groups->may_vertices(of_a, of_b);
  }
  /// Whether both are one surface.
  [[nodiscard]] bool is_of_self() const { return &a == &b; }
  /// Whether any features of two regions may be tested against each other.
  [[nodiscard]] bool may_regions(const RegionPair& regions) const {
    return groups == nullptr || groups->may_regions(regions);
  }
};

inline ContactKind kind_of(const Feature& a, const Feature& b) {
  const auto low = static_cast<unsigned>(std::min(a.kind, b.kind));
  const auto high = static_cast<unsigned>(std::max(a.kind, b.kind));
  return static_cast<ContactKind>(low == 0 ? high : low + high + 1);  // VV VE VF | EE EF | FF
}

/// How two features meet.
enum class Meeting : std::uint8_t {
  pierced,   ///< an edge or fold passes through the other's triangle: distance 0
  closest,   ///< their closest points are one pair, inside both
  parallel,  ///< their closest points are a stretch or an area
};

/// How often about a contact is found: once for each of the features about it.
inline constexpr std::size_t keys_of_contact = 8;

/// Identifies a contact and the pieces of its features that realise it. Two numbers hold it and order keys as
/// contacts are ordered: by kind, feature a and feature b, which identify the contact, and by pieces after
/// that.
class FeaturePairKey {
 public:
  FeaturePairKey() = default;
  static FeaturePairKey of(const FeaturePiece& a, const FeaturePiece& b, Meeting meeting = Meeting::closest) {
    return {number(kind_of(a.feature, b.feature)) << 40U | number(a.feature.kind) << 32U | a.feature.index,
            number(b.feature.kind) << 56U | std::uint64_t{b.feature.index} << 24U | number(meeting) << 16U |
                number(a.piece) << 8U | number(b.piece)};
  }

  [[nodiscard]] ContactKind kind() const { return static_cast<ContactKind>(high_ >> 40U); }
  [[nodiscard]] FeaturePiece a() const {
    return {{static_cast<FeatureKind>(high_ >> 32U & 3U), static_cast<std::uint32_t>(high_)},
            static_cast<Piece>(low_ >> 8U & 3U)};
  }
  /// A number that orders keys by kind and feature of a.
  [[nodiscard]] std::uint64_t of_a() const { return high_; }
  [[nodiscard]] FeaturePiece b() const {
    return {{static_cast<FeatureKind>(low_ >> 56U), static_cast<std::uint32_t>(low_ >> 24U)},
            static_cast<Piece>(low_ & 3U)};
  }
  [[nodiscard]] std::uint32_t index_a() const { return static_cast<std::uint32_t>(high_); }
  [[nodiscard]] std::uint32_t index_b() const { return static_cast<std::uint32_t>(low_ >> 24U); }
  [[nodiscard]] Meeting meeting() const { return static_cast<Meeting>(low_ >> 16U & 3U); }

  friend bool operator==(const FeaturePairKey&, const FeaturePairKey&) = default;
  friend auto operator<=>(const FeaturePairKey&, const FeaturePairKey&) = default;
  /// Whether both keys are of one contact: the features are equal.
  [[nodiscard]] bool same_features(const FeaturePairKey& other) const {
    return high_ == other.high_ && low_ >> 24U == other.low_ >> 24U;
  }
  /// How many bits the indices need. `packed` gives the key as a number of the same order, if all fits.
  struct Widths {
    int index_a = 0;
    int index_b = 0;

    [[nodiscard]] int all() const { return 5 + index_a + index_b + 6; }
  };
  [[nodiscard]] std::uint64_t packed(const Widths& widths) const {
    // The contact's kind and the kind of feature a determine the kind of feature b. The last six bits are the
    // meeting and the pieces, two each.
    std::uint64_t key = (high_ >> 40U) << 2U | (high_ >> 32U & 3U);
    key = key << widths.index_a | static_cast<std::uint32_t>(high_);
    key = key << widths.index_b | static_cast<std::uint32_t>(low_ >> 24U);
    return key << 6U | (low_ >> 12U & 0x30U) | (low_ >> 6U & 0xcU) | (low_ & 3U);
  }
  static FeaturePairKey unpacked(std::uint64_t key, const Widths& widths) {
    const auto low_bits = [](int count) { return (std::uint64_t{1} << count) - 1; };
    const std::uint64_t kinds = key >> (widths.index_a + widths.index_b + 6);
    const std::uint64_t index_a = key >> (widths.index_b + 6) & low_bits(widths.index_a);
    const std::uint64_t index_b = key >> 6U & low_bits(widths.index_b);
    const std::uint64_t kind_b = kind_of_other(kinds >> 2U, kinds & 3U);
    return {(kinds >> 2U) << 40U | (kinds & 3U) << 32U | index_a,
            kind_b << 56U | index_b << 24U | (key & 0x30U) << 12U | (key & 0xcU) << 6U | (key & 3U)};
  }
  /// Its upper bits depend on all of the key.
  [[nodiscard]] std::uint64_t hash() const {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 / the golden ratio
    return (high_ * odd ^ low_) * odd;
  }

 private:
  FeaturePairKey(std::uint64_t high, std::uint64_t low) : high_(high), low_(low) {}
  /// The kind of one of a contact's two features, by that of the other: VV VE VF EE EF FF.
  static std::uint64_t kind_of_other(std::uint64_t kind, std::uint64_t of_one) {
    constexpr std::array<std::uint8_t, 6> sum{0, 1, 2, 2, 3, 4};
    return sum[static_cast<std::size_t>(kind)] - of_one;
  }
  template <typename Enumeration>
  static std::uint64_t number(Enumeration value) {
    return std::uint64_t{static_cast<std::uint8_t>(value)};
  }

  std::uint64_t high_ = 0;
  std::uint64_t low_ = 0;
};

/// The key by which two features are known. Those of one surface are met in both orders, and known by the one
/// with the lower feature first.
inline FeaturePairKey in_order(const SurfacePair& pair, const FeaturePairKey& key) {
  if (!pair.is_of_self() || key.a() <= key.b()) return key;
  return FeaturePairKey::of(key.b(), key.a(), key.meeting());
}

/// Whether an edge pierces a face, which is contact at every threshold. A fold that does is no edge.
inline bool is_edge_through_face(const FeaturePairKey& key) {
  return key.meeting() == Meeting::pierced && key.kind() == ContactKind::EF;
}

/// Two simplices whose affine hulls are as far apart as the features of a key are. They are the pieces. Of
/// parallel ones the lower is reduced to one of its points.
struct Hulls {
  Simplex a;
  Simplex b;
};
Hulls hulls_of(const SurfacePair& pair, const FeaturePairKey& key);

/// Whether the distance of two hulls is 0, by the numbers of the lowest degree that say so.
bool do_touch(const Hulls& hulls, DecisionCount& count);

/// -1, 0 or 1 as the distance of `left` is less than, equal to or greater than that of `right`.
int compare_distances(const SurfacePair& pair, const FeaturePairKey& left, const FeaturePairKey& right);

/// Whether the distance is strictly below `limit`, by whatever arithmetic it takes.
bool decide_closer_than(const SurfacePair& pair, const FeaturePairKey& key, double limit);
/// Whether the distance is strictly below `limit`. Decides it in plain double where that is certain of two
/// vertices.
inline bool is_closer_than(const SurfacePair& pair, const FeaturePairKey& key, double limit) {
  if (key.kind() == ContactKind::VV) {
    const SquaredRange squared =
        squared_range(pair.a.position(key.a().feature.index), pair.b.position(key.b().feature.index));
    const bool is_below = squared.is_below(limit);
    if (is_below || squared.is_beyond(limit)) {
      ++pair.count.in_double;
      return is_below;
    }
  }
  return decide_closer_than(pair, key, limit);
}

/// As the function above, where a range of the distance is known that mostly decides it.
inline bool is_closer_than(const SurfacePair& pair, const FeaturePairKey& key, const SquaredRange& squared,
                           double limit) {
  if (squared.is_below(limit)) return true;
  return !squared.is_beyond(limit) && is_closer_than(pair, key, limit);
}

/// At least the distance, by a relative error of some 2^-40 at most.
double upper_distance(const SurfacePair& pair, const FeaturePairKey& key);

/// The distance rounded down and up: the two are the same where it is a double.
DistanceBounds rounded_distance(const SurfacePair& pair, const FeaturePairKey& key);

}  // namespace graze
