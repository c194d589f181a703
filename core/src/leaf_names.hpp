#pragma once

#include <algorithm>
#include <optional>

#include "contact_name.hpp"
#include "leaf_scratch.hpp"
#include "piercing.hpp"

namespace graze {

/// Gives a sink the names of what two leaves' features have to do with each other.
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
        sink_(sink) {
    folds_a_.begin(pair.a, a_.folds);
    folds_b_.begin(pair.b, b_.folds);
  }

  void vertices_and_faces() {
    const auto kernel = kernels::filter().near_triangles;
    filter_.near(of_a(a_.vertices), of_b(b_.triangles), kernel, [&](std::size_t i, std::size_t j) {
      const std::uint32_t vertex = a_.vertices.owner(i);
      SquaredRange squared;
      const FeaturePiece piece =
          piece_of_face(pair_.a.position(vertex), pair_.b, b_.triangles.owner(j), squared);
      sink_(ContactName::of(vertex_piece(vertex), piece), squared);
    });
    filter_.near(of_b(b_.vertices), of_a(a_.triangles), kernel, [&](std::size_t i, std::size_t j) {
      const std::uint32_t vertex = b_.vertices.owner(i);
      SquaredRange squared;
      const FeaturePiece piece =
          piece_of_face(pair_.b.position(vertex), pair_.a, a_.triangles.owner(j), squared);
      sink_(ContactName::of(piece, vertex_piece(vertex)), squared);
    });
  }

  void edges() {
    near_segments(a_.edges, b_.edges, [&](std::size_t i, std::size_t j) {
      SquaredRange squared;
      if (const auto name = certain_name(a_.edges.owner(i), b_.edges.owner(j), squared))
        return sink_(*name, squared);
      const SegmentPairNames found = segment_names(edge_of(a_, i), edge_of(b_, j), squared);
      for (std::uint32_t k = 0; k < found.size; ++k)
        sink_(ContactName::of(found.names[k][0], found.names[k][1]), squared);
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

  /// `nearest_piece_of_face`, without detours where plain double is certain of a triangle.
  [[nodiscard]] FeaturePiece piece_of_face(const Eigen::Vector3d& point, const Surface& surface,
                                           std::uint32_t face, SquaredRange& squared) const {
    const auto corner = surface.mesh().face(face);
    Place place{};
    if (corner.size() != 3 ||
        !certain_place(
            point, {surface.position(corner[0]), surface.position(corner[1]), surface.position(corner[2])},
            place, squared))
      return nearest_piece_of_face(point, surface, face, pair_.count, squared);
    ++pair_.count.in_double;
    if (place == Place::inside) return face_piece(face, Piece::first);
    if (place < Place::edge01) return vertex_piece(corner[static_cast<std::size_t>(place)]);
    return edge_piece(surface.mesh().face_edges(face)[static_cast<std::size_t>(place) - 3]);
  }
  /// The name of the closest points of two edges where plain double is certain of it.
  [[nodiscard]] std::optional<ContactName> certain_name(std::uint32_t edge_a, std::uint32_t edge_b,
                                                        SquaredRange& squared) const {
    const auto a = pair_.a.mesh().edge(edge_a);
    const auto b = pair_.b.mesh().edge(edge_b);
    std::array<Along, 2> places{};
    if (!certain_places({pair_.a.position(a[0]), pair_.a.position(a[1])},
                        {pair_.b.position(b[0]), pair_.b.position(b[1])}, places, squared))
      return std::nullopt;
    ++pair_.count.in_double;
    const auto piece = [](std::uint32_t edge, const std::array<std::uint32_t, 2>& end, Along place) {
      return place == Along::inside ? edge_piece(edge) : vertex_piece(end[place == Along::first ? 0 : 1]);
    };
    return ContactName::of(piece(edge_a, a, places[0]), piece(edge_b, b, places[1]));
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
  const LeafFeatures& a_;
  const LeafFeatures& b_;
  FoldAnswers& folds_a_;
  FoldAnswers& folds_b_;
  FloatFilter<Range> filter_;
  const Sink& sink_;
};

/// Gives `sink` the name, and what is known of the distance, of the closest points of every vertex-face and
/// edge-edge pair between the features that were taken, of every edge that pierces a face, and of every
/// fold's contacts with edges, folds and faces, leaving out what is certainly too far for `range` (see
/// FloatFilter; a piercing never is). A name may be met several times.
template <typename Range, typename Sink>
void for_each_name_of_taken(const SurfacePair& pair, LeafScratch& scratch, Range& range, const Sink& sink) {
  LeafNames<Range, Sink> names(pair, scratch, range, sink);
  names.vertices_and_faces();
  names.edges();
  names.folds();
  names.piercings();
}

/// The same of two leaves. A pair of features is met in one pair of leaves only, since each has one owner.
template <typename Range, typename Sink>
void for_each_name(const SurfacePair& pair, const LeafOf& leaf_a, const LeafOf& leaf_b, LeafScratch& scratch,
                   Range& range, const Sink& sink) {
  if (scratch.take(pair, leaf_a, leaf_b, range)) for_each_name_of_taken(pair, scratch, range, sink);
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
