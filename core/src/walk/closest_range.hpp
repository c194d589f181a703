#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "closest_features/closest_set.hpp"
#include "core/pair/pair_query.hpp"
#include "leaves/leaf_feature_pairs.hpp"
#include "leaves/leaf_vertex_pairs.hpp"
#include "leaves/touching_edges.hpp"
#include "pair/bounds.hpp"
#include "walk/leaf_pairs.hpp"

namespace graze {

/// The result of a search for the closest points so far.
struct ClosestFound {
  Closest closest;
  /// Nothing was left out that is nearer than this, but for the keys found.
  double lower = std::numeric_limits<double>::infinity();

  void clear() {
    closest.clear();
    lower = std::numeric_limits<double>::infinity();
  }
};

/// Branch and bound over pairs of regions: middle vertices give an upper bound, boxes a lower one. Pairs
/// certainly not below the reach are not tested. In AccuracyMode::within a pair is tested only if it is below
/// the threshold, or more than the tolerance nearer than the nearest so far.
class ClosestRange {
 public:
  /// Goes on from `found`.
  ClosestRange(const SurfacePair& pair, const PairQuery& query, Ties ties, ClosestFound& found,
               bool may_pierce = true)
      : pair_(pair),
        query_(query),
        found_(found),
        set_(pair, ties, found.closest),
        leaf_test_slack_(query.mode == AccuracyMode::exact ? query.leaf_test_slack : 0),
        may_pierce_(may_pierce) {}

  /// Whether a pair this near could still matter, now or before the surfaces have moved by `slack`. A pair
  /// that is left out bounds the answer from below.
  bool keep(double lower_bound, double slack = 0) {
    const double nearest = std::max(0.0, lower_bound - slack);
    seen_ = std::min(seen_, lower_bound);
    if (nearest > set_.upper()) return false;
    const bool below_reach = nearest < query_.reach || nearest == 0;
    const bool loose = query_.mode == AccuracyMode::within && nearest >= query_.threshold && nearest > 0 &&
                       nearest >= set_.upper() - query_.tolerance;
    if (below_reach && !loose) return true;
    found_.lower = std::min(found_.lower, lower_bound);
    return false;
  }

  /// The distance, in units of the scene, from which on a pair certainly does not matter now.
  [[nodiscard]] double limit() const {
    const double reached = std::min(set_.upper(), query_.reach) + leaf_test_slack_;
    if (query_.mode != AccuracyMode::within) return reached;
    return std::min(reached, std::max(query_.threshold, set_.upper() - query_.tolerance));
  }
  /// Keys are wanted with the range of their distance.
  [[nodiscard]] static double keys_only_below() { return 0; }
  /// Something was left out that is further than an earlier or the present limit.
  void left_out(double limit) {
    if (limit < set_.upper()) found_.lower = std::min(found_.lower, limit);
  }

  /// Whether nothing can come nearer, and the search may stop. Surfaces that pierce each other do so at many
  /// points, any of which is a witness.
  [[nodiscard]] bool is_decided() const { return set_.is_decided(query_.threshold); }

