#pragma once

#include <array>
#include <cstdint>

#include "closest_features/feature_pair_key.hpp"
#include "kernels/voronoi.hpp"
#include "surface/corner_lane.hpp"

namespace graze {

// Pieces by number, in the order of `Along` and `VoronoiRegion`. They are looked up, since no branch could
// foretell which it is.
inline FeaturePiece piece_of_edge(const IndexedMesh& mesh, std::uint32_t edge, std::size_t index) {
  const auto [first, second] = mesh.edge(edge);
  const std::array<FeaturePiece, 3> pieces{vertex_piece(first), vertex_piece(second), edge_piece(edge)};
  return pieces[index];
}
inline FeaturePiece piece_of_triangle(const IndexedMesh& mesh, std::uint32_t face, std::size_t index) {
  const auto corner = mesh.face(face);
  const auto edge = mesh.face_edges(face);
  const std::array<FeaturePiece, 7> pieces{
      vertex_piece(corner[0]), vertex_piece(corner[1]), vertex_piece(corner[2]),       edge_piece(edge[0]),
      edge_piece(edge[1]),     edge_piece(edge[2]),     face_piece(face, Piece::first)};
  return pieces[index];
}

/// Pairs of features whose closest points are found several at once. Those that plain double is not certain
/// of are decided one by one. An index is that of a feature in its surface's mesh.
class ClosestFeaturesBatch {
 public:
  /// Before the first pair of features of a pair of surfaces.
  void begin() { segments_ = points_and_triangles_ = 0; }

  // Each function may give `sink(key, squared range)` the keys of pairs that were added before. If `inside`
  // is true, two edges have a key only if their closest points are inside both.
  template <bool inside, typename Sink>
  void add_edges(const SurfacePair& pair, std::uint32_t edge_a, std::uint32_t edge_b, const Sink& sink) {
    put(pair.a, pair.a.mesh().edge(edge_a), segment_batch_.a, segments_);
    put(pair.b, pair.b.mesh().edge(edge_b), segment_batch_.b, segments_);
    segment_[segments_++] = {edge_a, edge_b};
    if (segments_ == kernels::contact_lanes) resolve_segments<inside>(pair, sink);
  }
  template <typename Sink>
  void add_vertex_and_face(const SurfacePair& pair, std::uint32_t vertex_a, std::uint32_t face_b,
                           const Sink& sink) {
    add({vertex_a, face_b, true}, pair, sink);
  }
  template <typename Sink>
  void add_face_and_vertex(const SurfacePair& pair, std::uint32_t face_a, std::uint32_t vertex_b,
                           const Sink& sink) {
    add({vertex_b, face_a, false}, pair, sink);
  }
  /// Finds the closest features of the pairs that are left.
  template <bool inside, typename Sink>
  void finish(const SurfacePair& pair, const Sink& sink) {
    resolve_segments<inside>(pair, sink);
    resolve_points_and_triangles(pair, sink);
  }

 private:
  struct EdgePair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
  };
  struct VertexAndFace {
    std::uint32_t vertex = 0;
    std::uint32_t face = 0;
    bool vertex_is_of_a = false;

    [[nodiscard]] const Surface& of_vertex(const SurfacePair& pair) const {
      return vertex_is_of_a ? pair.a : pair.b;
    }
    [[nodiscard]] const Surface& of_face(const SurfacePair& pair) const {
      return vertex_is_of_a ? pair.b : pair.a;
    }
    [[nodiscard]] FeaturePairKey key(const FeaturePiece& of_face) const {
      return vertex_is_of_a ? FeaturePairKey::of(vertex_piece(vertex), of_face)
                            : FeaturePairKey::of(of_face, vertex_piece(vertex));
    }
  };

