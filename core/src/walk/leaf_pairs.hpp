#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "closest_features/feature_pair_key.hpp"
#include "core/mesh/pair_room.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/pair/pair_query.hpp"
#include "leaves/layout/leaf_features.hpp"
#include "pair/bounds.hpp"
#include "surface/leaf_boxes.hpp"
#include "surface/leaf_motion.hpp"
#include "surface/long_leaf_boxes.hpp"
#include "surface/per_leaf_cache.hpp"
#include "walk/dmv.hpp"

namespace graze {

/// A pair of leaves that may be near, and a lower bound of how far apart they are.
struct LeafPair {
  double lower = 0;
  RegionPair pair;
  std::uint32_t listed = 0;       ///< its index in the front that it was selected from
  float feature_lower_bound = 0;  ///< as ListedLeaves has it, now
};

/// The roots of both surfaces' regions, which are the surfaces as a whole.
inline constexpr RegionPair whole_surfaces;

/// Indices into a front.
class ListedIndices {
 public:
  /// Room for so many, whatever they are.
  std::uint32_t* room_for(std::size_t count) {
    if (indices_.size() < count) indices_.resize(count);
    return indices_.data();
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.indices_);
  }
  void reserve(const PairRoom& room) { indices_.reserve(room.leaf_pairs); }

 private:
  std::vector<std::uint32_t> indices_;
};

struct LeafPairScratch {
  DmvScratch dmv;
  LeafBoxes boxes_a;
  LeafBoxes boxes_b;
  LongLeafBoxes long_a;
  LongLeafBoxes long_b;
  ListedIndices listed;
  PerLeafCache<LeafMotion> motions;  ///< of one surface with itself

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.dmv, self.boxes_a, self.boxes_b, self.long_a, self.long_b, self.listed,
                    self.motions);
  }
};

/// The pairs of leaves that a query tests, and a lower bound for the others.
struct LeafPairList {
  std::vector<LeafPair> leaves;
  /// No pair of leaves that was left out on the way is nearer.
  double unlisted_lower_bound = std::numeric_limits<double>::infinity();

  void clear() {
    leaves.clear();
    unlisted_lower_bound = std::numeric_limits<double>::infinity();
  }
};

/// Finds pairs of leaves that may be near: among those of a front, or those that DMV reaches.
class LeafPairs {
 public:
  LeafPairs(const SurfacePair& pair, const PairQuery& query, LeafPairScratch& scratch, WorkMeter& meter)
      : pair_(pair),
        query_(query),
        scratch_(scratch),
        meter_(meter),
        bounds_(pair.a, pair.b, boxes_for(query.detail)) {
    scratch_.boxes_a.begin(pair.a, boxes_for(query.detail));
    scratch_.boxes_b.begin(pair.b, boxes_for(query.detail));
    if (boxes_for(query.detail) != RefitOf::faces) return;
    scratch_.long_a.begin(pair.a);
    scratch_.long_b.begin(pair.b);
    has_long_ = scratch_.long_a.any() || scratch_.long_b.any();
  }

