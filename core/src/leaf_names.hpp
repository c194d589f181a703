#pragma once

#include <algorithm>

#include "contact_name.hpp"
#include "leaf_features.hpp"
#include "piercing.hpp"

namespace graze {

struct LeafScratch {
  LeafFeatures a;
  LeafFeatures b;
  FloatFilterScratch filter;

  template <typename Self>
  static auto parts(Self& self) {
    return std::tie(self.a, self.b, self.filter);
  }
};

/// Gives a sink the names of what two leaves' features have to do with each other.
template <typename Range, typename Sink>
class LeafNames {
 public:
  LeafNames(const SurfacePair& pair, const FilterFrame& frame, LeafScratch& scratch, Range& range,
            const Sink& sink)
      : pair_(pair),
        a_(scratch.a),
        b_(scratch.b),
        filter_(frame, range, scratch.filter, pair.count),
        sink_(sink) {}

  void vertices_and_faces() {
    const auto kernel = kernels::filter().near_triangles;
    filter_.near(of_a(a_.vertices), of_b(b_.triangles), kernel, [&](std::size_t i, std::size_t j) {
      const std::uint32_t vertex = a_.vertices.owner(i);
      SquaredRange squared;
      const FeaturePiece piece = nearest_piece_of_face(pair_.a.position(vertex), pair_.b,
                                                       b_.triangles.owner(j), pair_.count, squared);
      sink_(ContactName::of(vertex_piece(vertex), piece), squared);
    });
    filter_.near(of_b(b_.vertices), of_a(a_.triangles), kernel, [&](std::size_t i, std::size_t j) {
      const std::uint32_t vertex = b_.vertices.owner(i);
      SquaredRange squared;
      const FeaturePiece piece = nearest_piece_of_face(pair_.b.position(vertex), pair_.a,
                                                       a_.triangles.owner(j), pair_.count, squared);
      sink_(ContactName::of(piece, vertex_piece(vertex)), squared);
    });
  }

  void edges() {
    near_segments(a_.edges, b_.edges, [&](std::size_t i, std::size_t j) {
      SquaredRange squared;
      const SegmentPairNames found = segment_names(edge_of(a_, i), edge_of(b_, j), squared);
      for (std::uint32_t k = 0; k < found.size; ++k)
        sink_(ContactName::of(found.names[k][0], found.names[k][1]), squared);
    });
  }

  /// A fold gives contacts only where the closest points are inside both segments: at its ends are the quad's
  /// corners.
  void folds() {
    near_segments(a_.edges, b_.folds, [&](std::size_t i, std::size_t j) {
      if (b_.is_fold(j, pair_.count)) offer_inner(edge_of(a_, i), fold_of(b_, j));
    });
    near_segments(a_.folds, b_.edges, [&](std::size_t i, std::size_t j) {
      if (a_.is_fold(i, pair_.count)) offer_inner(fold_of(a_, i), edge_of(b_, j));
    });
    near_segments(a_.folds, b_.folds, [&](std::size_t i, std::size_t j) {
      if (a_.is_fold(i, pair_.count) && b_.is_fold(j, pair_.count))
        offer_inner(fold_of(a_, i), fold_of(b_, j));
    });
  }

  void piercings() {
    filter_.touching(of_a(a_.edges), of_b(b_.triangles),
                     [&](std::size_t i, std::size_t j) { offer_a_through_b(edge_of(a_, i), j); });
    filter_.touching(of_b(b_.edges), of_a(a_.triangles),
                     [&](std::size_t i, std::size_t j) { offer_b_through_a(j, edge_of(b_, i)); });
    filter_.touching(of_a(a_.folds), of_b(b_.triangles), [&](std::size_t i, std::size_t j) {
      if (a_.is_fold(i, pair_.count)) offer_a_through_b(fold_of(a_, i), j);
    });
    filter_.touching(of_b(b_.folds), of_a(a_.triangles), [&](std::size_t i, std::size_t j) {
      if (b_.is_fold(i, pair_.count)) offer_b_through_a(j, fold_of(b_, i));
    });
  }

