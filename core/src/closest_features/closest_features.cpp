#include "closest_features/closest_features.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "arithmetic/certain.hpp"
#include "closest_features/ratio.hpp"

namespace graze {
namespace {

/// The region of Voronoi of a triangle that holds the point. Its borders belong to the lower dimension.
VoronoiRegion voronoi_region_of(const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& corner,
                                DecisionCount& count) {
  const auto normal_of = [&]<typename Number>() { return normal_of_corners<Number>(corner); };
  if (is_zero(count, normal_of)) return VoronoiRegion::no_area;
  // From one corner towards another: how far the point has come, and whether it is outside of the line or on
  // it.
  const auto way = [&](std::size_t from, std::size_t to) {
    return decide_sign(count, [&]<typename Number>() {
      return dot(difference<Number>(corner[to], corner[from]), difference<Number>(point, corner[from]));
    });
  };
  const auto is_outside = [&](std::size_t from, std::size_t to) {
    return decide_sign(count, [&]<typename Number>() {
             return dot(normal_of.template operator()<Number>(),
                        cross(difference<Number>(corner[to], corner[from]),
                              difference<Number>(point, corner[from])));
           }) <= 0;
  };
  for (std::size_t at = 0; at < 3; ++at)
    if (way(at, (at + 1) % 3) <= 0 && way(at, (at + 2) % 3) <= 0) return static_cast<VoronoiRegion>(at);
  constexpr std::array along{VoronoiRegion::edge01, VoronoiRegion::edge12, VoronoiRegion::edge20};
  for (const std::size_t from : {0U, 2U, 1U}) {
    const std::size_t to = (from + 1) % 3;
    if (is_outside(from, to) && way(from, to) >= 0 && way(to, from) >= 0) return along[from];
  }
  return VoronoiRegion::inside;
}

/// The squared distance of a point to a piece in whose interior its closest point lies.
template <typename Number>
Ratio<Number> distance_squared(const Eigen::Vector3d& point, const Surface& surface,
                               const FeaturePiece& piece) {
  Simplex single;
  single.size = 1;
  single.point[0] = point;
  return hull_distance_squared<Number>(single, simplex_of(surface, piece));
}

/// Chooses between two pieces that hold the closest points of two parts of a face. Returns the piece of the
/// closer part. Where they are equally close, it is the lower feature, then `first`.
FeaturePiece nearer(const Eigen::Vector3d& point, const Surface& surface, const FeaturePiece& first,
                    const FeaturePiece& second, DecisionCount& count) {
  if (first == second) return first;
  const int order = decide(count, [&]<typename Number>(bool& unsure) {
    return compare(distance_squared<Number>(point, surface, first),
                   distance_squared<Number>(point, surface, second), unsure);
  });
  if (order != 0) return order < 0 ? first : second;
  return second.feature < first.feature ? second : first;
}

/// One triangle of a face: its corners, and the pieces that its three sides are (0-1, 1-2, 2-0).
struct FaceTriangle {
  Simplex corners;
  std::array<FeaturePiece, 3> sides;
  std::array<bool, 3> has_side{};  ///< false for a corner repeated
};

FaceTriangle triangle_of(const Surface& surface, std::uint32_t face, Piece which, const Simplex& corners) {
  const IndexedMesh& mesh = surface.mesh();
  FaceTriangle triangle;
  triangle.corners = corners;
  const auto edges = mesh.face_edges(face);
  const auto set_side = [&](std::size_t side, const FeaturePiece& piece) {
    triangle.sides[side] = piece;
    triangle.has_side[side] = triangle.corners.vertex[side] != triangle.corners.vertex[(side + 1) % 3];
  };
  if (edges.size() == 3) {
    for (std::size_t side = 0; side < 3; ++side) set_side(side, edge_piece(edges[side]));
  } else if (which == Piece::first) {
    set_side(0, edge_piece(edges[0]));
    set_side(1, edge_piece(edges[1]));
    set_side(2, diagonal_of(mesh, face));
  } else {
    set_side(0, diagonal_of(mesh, face));
    set_side(1, edge_piece(edges[2]));
    set_side(2, edge_piece(edges[3]));
  }
  return triangle;
}

/// A triangle without area is the union of its sides.
FeaturePiece nearest_piece_of_sides(const Eigen::Vector3d& point, const Surface& surface,
                                    const FaceTriangle& triangle, DecisionCount& count) {
  FeaturePiece best =
      vertex_piece(triangle.corners.vertex[0]);  // stands where all three corners are one vertex
  bool any = false;
  for (std::size_t side = 0; side < 3; ++side) {
    if (!triangle.has_side[side]) continue;
    const FeaturePiece piece = nearest_piece_of_segment(point, surface, triangle.sides[side], count);
    best = any ? nearer(point, surface, best, piece, count) : piece;
    any = true;
  }
  return best;
}

FeaturePiece nearest_piece_of_triangle(const Eigen::Vector3d& point, const Surface& surface,
                                       std::uint32_t face, Piece which, DecisionCount& count,
                                       SquaredRange& squared) {
  const Simplex corners = simplex_of(surface, face_piece(face, which));
  for (std::size_t i = 0; i < 3; ++i)
    if (point == corners.point[i] &&
        certainly_not_parallel(corners.point[1] - corners.point[0], corners.point[2] - corners.point[0])) {
      ++count.in_double;
      return vertex_piece(corners.vertex[i]);
    }
  const FaceTriangle triangle = triangle_of(surface, face, which, corners);
  VoronoiRegion region{};
  if (certain_voronoi(point, triangle.corners.point, region, squared))
    ++count.in_double;
  else
    region = voronoi_region_of(point, triangle.corners.point, count);
  switch (region) {
    case VoronoiRegion::vertex0:
    case VoronoiRegion::vertex1:
    case VoronoiRegion::vertex2:
      return vertex_piece(triangle.corners.vertex[static_cast<std::size_t>(region)]);
    case VoronoiRegion::edge01:
    case VoronoiRegion::edge12:
    case VoronoiRegion::edge20:
      return triangle.sides[static_cast<std::size_t>(region) - 3];
    case VoronoiRegion::inside:
      return face_piece(face, which);
    case VoronoiRegion::no_area:
      break;
  }
  return nearest_piece_of_sides(point, surface, triangle, count);
}

bool is_on_diagonal(const IndexedMesh& mesh, std::uint32_t face, const FeaturePiece& piece) {
  const auto corner = mesh.face(face);
  if (piece.feature.kind == FeatureKind::vertex)
    return piece.feature.index == corner[0] || piece.feature.index == corner[2];
  return piece == diagonal_of(mesh, face);
}

bool coincide(const Surface& surface, std::uint32_t vertex, std::uint32_t other) {
  return surface.position(vertex) == surface.position(other);
}

/// An end of a segment under the key that a point of zero length goes by: its lower vertex.
std::uint32_t end_vertex(const Surface& surface, const Simplex& segment, std::size_t end) {
  if (!coincide(surface, segment.vertex[0], segment.vertex[1])) return segment.vertex[end];
  return std::min(segment.vertex[0], segment.vertex[1]);
}

/// The piece of a segment that a position on it belongs to.
FeaturePiece piece_along(const FeaturePiece& segment, const Simplex& ends, Along along) {
  if (along == Along::inside) return segment;
  return vertex_piece(ends.vertex[along == Along::first ? 0 : 1]);
}

bool is_point(const Simplex& segment) {
  return segment.point[0] == segment.point[1];
}

/// Whether two segments are parallel. Neither is a point.
bool are_parallel(const Simplex& a, const Simplex& b, DecisionCount& count) {
  const bool are_same = a.point[0] == b.point[0] && a.point[1] == b.point[1];
  const bool are_reversed = a.point[0] == b.point[1] && a.point[1] == b.point[0];
  if (are_same || are_reversed) return true;
  return is_zero(count, [&]<typename Number>() {
    return cross(difference<Number>(a.point[1], a.point[0]), difference<Number>(b.point[1], b.point[0]));
  });
}

/// Whether the closest points of two lines that are not parallel are inside both segments on them. It asks
/// for the parameters times the square of the lines' cross product, and for what is left of that.
bool are_closest_inside(const Simplex& a, const Simplex& b, DecisionCount& count) {
  const auto is_above_zero = [&](const auto& left_of, const auto& right_of) {
    return decide_sign(count, [&]<typename Number>() {
             const Vector<Number> normal = cross(difference<Number>(a.point[1], a.point[0]),
                                                 difference<Number>(b.point[1], b.point[0]));
             return dot(cross(left_of.template operator()<Number>(), right_of.template operator()<Number>()),
                        normal);
           }) > 0;
  };
  const auto u = [&]<typename Number>() { return difference<Number>(a.point[1], a.point[0]); };
  const auto v = [&]<typename Number>() { return difference<Number>(b.point[1], b.point[0]); };
  const auto between = [](const Eigen::Vector3d& to, const Eigen::Vector3d& from) {
    return [&to, &from]<typename Number>() { return difference<Number>(to, from); };
  };
  return is_above_zero(between(b.point[0], a.point[0]), v) &&
         is_above_zero(between(a.point[1], b.point[0]), v) &&
         is_above_zero(between(b.point[0], a.point[0]), u) &&
         is_above_zero(u, between(b.point[1], a.point[0]));
}

/// The ends at which two segments meet, with equal bits.
std::optional<std::array<std::size_t, 2>> shared_ends(const Simplex& a, const Simplex& b) {
  for (std::size_t end_a = 0; end_a < 2; ++end_a)
    for (std::size_t end_b = 0; end_b < 2; ++end_b)
      if (a.point[end_a] == b.point[end_b]) return std::array{end_a, end_b};
  return std::nullopt;
}

/// The pieces at the ends of the common stretch of parallel segments. Where they have none, those of the
/// nearest ends. Found by how far along a the ends of b are.
ClosestPiecesOfSegments ends_of_common_stretch(const FeaturePiece& segment_a, const Simplex& a,
                                               const FeaturePiece& segment_b, const Simplex& b,
                                               DecisionCount& count) {
  // How far end `end_b` of b has come past end `end_a` of a.
  const auto past = [&](std::size_t end_a, std::size_t end_b) {
    return decide_sign(count, [&]<typename Number>() {
      return dot(difference<Number>(a.point[1], a.point[0]),
                 difference<Number>(b.point[end_b], a.point[end_a]));
    });
  };
  const bool same_way =
      decide_sign(count, [&]<typename Number>() {
        return dot(difference<Number>(a.point[1], a.point[0]), difference<Number>(b.point[1], b.point[0]));
      }) > 0;
  const std::size_t low_b = same_way ? 0 : 1;
  const std::size_t high_b = 1 - low_b;
  const auto end_of_a = [&](std::size_t end) { return vertex_piece(a.vertex[end]); };
  const auto end_of_b = [&](std::size_t end) { return vertex_piece(b.vertex[end]); };
  ClosestPiecesOfSegments all;
  const auto add = [&](const FeaturePiece& of_a, const FeaturePiece& of_b) {
    all.pieces[all.size++] = {of_a, of_b};
  };
  const int low_past_end = past(1, low_b);
  const int high_past_begin = past(0, high_b);
  if (low_past_end >= 0) {
    add(end_of_a(1), end_of_b(low_b));
  } else if (high_past_begin <= 0) {
    add(end_of_a(0), end_of_b(high_b));
  } else {
    const int low = past(0, low_b);
    add(low > 0 ? segment_a : end_of_a(0), low < 0 ? segment_b : end_of_b(low_b));
    const int high = past(1, high_b);
    add(high < 0 ? segment_a : end_of_a(1), high > 0 ? segment_b : end_of_b(high_b));
  }
  return all;
}

/// The closest points of each end of either segment and the other segment, keeping those at the least
/// distance.
class NearestEnds {
 public:
  NearestEnds(const Surface& surface_a, const Surface& surface_b, DecisionCount& count)
      : surface_a_(surface_a), surface_b_(surface_b), count_(count) {}

