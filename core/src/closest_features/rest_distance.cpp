#include <algorithm>
#include <array>
#include <span>

#include "closest_features/feature_pair_key.hpp"
#include "core/pair/self_exclusion.hpp"

namespace graze {
namespace {

/// Asks how near features of one surface are, each two of them by a vertex and a face, or two edges.
class RestDistance {
 public:
  RestDistance(const Surface& rest, double distance) : pair_{rest, rest, count_}, distance_(distance) {}

  [[nodiscard]] bool is_below(const FeatureRef& a, const FeatureRef& b) {
    if (a.kind == FeatureRefKind::vertex && b.kind == FeatureRefKind::vertex)
      return is_closer_than(pair_, FeaturePairKey::of(vertex_piece(a.index), vertex_piece(b.index)),
                            distance_);
    if (a.kind > b.kind) return is_below(b, a);
    if (a.kind == FeatureRefKind::vertex) return is_vertex_below(a.index, b);
    return is_edge_or_face_below(a, b);
  }

 private:
  bool is_vertex_below(std::uint32_t vertex, const FeatureRef& other) {
    const Eigen::Vector3d point = pair_.a.position(vertex);
    SquaredRange squared;
    const FeaturePiece piece = other.kind == FeatureRefKind::edge
                                   ? nearest_piece_of_segment(point, pair_.b, edge_piece(other.index), count_)
                                   : nearest_piece_of_face(point, pair_.b, other.index, count_, squared);
    return is_closer_than(pair_, FeaturePairKey::of(vertex_piece(vertex), piece), squared, distance_);
  }
  bool are_edges_below(std::uint32_t a, std::uint32_t b) {
    SquaredRange squared;
    const ClosestPiecesOfSegments found =
        nearest_pieces_of_segments(pair_.a, edge_piece(a), pair_.b, edge_piece(b), count_, squared);
    return is_closer_than(pair_, FeaturePairKey::of(found.pieces[0][0], found.pieces[0][1]), squared,
                          distance_);
  }
  /// Two edges, or features of which one is a face: the distance is that of a vertex or edge of one from the
  /// other, unless an edge pierces a face.
  bool is_edge_or_face_below(const FeatureRef& a, const FeatureRef& b) {
    if (b.kind == FeatureRefKind::edge) return are_edges_below(a.index, b.index);
    return is_part_below(a, b) || is_part_below(b, a) || are_sides_below(a, b);
  }
  bool is_part_below(const FeatureRef& corners_of, const FeatureRef& other) {
    std::array<std::uint32_t, 2> room;
    const auto corners = feature_vertices(pair_.a.mesh(), corners_of, room);
    return std::any_of(corners.begin(), corners.end(),
                       [&](std::uint32_t vertex) { return is_vertex_below(vertex, other); });
  }
  bool are_sides_below(const FeatureRef& a, const FeatureRef& b) {
    for (const std::uint32_t of_a : sides_of(a))
      for (const std::uint32_t of_b : sides_of(b))
        if (of_a != IndexedMesh::no_edge && of_b != IndexedMesh::no_edge && are_edges_below(of_a, of_b))
          return true;
    return false;
  }
  static std::span<const std::uint32_t> edge_itself(const FeatureRef& edge) { return {&edge.index, 1}; }
  [[nodiscard]] std::span<const std::uint32_t> sides_of(const FeatureRef& feature) const {
    return feature.kind == FeatureRefKind::edge ? edge_itself(feature)
                                                : pair_.a.mesh().face_edges(feature.index);
  }

  DecisionCount count_;
  SurfacePair pair_;
  double distance_;
};

}  // namespace

bool SelfExclusion::are_near_at_rest(const FeatureRef& a, const FeatureRef& b, double distance) const {
  return RestDistance(rest_, distance).is_below(a, b);
}

}  // namespace graze
