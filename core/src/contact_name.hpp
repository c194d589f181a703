#pragma once

#include <algorithm>
#include <graze/contact.hpp>
#include <graze/surface.hpp>

#include "arithmetic.hpp"
#include "certain.hpp"
#include "naming.hpp"

namespace graze {

/// The two surfaces of a query, and where its undecided questions are counted.
struct SurfacePair {
  const Surface& a;
  const Surface& b;
  DecisionCount& count;
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
inline constexpr std::size_t names_of_contact = 8;

/// What a contact is called, and which pieces of its features realise it. Ordered as contacts are.
struct ContactName {
  ContactKind kind = ContactKind::VV;
  FeaturePiece a;
  FeaturePiece b;
  Meeting meeting = Meeting::closest;

  static ContactName of(const FeaturePiece& a, const FeaturePiece& b, Meeting meeting = Meeting::closest) {
    return {kind_of(a.feature, b.feature), a, b, meeting};
  }
  friend bool operator==(const ContactName&, const ContactName&) = default;
  /// By (kind, feature a, feature b), the key of a contact; pieces after that.
  friend auto operator<=>(const ContactName& left, const ContactName& right) {
    const std::uint64_t left_high = left.high_key();
    const std::uint64_t right_high = right.high_key();
    return left_high != right_high ? left_high <=> right_high : left.low_key() <=> right.low_key();
  }
  /// Whether both are the contact of the same two features.
  [[nodiscard]] bool same_features(const ContactName& other) const {
    return a.feature == other.a.feature && b.feature == other.b.feature;
  }
  /// Its upper bits depend on all of the name.
  [[nodiscard]] std::uint64_t hash() const {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15;  // 2^64 / the golden ratio
    return (high_key() * odd ^ low_key()) * odd;
  }

 private:
  /// What names are ordered by, as two numbers.
  [[nodiscard]] std::uint64_t high_key() const {
    return std::uint64_t{static_cast<std::uint8_t>(kind)} << 40U |
           std::uint64_t{static_cast<std::uint8_t>(a.feature.kind)} << 32U | a.feature.index;
  }
  [[nodiscard]] std::uint64_t low_key() const {
    return std::uint64_t{static_cast<std::uint8_t>(b.feature.kind)} << 56U |
           std::uint64_t{b.feature.index} << 24U | std::uint64_t{static_cast<std::uint8_t>(meeting)} << 16U |
           std::uint64_t{static_cast<std::uint8_t>(a.piece)} << 8U | static_cast<std::uint8_t>(b.piece);
  }
};

/// Two simplices whose affine hulls are as far apart as the features of a name are: their pieces, but for
/// parallel ones one point of the lower in place of it.
struct Hulls {
  Simplex a;
  Simplex b;
};
Hulls hulls_of(const SurfacePair& pair, const ContactName& name);

/// -1, 0 or 1 as the distance of `left` is less than, equal to or greater than that of `right`.
int compare_distances(const SurfacePair& pair, const ContactName& left, const ContactName& right);

/// Whether the distance is strictly below `limit`, by whatever arithmetic it takes.
bool decide_closer_than(const SurfacePair& pair, const ContactName& name, double limit);
/// The same, from plain double where that is certain of two vertices.
inline bool is_closer_than(const SurfacePair& pair, const ContactName& name, double limit) {
  if (name.kind == ContactKind::VV) {
    const SquaredRange squared =
        squared_range(pair.a.position(name.a.feature.index), pair.b.position(name.b.feature.index));
    const bool is_below = squared.is_below(limit);
    if (is_below || squared.is_beyond(limit)) {
      ++pair.count.in_double;
      return is_below;
    }
  }
  return decide_closer_than(pair, name, limit);
}

/// At least the distance, by a relative error of some 2^-40 at most.
double upper_distance(const SurfacePair& pair, const ContactName& name);

/// The distance rounded down and up: the two are the same where it is a double.
DistanceBounds rounded_distance(const SurfacePair& pair, const ContactName& name);

}  // namespace graze