  void add(const FeaturePiece& piece_a, const FeaturePiece& piece_b) {
    const std::array pieces{piece_a, piece_b};
    const auto* const end = found_.pieces.begin() + found_.size;
    if (std::find(found_.pieces.cbegin(), static_cast<decltype(found_.pieces.cbegin())>(end), pieces) != end)
      return;
    const int order = found_.size == 0 ? -1 : compare_with_found(pieces);
    if (order > 0) return;
    if (order < 0) found_.size = 0;
    found_.pieces[found_.size++] = pieces;
  }
  [[nodiscard]] const ClosestPiecesOfSegments& found() const { return found_; }

 private:
  [[nodiscard]] int compare_with_found(const std::array<FeaturePiece, 2>& pieces) const {
    const auto& best = found_.pieces[0];
    const Simplex best_a = simplex_of(surface_a_, best[0]);
    const Simplex best_b = simplex_of(surface_b_, best[1]);
    const Simplex a = simplex_of(surface_a_, pieces[0]);
    const Simplex b = simplex_of(surface_b_, pieces[1]);
    return decide(count_, [&]<typename Number>(bool& unsure) {
      return compare(hull_distance_squared<Number>(a, b), hull_distance_squared<Number>(best_a, best_b),
                     unsure);
    });
  }

