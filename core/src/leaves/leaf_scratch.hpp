#pragma once

#include <array>
#include <cstdint>

#include "closest_features/feature_pair_key.hpp"
#include "leaves/closest_features_batch.hpp"
#include "leaves/coinciding_corners.hpp"
#include "leaves/layout/float_filter.hpp"
#include "leaves/layout/leaf_cache.hpp"
#include "leaves/layout/leaf_features.hpp"
#include "leaves/layout/listed_vertices.hpp"
#include "surface/leaf_slab.hpp"
#include "surface/per_leaf_cache.hpp"

namespace graze {

/// Indices of recent keys in a list. Most keys that were added a moment ago need not be added again, since a
/// contact is found from each of the features about it. That leaves a fraction to sort. Any index is safe to
/// test, whatever was there before.
class RecentKeys {
 public:
  [[nodiscard]] std::uint32_t& slot(const FeaturePairKey& key) { return slots_[key.hash() >> 52U]; }

 private:
  std::array<std::uint32_t, 4096> slots_{};
};

/// Working memory for the leaves of a pair of surfaces, and for those features of two leaves that are near.
struct LeafScratch {
  LeafCache all_a;
  LeafCache all_b;
  PerLeafCache<LeafSlab> slabs_a;
  PerLeafCache<LeafSlab> slabs_b;
  LeafVertices corners;
  VerticesInFrame listed_a;
  VerticesInFrame listed_b;
  SelectedLeaf a;
  SelectedLeaf b;
  FoldAnswers folds;
  FloatBatches filter;
  ClosestFeaturesBatch naming;
  RecentKeys recent_keys;
  CoincidingCorners coinciding;
  FilterFrame frame;
  /// Whether leaves get slabs that are further apart than they are large. They pay where boxes leave many
  /// leaves about as near as the nearest, as between a shell and what is in its middle.
  bool makes_slabs_of_far = false;
  /// Whether both leaves whose features are selected are one, of a surface with itself.
  bool is_one_leaf = false;

  /// Call it before the first pair of leaves of a query or slice. It forgets the query before. The frame is
  /// that of this pair, or of the first that is met.
  void begin() {
    frame = {};
    makes_slabs_of_far = false;
    is_one_leaf = false;
    folds.begin();
    filter.begin();
    naming.begin();
  }
  void begin(const FilterFrame& first) { frame = first; }

  /// Selects the features of two leaves that are near each other. Returns false where either has none.
  template <typename Range>
  bool select_near(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, Range& range) {
    return select_near(pair, leaf_a, leaf_b, range, range.touching(), false, &SelectedLeaf::select_near);
  }
  template <typename Range>
  bool select_near_vertices(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b,
                            Range& range) {
    return select_near(pair, leaf_a, leaf_b, range, 0, true, &SelectedLeaf::select_near_vertices);
  }

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.all_a, self.all_b, self.slabs_a, self.slabs_b, self.corners, self.listed_a,
                    self.listed_b, self.a, self.b, self.filter, self.coinciding);
  }

  /// The slab of a leaf of `surface` where it is now. `slabs` is the cache for that surface.
  static const LeafSlab& slab_now(PerLeafCache<LeafSlab>& slabs, const Surface& surface, const Region& leaf) {
    slabs.begin(surface);
    const std::size_t number = surface.mesh().regions().number(leaf);
    return slabs.of(number, [&] { return slab_of(surface, leaf); });
  }

 private:
  /// Chooses another frame if the present one does not serve: along the faces of a long leaf.
  void choose_frame(const LeafOf& leaf_a, const LeafOf& leaf_b) {
    const OrientedBox* const along = leaf_a.oriented != nullptr ? leaf_a.oriented : leaf_b.oriented;
    if (frame.lies_along(along) && frame.serves(leaf_a.box, leaf_b.box)) return;
    frame = along != nullptr ? FilterFrame(leaf_a.box, leaf_b.box, along->axes)
                             : FilterFrame(leaf_a.box, leaf_b.box);
  }
  /// The box of all features of a leaf of a in the frame, which is turned. Selects all of them.
  template <typename Take>
  kernels::BoxInFrame box_of_all(const Surface& surface, const Region& leaf, const Take& select) {
    constexpr float far = 0x1p100F;
    constexpr kernels::BoxInFrame everything{{-far, -far, -far}, {far, far, far}};
    all_a.begin(surface, frame, false);
    kernels::BoxInFrame box = empty_box();
    (a.*select)(all_a.of(surface, leaf, corners), {everything, everything, {{0, 0, 0}, 0, 0}, 0}, &box);
    return box;
  }

  template <typename Range, typename Take>
  bool select_near(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, Range& range,
                   double touching_within, bool vertices_only, const Take& select) {
    is_one_leaf = pair.is_of_self() && &leaf_a.region == &leaf_b.region;
    const double limit = range.limit();
    const auto nothing_near = [&] {
      range.left_out(limit);
      return false;
    };
    const Eigen::Vector3d middle_a = pair.a.middle(leaf_a.region);
    const Eigen::Vector3d middle_b = pair.b.middle(leaf_b.region);
    LeafSlab slab_a;
    LeafSlab slab_b;
    // Vertices alone are laid out as soon as their slab is made.
    if (!vertices_only && (makes_slabs_of_far || are_worth_slabs(leaf_a.box, leaf_b.box, limit))) {
      slab_a = slab_now(slabs_a, pair.a, leaf_a.region);
      slab_b = slab_now(slabs_b, pair.b, leaf_b.region);
      if (are_apart(slab_a, slab_b, middle_b - middle_a, limit)) return nothing_near();
    }
    choose_frame(leaf_a, leaf_b);
    // Selects from b what is near where a can be near b's leaf, and from a what is near that. Two features
    // can only touch where both sides' boxes are.
    const kernels::BoxInFrame near_a = frame.is_turned()
                                           ? box_of_all(pair.a, leaf_a.region, select)
                                           : frame.to_local_beside(leaf_a.box, leaf_b.box, limit);
    if (is_empty(near_a)) return nothing_near();
    all_a.begin(pair.a, frame, vertices_only);
    all_b.begin(pair.b, frame, vertices_only);
    const LeafFeatures& of_b = all_b.of(pair.b, leaf_b.region, corners);
    const float local_limit = frame.to_local_limit(limit);
    const float touching = frame.to_local_limit(touching_within);
    kernels::BoxInFrame near_b = empty_box();
    (b.*select)(of_b, {near_a, grown(near_a, touching), frame.to_local(slab_a, middle_a), local_limit},
                &near_b);
    if (is_empty(near_b)) return nothing_near();
    const LeafFeatures& of_a = all_a.of(pair.a, leaf_a.region, corners);
    (a.*select)(of_a, {near_b, grown(near_b, touching), frame.to_local(slab_b, middle_b), local_limit},
                nullptr);
    const auto of_all = [&](const auto& features) {
      return vertices_only ? features.vertices.count() : features.count();
    };
    if (of_all(a) < of_all(of_a) || of_all(b) < of_all(of_b)) range.left_out(limit);
    return of_all(a) > 0 && of_all(b) > 0;
  }
};

}  // namespace graze