  /// Whether an edge pierces a face, among what has been found.
  [[nodiscard]] bool has_pierced() const { return found_.closest.pierced; }
  /// Nothing further than this is nearest.
  [[nodiscard]] double upper() const { return set_.upper(); }
  void offer(const FeaturePairKey& key) { set_.offer(key); }
  /// Offers the middle vertices of two regions of which some features may be tested. If the middle
  /// vertices may not, the regions' boxes bound the distance.
  void offer_middles(const RegionPair& regions) {
    const std::uint32_t a = pair_.a.mesh().regions().region(regions.a).middle;
    const std::uint32_t b = pair_.b.mesh().regions().region(regions.b).middle;
    if (pair_.may_vertices(a, b))
      offer_apart(a, b);
    else if (!is_about_vertices(query_.detail) && !pair_.is_of_self())
      at_most(RegionBounds(pair_.a, pair_.b, RefitOf::faces).upper(regions));
  }
  /// Offers two vertices of the surfaces before the search begins: the roots' middle vertices, or corners of
  /// faces that may be tested.
  void offer_some() {
    if (pair_.groups == nullptr) return offer_middles(whole_surfaces);
    if (const auto some = pair_.groups->some_vertices(pair_.a.mesh(), pair_.b.mesh()))
      offer_apart((*some)[0], (*some)[1]);
  }
  /// Offers two vertices, wherever they are, where nothing is below the reach. Returns false if no two are
  /// known.
  bool offer_any() {
    std::optional<std::array<std::uint32_t, 2>> any =
        std::array{pair_.a.mesh().regions().region(whole_surfaces.a).middle,
                   pair_.b.mesh().regions().region(whole_surfaces.b).middle};
    if (pair_.groups != nullptr) any = pair_.groups->some_vertices(pair_.a.mesh(), pair_.b.mesh());
    if (any) set_.offer(FeaturePairKey::of(vertex_piece((*any)[0]), vertex_piece((*any)[1])));
    return any.has_value();
  }
  /// Offers two vertices that are apart.
  void offer_apart(std::uint32_t a, std::uint32_t b) {
    // Not at 0: whether a walk came by must not show in the witness.
    const double upper = upper_distance(pair_.a.position(a), pair_.b.position(b));
    if (may_be_apart(upper) && upper < set_.upper())
      set_.offer(FeaturePairKey::of(vertex_piece(a), vertex_piece(b)));
  }
  /// Tells that points of both surfaces are this far apart. It does not count at 0, as with middle vertices.
  /// Nor does it count where a key must be that near, since a search to a tolerance may leave it out.
  void at_most(double upper) {
    if (may_be_apart(upper) && query_.mode == AccuracyMode::exact) set_.at_most(upper);
  }
  /// Whether an edge may pierce a face.
  [[nodiscard]] bool may_pierce() const { return may_pierce_; }
  /// Where one key is enough and one is known at distance 0, only lower ones may take its place.
  [[nodiscard]] bool is_superfluous(const FeaturePairKey& lowest) const {
    if (!is_decided() || !(set_.front() < lowest)) return false;
    return touching_edges_ == nullptr || found_.closest.pierced || lowest.meeting() != Meeting::pierced;
  }
  [[nodiscard]] bool wants_touching() const { return is_decided(); }
  static constexpr bool nearest_only = false;
  static constexpr bool inner_edges_only = false;
  static constexpr bool may_settle = true;
  void may_touch(const FeatureRef& segment, bool is_of_a) const {
    if (touching_edges_ != nullptr) touching_edges_->add(segment, is_of_a);
  }
  /// Collects the edges that touch between leaves that are tested from here on. Whether one pierces a face is
  /// found out, too.
  void collect(TouchingEdges& touching) { touching_edges_ = &touching; }
  [[nodiscard]] bool collects_touching() const { return touching_edges_ != nullptr; }
  [[nodiscard]] static double touching() { return 0; }
  [[nodiscard]] static bool is_listing() { return false; }
  static void found(const FeatureRef& /*a*/, const FeatureRef& /*b*/) {}
  /// Returns a lower bound of the distance of each vertex and face, and of each two edges of the two leaves.
  double offer_features(const LeafOf& leaf_a, const LeafOf& leaf_b, LeafScratch& scratch) {
    seen_ = std::numeric_limits<double>::infinity();
    double squared_seen = seen_;
    const auto offer = [&](const FeaturePairKey& key, const SquaredRange& squared) {
      pair_.check_time();
      squared_seen = std::min(squared_seen, squared.low);
      if (!squared.is_beyond(set_.upper())) set_.offer(key);
    };
    if (scratch.select_near(pair_, leaf_a, leaf_b, *this)) {
      // Where all keys at distance 0 are wanted, most are those of corners that coincide.
      scratch.coinciding.clear();
      if (set_.upper() == 0 && set_.wants_all() && set_.has_vertices() && pair_.groups == nullptr)
        scratch.coinciding.begin(pair_, leaf_a.region, leaf_b.region);
      LeafFeaturePairs keys(pair_, scratch, *this, offer);
      keys.add_selected();
      keys.finish();
    }
    return std::min({limit(), seen_, std::sqrt(squared_seen) * round_down});
  }
  void offer_vertices(const LeafOf& leaf_a, const LeafOf& leaf_b, LeafScratch& scratch) {
    for_each_vertex_pair(pair_, leaf_a, leaf_b, scratch, *this, [&](std::uint32_t a, std::uint32_t b) {
      if (pair_.may_vertices(a, b)) set_.offer(FeaturePairKey::of(vertex_piece(a), vertex_piece(b)));
    });
  }

 private:
  const SurfacePair& pair_;
  const PairQuery& query_;
  ClosestFound& found_;
  ClosestSet set_;
  double leaf_test_slack_;
  bool may_pierce_;
  TouchingEdges* touching_edges_ = nullptr;
  double seen_ = 0;  ///< the nearest bound that `keep` was asked about since a test of two leaves began
};

}  // namespace graze