  /// Appends those leaf pairs of a part of a front that are not further than a distance. Where the surfaces
  /// are `certainly_apart`, their feature bounds count, too. It has no branch, since which pairs these are is
  /// as good as random. For most of them the bounds from when they were listed are enough, and no box is
  /// read.
  void select_from(const LeafFront& front, std::size_t begin, std::size_t end, double distance,
                   bool certainly_apart, LeafPairList& found) {
    std::uint32_t* const listed = scratch_.listed.room_for(end - begin);
    const double most = (distance + front.motion_now(pair_.a, pair_.b)) * round_up;
    const float use_feature_bounds = certainly_apart ? 1.0F : 0.0F;
    std::size_t taken = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const ListedLeaves& leaves = front.leaves[i];
      listed[taken] = static_cast<std::uint32_t>(i);
      taken +=
          static_cast<double>(std::max(leaves.lower, use_feature_bounds * leaves.feature_lower_bound)) <= most
              ? 1U
              : 0U;
    }
    std::size_t count = found.leaves.size();
    found.leaves.resize(count + taken);
    for (std::size_t k = 0; k < taken; ++k) {
      const RegionPair& leaves = front.leaves[listed[k]].pair;
      const double lower = lower_of_leaves(leaves);
      found.leaves[count] = {lower, leaves, listed[k], 0};
      count += lower <= distance ? 1U : 0U;
    }
    found.leaves.resize(count);
  }

  /// Appends the leaf pairs that DMV reaches from `start` while `keep(lower, slack)` holds. That says whether
  /// a pair at least `lower` apart may come to matter before the surfaces have moved by `slack`. `meet(pair)`
  /// is called for every pair of regions. Regions whose groups leave nothing to be tested are passed over.
  /// The walk stops where a level has more than `most` pairs: those are then `front()`. Returns false when
  /// the budget ran out.
  template <typename Keep, typename Meet>
  bool walk(std::span<const RegionPair> start, const Keep& keep, const Meet& meet, LeafPairList& found,
            std::size_t most = std::numeric_limits<std::size_t>::max()) {
    scratch_.dmv.front.assign(start.begin(), start.end());
    const auto keeps = [&](double lower) {
      if (keep(lower, query_.slack)) return true;
      found.unlisted_lower_bound = std::min(found.unlisted_lower_bound, lower);
      return false;
    };
    return dmv(
        pair_.a.mesh().regions(), pair_.b.mesh().regions(), pair_.is_of_self(), scratch_.dmv, meter_,
        [&](const RegionPair& regions, const Region& a, const Region& b) {
          if (!pair_.may_regions(regions)) return Expansion{};
          meet(regions);
          return keeps(bounds_.lower(regions)) ? expansion_of(regions, a, b) : Expansion{};
        },
        [&](const RegionPair& regions) { return keeps(bounds_.lower(regions)); },
        [&](const RegionPair& leaves, const Region&, const Region&) {
          if (!pair_.may_regions(leaves)) return;
          meet(leaves);
          const double lower = bounds_.lower(leaves);
          if (!keeps(lower)) return;
          const RegionPair listed = in_order(leaves);
          found.leaves.push_back({std::max(lower, lower_of_leaves(listed)), listed, 0, 0});
        },
        most);
  }
  /// Walks the surfaces as a whole.
  template <typename Keep, typename Meet>
  bool walk_all(const Keep& keep, const Meet& meet, LeafPairList& found,
                std::size_t most = std::numeric_limits<std::size_t>::max()) {
    return walk({&whole_surfaces, 1}, keep, meet, found, most);
  }
  /// At most how far apart two leaves are.
  double lower_of_leaves(const RegionPair& leaves) {
    const double lower = lower_distance(scratch_.boxes_a.of(leaves.a), scratch_.boxes_b.of(leaves.b));
    return has_long_ ? std::max(lower, lower_of_long_leaves(leaves)) : lower;
  }
  /// A tighter bound, which takes longer: it is worth it for leaves that are to be tested. It is 0 where it
  /// says nothing more.
  double lower_by_corners(const RegionPair& leaves) { return has_long_ ? lower_along_long(leaves) : 0; }
  /// A bound by how two leaves of one surface have moved since rest. Of those that hardly bend it leaves
  /// nothing to be tested. Features that may pierce each other are further apart than `pierced`, or it is 0.
  /// It is 0 where it says nothing.
  double lower_since_rest(const RegionPair& leaves, double pierced) {
    return pair_.is_of_self() ? lower_of_self(leaves, pierced) : 0;
  }
  /// The pairs at which the last walk stopped.
  [[nodiscard]] std::span<const RegionPair> front() const { return scratch_.dmv.front; }

  [[nodiscard]] LeafOf leaf_a(const RegionPair& leaves) {
    return {pair_.a.mesh().regions().region(leaves.a), scratch_.boxes_a.of(leaves.a),
            has_long_ ? scratch_.long_a.of(leaves.a) : nullptr};
  }
  [[nodiscard]] LeafOf leaf_b(const RegionPair& leaves) {
    return {pair_.b.mesh().regions().region(leaves.b), scratch_.boxes_b.of(leaves.b),
            has_long_ ? scratch_.long_b.of(leaves.b) : nullptr};
  }

 private:
  /// Two leaves of one surface are known by the one with the lower number first.
  [[nodiscard]] RegionPair in_order(const RegionPair& leaves) const {
    if (!pair_.is_of_self()) return leaves;
    return {std::min(leaves.a, leaves.b), std::max(leaves.a, leaves.b)};
  }
  [[nodiscard]] Expansion expansion_of(const RegionPair& regions, const Region& a, const Region& b) const {
    return expansion_by_size(a, bounds_.size_a(regions), b, bounds_.size_b(regions));
  }
  // Apart from what calls them, which is so small that it is inlined.
  [[nodiscard]] double lower_of_long_leaves(const RegionPair& leaves);
  [[nodiscard]] double lower_along_long(const RegionPair& leaves);
  [[nodiscard]] double lower_of_self(const RegionPair& leaves, double pierced);

  const SurfacePair& pair_;
  const PairQuery& query_;
  LeafPairScratch& scratch_;
  WorkMeter& meter_;
  RegionBounds bounds_;
  bool has_long_ = false;  ///< of either surface
};

}  // namespace graze