  template <typename Sink>
  void add(const VertexAndFace& added, const SurfacePair& pair, const Sink& sink) {
    const Surface& of_face = added.of_face(pair);
    const auto corner = of_face.mesh().face(added.face);
    if (corner.size() != 3) return resolve_alone(added, pair, sink);
    const std::size_t lane = points_and_triangles_++;
    vertex_and_face_[lane] = added;
    put(added.of_vertex(pair), std::array{added.vertex}, &triangle_batch_.point, lane);
    put(of_face, std::array{corner[0], corner[1], corner[2]}, triangle_batch_.corner, lane);
    if (points_and_triangles_ == kernels::contact_lanes) resolve_points_and_triangles(pair, sink);
  }
  template <typename Sink>
  void resolve_alone(const VertexAndFace& pieces, const SurfacePair& pair, const Sink& sink) {
    SquaredRange squared;
    const FeaturePiece piece = nearest_piece_of_face(pieces.of_vertex(pair).position(pieces.vertex),
                                                     pieces.of_face(pair), pieces.face, pair.count, squared);
    sink(pieces.key(piece), squared);
  }
  template <bool inside, typename Sink>
  void resolve_alone(const EdgePair& edges, const SurfacePair& pair, const Sink& sink) {
    SquaredRange squared;
    const FeaturePiece a = edge_piece(edges.a);
    const FeaturePiece b = edge_piece(edges.b);
    if constexpr (inside) {
      if (are_nearest_inside(pair.a, a, pair.b, b, pair.count, squared))
        sink(FeaturePairKey::of(a, b), squared);
      return;
    }
    const ClosestPiecesOfSegments found =
        nearest_pieces_of_segments(pair.a, a, pair.b, b, pair.count, squared);
    for (std::uint32_t k = 0; k < found.size; ++k)
      sink(FeaturePairKey::of(found.pieces[k][0], found.pieces[k][1]), squared);
  }
  template <bool inside, typename Sink>
  void resolve_segments(const SurfacePair& pair, const Sink& sink);
  template <typename Sink>
  void resolve_points_and_triangles(const SurfacePair& pair, const Sink& sink);
  template <typename Sink, typename CertainKey, typename ResolveAlone>
  static void resolve_lanes(const kernels::VoronoiFound& found, std::size_t& count, const SurfacePair& pair,
                            const Sink& sink, const CertainKey& certain, const ResolveAlone& resolve_alone);

  template <std::size_t Corners>
  static void put(const Surface& surface, const std::array<std::uint32_t, Corners>& vertices,
                  kernels::Points* points, std::size_t lane) {
    for (std::size_t corner = 0; corner < Corners; ++corner)
      put_corner(surface, vertices[corner], points[corner], lane);
  }
  kernels::SegmentPairBatch segment_batch_{};
  kernels::PointTriangleBatch triangle_batch_{};
  std::array<EdgePair, kernels::contact_lanes> segment_;
  std::array<VertexAndFace, kernels::contact_lanes> vertex_and_face_;
  std::size_t segments_ = 0;
  std::size_t points_and_triangles_ = 0;
};

template <bool inside, typename Sink>
void ClosestFeaturesBatch::resolve_segments(const SurfacePair& pair, const Sink& sink) {
  if (segments_ == 0) return;
  kernels::voronoi().segments(segment_batch_);
  const auto certain = [&](std::size_t lane) {
    const auto [a, b] = segment_[lane];
    return FeaturePairKey::of(
        piece_of_edge(pair.a.mesh(), a, static_cast<std::size_t>(segment_batch_.along_a[lane])),
        piece_of_edge(pair.b.mesh(), b, static_cast<std::size_t>(segment_batch_.along_b[lane])));
  };
  resolve_lanes(segment_batch_.found, segments_, pair, sink, certain,
                [&](std::size_t lane) { resolve_alone<inside>(segment_[lane], pair, sink); });
}

template <typename Sink>
void ClosestFeaturesBatch::resolve_points_and_triangles(const SurfacePair& pair, const Sink& sink) {
  if (points_and_triangles_ == 0) return;
  kernels::voronoi().points_and_triangles(triangle_batch_);
  const auto certain = [&](std::size_t lane) {
    const VertexAndFace& pieces = vertex_and_face_[lane];
    return pieces.key(piece_of_triangle(pieces.of_face(pair).mesh(), pieces.face,
                                        static_cast<std::size_t>(triangle_batch_.voronoi[lane])));
  };
  resolve_lanes(triangle_batch_.found, points_and_triangles_, pair, sink, certain,
                [&](std::size_t lane) { resolve_alone(vertex_and_face_[lane], pair, sink); });
}

/// Empties a batch. Gives the sink the keys that a kernel is certain of, and has the others decided alone.
template <typename Sink, typename CertainKey, typename ResolveAlone>
void ClosestFeaturesBatch::resolve_lanes(const kernels::VoronoiFound& found, std::size_t& count,
                                         const SurfacePair& pair, const Sink& sink, const CertainKey& certain,
                                         const ResolveAlone& resolve_alone) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    if (!(found.certain[lane] > 0)) {
      resolve_alone(lane);
      continue;
    }
    ++pair.count.in_double;
    sink(certain(lane), SquaredRange{found.low[lane], found.high[lane]});
  }
  count = 0;
}

}  // namespace graze
