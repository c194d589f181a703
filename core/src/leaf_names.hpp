#pragma once

#include "contact_name.hpp"
#include "leaf_scratch.hpp"
#include "piercing.hpp"

namespace graze {

/// Gives a sink the names of what two leaves' features have to do with each other, but for those that are
/// left in the scratch's batch.
template <typename Range, typename Sink>
class LeafNames {
 public:
  LeafNames(const SurfacePair& pair, LeafScratch& scratch, Range& range, const Sink& sink)
      : pair_(pair),
        a_(scratch.a),
        b_(scratch.b),
        folds_a_(scratch.folds_a),
        folds_b_(scratch.folds_b),
        filter_(scratch.frame, range, scratch.filter, pair.count),
        batch_(scratch.naming),
        sink_(sink) {
    folds_a_.begin(pair.a, a_.folds);
    folds_b_.begin(pair.b, b_.folds);
  }

  void vertices_and_faces() {
    const auto kernel = kernels::filter().near_triangles;
    filter_.near(of_a(a_.vertices), of_b(b_.triangles), kernel, [&](std::size_t i, std::size_t j) {
      batch_.add_vertex_and_face(pair_, a_.vertices.owner(i), b_.triangles.owner(j), sink_);
    });
    filter_.near(of_b(b_.vertices), of_a(a_.triangles), kernel, [&](std::size_t i, std::size_t j) {
      batch_.add_face_and_vertex(pair_, a_.triangles.owner(j), b_.vertices.owner(i), sink_);
    });
  }

  void edges() {
    near_segments(a_.edges, b_.edges, [&](std::size_t i, std::size_t j) {
      batch_.add_edges(pair_, a_.edges.owner(i), b_.edges.owner(j), sink_);
    });
  }

  /// A fold gives contacts only where the closest points are inside both segments: at its ends are the quad's
  /// corners.
  void folds() {
    near_segments(a_.edges, b_.folds, [&](std::size_t i, std::size_t j) {
      if (folds_b_.is_fold(j, pair_.count)) offer_inner(edge_of(a_, i), fold_of(b_, j));
    });
    near_segments(a_.folds, b_.edges, [&](std::size_t i, std::size_t j) {
      if (folds_a_.is_fold(i, pair_.count)) offer_inner(fold_of(a_, i), edge_of(b_, j));
    });
    near_segments(a_.folds, b_.folds, [&](std::size_t i, std::size_t j) {
      if (folds_a_.is_fold(i, pair_.count) && folds_b_.is_fold(j, pair_.count))
        offer_inner(fold_of(a_, i), fold_of(b_, j));
    });
  }

  void piercings() {
    filter_.touching(of_a(a_.edges), of_b(b_.triangles),
                     [&](std::size_t i, std::size_t j) { offer_a_through_b(edge_of(a_, i), j); });
    filter_.touching(of_b(b_.edges), of_a(a_.triangles),
                     [&](std::size_t i, std::size_t j) { offer_b_through_a(j, edge_of(b_, i)); });
    filter_.touching(of_a(a_.folds), of_b(b_.triangles), [&](std::size_t i, std::size_t j) {
      if (folds_a_.is_fold(i, pair_.count)) offer_a_through_b(fold_of(a_, i), j);
    });
    filter_.touching(of_b(b_.folds), of_a(a_.triangles), [&](std::size_t i, std::size_t j) {
      if (folds_b_.is_fold(i, pair_.count)) offer_b_through_a(j, fold_of(b_, i));
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
    const auto kernel = kernels::filter().near_segments;
    const auto cost = [](const SegmentBlock& rows, const SegmentBlock& columns) {
      return rows.count() * ((columns.count() + kernels::lanes - 1) / kernels::lanes);
    };
    if (cost(a, b) <= cost(b, a))
      filter_.near(of_a(a), of_b(b), kernel, visit);
    else
      filter_.near(of_b(b), of_a(a), kernel, [&](std::size_t j, std::size_t i) { visit(i, j); });
  }
  void offer_inner(const FeaturePiece& a, const FeaturePiece& b) {
    SquaredRange squared;
    const SegmentPairNames found = nearest_pieces_of_segments(pair_.a, a, pair_.b, b, pair_.count, squared);
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
  const LeafFeatures& a_;
  const LeafFeatures& b_;
  FoldAnswers& folds_a_;
  FoldAnswers& folds_b_;
  FloatFilter<Range> filter_;
  NamingBatch& batch_;
  const Sink& sink_;
};

/// Gives `sink` the name, and what is known of the distance, of the closest points of every vertex-face and
/// edge-edge pair between the features that were taken, of every edge that pierces a face, and of every
/// fold's contacts with edges, folds and faces, leaving out what is certainly too far for `range` (see
/// FloatFilter; a piercing never is). A name may be met several times. Some of the names are those of
/// features that were taken before, and some of these features' are left in `scratch.naming`, which is to be
/// finished.
template <typename Range, typename Sink>
void for_each_name_of_taken(const SurfacePair& pair, LeafScratch& scratch, Range& range, const Sink& sink) {
  LeafNames<Range, Sink> names(pair, scratch, range, sink);
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
  if (!scratch.take_vertices(pair, leaf_a, leaf_b, range)) return;
  const PointBlock& a = scratch.a.vertices;
  const PointBlock& b = scratch.b.vertices;
  FloatFilter<Range>(scratch.frame, range, scratch.filter, pair.count)
      .near(FeaturesOf<PointBlock>{pair.a, a}, FeaturesOf<PointBlock>{pair.b, b},
            kernels::filter().near_points,
            [&](std::size_t i, std::size_t j) { visit(a.owner(i), b.owner(j)); });
}

}  // namespace graze
