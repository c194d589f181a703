#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <graze/contact.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "core/base/bytes_of.hpp"
#include "core/pair/near_list.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// A pair of regions, one of each object.
struct RegionPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// A pair of leaves, and two lower bounds of their distance when they were listed. `lower` bounds all
/// features that they have. `feature_lower_bound` comes from a test of the leaves. The test bounds each
/// vertex with each face and each two edges, but not an edge that comes to pierce a face.
struct ListedLeaves {
  RegionPair pair;
  float lower = 0;
  float feature_lower_bound = 0;
};

/// A point of a surface that moves with it: of a vertex, an edge, a fold or a triangle, by its corners.
struct SurfacePoint {
  std::uint32_t size = 0;  ///< how many corners, 0 for no point
  std::array<std::uint32_t, 3> corner{};
  std::array<float, 2> share{};  ///< of the ways from the first corner to the others, not more than 1 in all
};

/// Points of two surfaces that were nearest to each other.
struct LastWitness {
  SurfacePoint on_a;
  SurfacePoint on_b;

  [[nodiscard]] bool is_known() const { return on_a.size > 0; }
};

/// Whether one of two surfaces was wholly inside the other, a solid, or not at all. This stays so while the
/// surfaces move less than they were apart.
struct LastInside {
  Inside inside = Inside::none;
  double apart = 0;  ///< 0 where nothing is known
  Travel travel_a;
  Travel travel_b;
};

/// The pairs of leaves where DMV stopped for one pair of surfaces: every pair that may have been near. The
/// next query can start there if its detail is about surfaces, or about vertices, as this one's was. The
/// front stays good while the surfaces move less than the slack that it was made with. The list of near
/// features below stays good in the same way.
struct LeafFront {
  std::vector<ListedLeaves> leaves;  ///< in the order in which they are asked, where `touched`
  /// A lower bound of the distance, at the two marks, of every pair of leaves that is not listed. It is
  /// negative where nothing is known.
  double unlisted_lower_bound = -1;
  Travel travel_a;
  Travel travel_b;
  /// The nearest points of the last answer. At the present positions they give an upper bound of the
  /// surfaces' distance, whatever has moved.
  LastWitness witness;
  /// The last state of a pair with a solid. It is null before the first query about one.
  std::unique_ptr<LastInside> last_inside;
  /// The list that a query for contacts uses instead of leaves, with marks of its own. It is null before the
  /// first such query.
  std::unique_ptr<NearList> near;
  /// A lower bound of the surfaces' distance at the two marks. While they have moved less than that, no edge
  /// pierces a face, and `feature_lower_bound` covers everything that counts.
  float apart = 0;
  /// Whether the surfaces were at distance 0 when a query last searched for the closest points.
  bool touched = false;
  /// How many pairs of leaves the last walk reached, as the number of its bits.
  std::uint8_t reached_bits = 0;
  /// Whether the last query went from region to region: if not, their bounds may grow looser than others'.
  bool walked = true;
  /// There were too many features for a list the last time.
  bool list_is_too_long = false;

  void forget() {
    forget_leaves();
    forget_list();
    if (last_inside != nullptr) *last_inside = {};
  }
  void forget_list() {
    if (near != nullptr) near->forget();
    list_is_too_long = false;
  }
  void forget_leaves() {
    leaves.clear();
    reached_bits = 0;
    unlisted_lower_bound = -1;
    apart = 0;
    witness = {};
    touched = false;
  }
  /// The list, where it says all that can be in contact below a threshold now. Otherwise it is null.
  [[nodiscard]] const NearList* list_for(const Surface& a, const Surface& b, double threshold) const {
    return near != nullptr && near->serves(a, b, threshold) ? near.get() : nullptr;
  }
  [[nodiscard]] std::size_t byte_count() const {
    return bytes_of(leaves) + (near == nullptr ? 0 : sizeof(NearList) + bytes_of(near->pairs)) +
           (last_inside == nullptr ? 0 : sizeof(LastInside));
  }
  /// No pair of leaves that is not listed is closer than this now. Not positive where nothing is known.
  [[nodiscard]] double unlisted_lower_bound_now(const Surface& a, const Surface& b) const {
    if (!(unlisted_lower_bound > 0)) return -1;
    if (unlisted_lower_bound == std::numeric_limits<double>::infinity()) return unlisted_lower_bound;
    return (unlisted_lower_bound - motion_now(a, b)) * round_down;
  }
  /// Pairs of leaves are at most this much nearer to each other than they were at the two marks.
  [[nodiscard]] double motion_now(const Surface& a, const Surface& b) const {
    return (a.motion_since(travel_a) + b.motion_since(travel_b)) * round_up;
  }
};

}  // namespace graze