 private:
  template <typename Block>
  [[nodiscard]] FeaturesOf<Block> of_a(const Block& features) const {
    return {pair_.a, features};
  }
  template <typename Block>
  [[nodiscard]] FeaturesOf<Block> of_b(const Block& features) const {
    return {pair_.b, features};
  }
  static FeaturePiece edge_of(const LeafFeatures& features, std::size_t i) {
    return edge_piece(features.edges.owner(i));
  }
  static FeaturePiece fold_of(const LeafFeatures& features, std::size_t i) {
    return face_piece(features.folds.owner(i), Piece::fold);
  }

  template <typename Visit>
  void near_segments(const SegmentBlock& a, const SegmentBlock& b, const Visit& visit) {
    filter_.near(of_a(a), of_b(b), kernels::filter().near_segments, visit);
  }
  [[nodiscard]] SegmentPairNames segment_names(const FeaturePiece& a, const FeaturePiece& b,
                                               SquaredRange& squared) const {
    return nearest_pieces_of_segments(pair_.a, a, pair_.b, b, pair_.count, squared);
  }
  void offer_inner(const FeaturePiece& a, const FeaturePiece& b) {
    SquaredRange squared;
    const SegmentPairNames found = segment_names(a, b, squared);
    if (found.size == 1 && found.names[0][0] == a && found.names[0][1] == b)
      sink_(ContactName::of(a, b), squared);
  }
  void offer_a_through_b(const FeaturePiece& segment, std::size_t triangle) {
    const std::uint32_t face = b_.triangles.owner(triangle);
    if (const auto piece = pierced_piece(pair_.a, segment, pair_.b, face, pair_.count))
      sink_(ContactName::of(segment, *piece, Meeting::pierced), SquaredRange{});
  }
  void offer_b_through_a(std::size_t triangle, const FeaturePiece& segment) {
    const std::uint32_t face = a_.triangles.owner(triangle);
    if (const auto piece = pierced_piece(pair_.b, segment, pair_.a, face, pair_.count))
      sink_(ContactName::of(*piece, segment, Meeting::pierced), SquaredRange{});
  }

  const SurfacePair& pair_;
  LeafFeatures& a_;
  LeafFeatures& b_;
  FloatFilter<Range> filter_;
  const Sink& sink_;
};

/// Gives `sink` the name, and what is known of the distance, of the closest points of every vertex-face and
/// edge-edge pair between two leaves, of every edge that pierces a face, and of every fold's contacts with
/// edges, folds and faces, leaving out what is certainly too far for `range` (see FloatFilter; a piercing
/// never is). A pair of features is met in one pair of leaves only, since each has one owner; a name may be
/// met several times.
template <typename Range, typename Sink>
void for_each_name(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, LeafScratch& scratch,
                   Range& range, const Sink& sink) {
  const FilterFrame frame(leaf_a.box, leaf_b.box);
  const double limit = range.limit();
  const bool all_of_a = scratch.a.collect(pair.a, leaf_a.region, leaf_b.box, frame, limit);
  const bool all_of_b = scratch.b.collect(pair.b, leaf_b.region, leaf_a.box, frame, limit);
  if (!all_of_a || !all_of_b) range.left_out(limit);
  LeafNames<Range, Sink> names(pair, frame, scratch, range, sink);
  names.vertices_and_faces();
  names.edges();
  names.folds();
  names.piercings();
}

/// Calls `visit(vertex of a, vertex of b)` for all pairs of the leaves' vertices but what is certainly too
/// far for `range`.
template <typename Range, typename Visit>
void for_each_vertex_pair(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b,
                          LeafScratch& scratch, Range& range, const Visit& visit) {
  const FilterFrame frame(leaf_a.box, leaf_b.box);
  const double limit = range.limit();
  const bool all_of_a = scratch.a.collect_vertices(pair.a, leaf_a.region, leaf_b.box, frame, limit);
  const bool all_of_b = scratch.b.collect_vertices(pair.b, leaf_b.region, leaf_a.box, frame, limit);
  if (!all_of_a || !all_of_b) range.left_out(limit);
  const PointBlock& a = scratch.a.vertices;
  const PointBlock& b = scratch.b.vertices;
  FloatFilter<Range>(frame, range, scratch.filter, pair.count)
      .near(FeaturesOf<PointBlock>{pair.a, a}, FeaturesOf<PointBlock>{pair.b, b},
            kernels::filter().near_points,
            [&](std::size_t i, std::size_t j) { visit(a.owner(i), b.owner(j)); });
}

}  // namespace graze