  const Surface& surface_a_;
  const Surface& surface_b_;
  DecisionCount& count_;
  ClosestPiecesOfSegments found_;
};

}  // namespace

FeaturePiece diagonal_of(const IndexedMesh& mesh, std::uint32_t face) {
  const auto corner = mesh.face(face);
  const auto [low, high] = std::minmax(corner[0], corner[2]);
  for (const std::uint32_t edge : mesh.face_edges(face))
    if (edge != IndexedMesh::no_edge && mesh.edge(edge) == std::array{low, high}) return edge_piece(edge);
  return face_piece(face, Piece::fold);
}

Simplex simplex_of(const Surface& surface, const FeaturePiece& piece) {
  Simplex simplex;
  simplex.size = corner_count(piece);
  simplex.vertex = corners_of(surface.mesh(), piece);
  for (std::uint32_t i = 0; i < simplex.size; ++i) simplex.point[i] = surface.position(simplex.vertex[i]);
  return simplex;
}

FeaturePiece nearest_piece_of_segment(const Eigen::Vector3d& point, const Surface& surface,
                                      const FeaturePiece& segment, DecisionCount& count) {
  const Simplex ends = simplex_of(surface, segment);
  if (coincide(surface, ends.vertex[0], ends.vertex[1])) return vertex_piece(end_vertex(surface, ends, 0));
  const auto past = [&](std::size_t end) {
    return decide_sign(count, [&]<typename Number>() {
      return dot(difference<Number>(ends.point[1], ends.point[0]),
                 difference<Number>(point, ends.point[end]));
    });
  };
  if (past(0) <= 0) return vertex_piece(ends.vertex[0]);
  return past(1) >= 0 ? vertex_piece(ends.vertex[1]) : segment;
}

FeaturePiece nearest_piece_of_face(const Eigen::Vector3d& point, const Surface& surface, std::uint32_t face,
                                   DecisionCount& count, SquaredRange& squared) {
  const IndexedMesh& mesh = surface.mesh();
  const FeaturePiece first = nearest_piece_of_triangle(point, surface, face, Piece::first, count, squared);
  if (triangle_count(mesh, face) == 1) return first;
  SquaredRange squared_second;
  // A point on the diagonal belongs to both triangles. So if one triangle has its closest point there, the
  // other is at least as near.
  const FeaturePiece second =
      nearest_piece_of_triangle(point, surface, face, Piece::second, count, squared_second);
  const SquaredRange squared_first = std::exchange(squared, SquaredRange{});
  if (is_on_diagonal(mesh, face, second) && is_on_diagonal(mesh, face, first))
    return nearer(point, surface, first, second, count);
  if (is_on_diagonal(mesh, face, second)) {
    squared = squared_first;
    return first;
  }
  if (is_on_diagonal(mesh, face, first)) {
    squared = squared_second;
    return second;
  }
  return nearer(point, surface, first, second, count);
}

ClosestPiecesOfSegments nearest_pieces_of_segments(const Surface& surface_a, const FeaturePiece& segment_a,
                                                   const Surface& surface_b, const FeaturePiece& segment_b,
                                                   DecisionCount& count, SquaredRange& squared) {
  const Simplex a = simplex_of(surface_a, segment_a);
  const Simplex b = simplex_of(surface_b, segment_b);
  const auto one_pair = [](const FeaturePiece& of_a, const FeaturePiece& of_b) {
    ClosestPiecesOfSegments all;
    all.size = 1;
    all.pieces[0] = {of_a, of_b};
    return all;
  };
  const auto ends = shared_ends(a, b);
  if (ends) squared = {0, 0};
  if (ends && certainly_not_parallel(a.point[1] - a.point[0], b.point[1] - b.point[0])) {
    ++count.in_double;
    return one_pair(vertex_piece(a.vertex[(*ends)[0]]), vertex_piece(b.vertex[(*ends)[1]]));
  }
  std::array<Along, 2> along{};
  if (certain_along({a.point[0], a.point[1]}, {b.point[0], b.point[1]}, along, squared)) {
    ++count.in_double;
    return one_pair(piece_along(segment_a, a, along[0]), piece_along(segment_b, b, along[1]));
  }
  if (!is_point(a) && !is_point(b)) {
    if (are_parallel(a, b, count)) return ends_of_common_stretch(segment_a, a, segment_b, b, count);
    if (ends) return one_pair(vertex_piece(a.vertex[(*ends)[0]]), vertex_piece(b.vertex[(*ends)[1]]));
    if (are_closest_inside(a, b, count)) return one_pair(segment_a, segment_b);
  }
  NearestEnds nearest(surface_a, surface_b, count);
  for (std::size_t end = 0; end < 2; ++end) {
    const std::uint32_t vertex_a = end_vertex(surface_a, a, end);
    nearest.add(vertex_piece(vertex_a),
                nearest_piece_of_segment(surface_a.position(vertex_a), surface_b, segment_b, count));
    const std::uint32_t vertex_b = end_vertex(surface_b, b, end);
    nearest.add(nearest_piece_of_segment(surface_b.position(vertex_b), surface_a, segment_a, count),
                vertex_piece(vertex_b));
  }
  return nearest.found();
}

bool are_nearest_inside(const Surface& surface_a, const FeaturePiece& segment_a, const Surface& surface_b,
                        const FeaturePiece& segment_b, DecisionCount& count, SquaredRange& squared) {
  const Simplex a = simplex_of(surface_a, segment_a);
  const Simplex b = simplex_of(surface_b, segment_b);
  if (shared_ends(a, b)) return false;
  std::array<Along, 2> along{};
  if (certain_along({a.point[0], a.point[1]}, {b.point[0], b.point[1]}, along, squared)) {
    ++count.in_double;
    return along[0] == Along::inside && along[1] == Along::inside;
  }
  return !is_point(a) && !is_point(b) && !are_parallel(a, b, count) && are_closest_inside(a, b, count);
}

bool is_folded(const Surface& surface, std::uint32_t face, DecisionCount& count) {
  const IndexedMesh& mesh = surface.mesh();
  if (triangle_count(mesh, face) == 1 || diagonal_of(mesh, face).feature.kind != FeatureKind::face)
    return false;
  const auto corner = mesh.face(face);
  const auto from_first = [&]<typename Number>(std::size_t i) {
    return difference<Number>(surface.position(corner[i]), surface.position(corner[0]));
  };
  return decide(count, [&]<typename Number>(bool& unsure) {
    const auto diagonal = from_first.template operator()<Number>(2);
    const auto second = from_first.template operator()<Number>(1);
    const auto fourth = from_first.template operator()<Number>(3);
    const Vector<Number> normal = cross(second, diagonal);
    if (sign(dot(normal, fourth), unsure) != 0) return true;
    return sign(dot(normal, cross(fourth, diagonal)), unsure) >
           0;  // in one plane, both on one side of the diagonal
  });
}

}  // namespace graze
