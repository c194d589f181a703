#include "naming.hpp"

#include <algorithm>
#include <utility>

#include "certain.hpp"
#include "ratio.hpp"

namespace graze {
namespace {

/// The region of Voronoi of a triangle that holds the point; its borders belong to the lower dimension.
template <typename Number>
Place place_in_triangle(const Eigen::Vector3d& point, const std::array<Eigen::Vector3d, 3>& corner,
                        bool& unsure) {
  using V = Vector<Number>;
  const auto at_most_zero = [&](const Number& number) { return sign(number, unsure) <= 0; };
  const V u = difference<Number>(corner[1], corner[0]);
  const V v = difference<Number>(corner[2], corner[0]);
  const V normal = cross(u, v);
  if (sign(dot(normal, normal), unsure) == 0) return Place::no_area;

  const V from0 = difference<Number>(point, corner[0]);
  const Number u0 = dot(u, from0);
  const Number v0 = dot(v, from0);
  if (at_most_zero(u0) && at_most_zero(v0)) return Place::vertex0;
  const V from1 = difference<Number>(point, corner[1]);
  const Number u1 = dot(u, from1);
  const Number v1 = dot(v, from1);
  if (at_most_zero(-u1) && at_most_zero(v1 - u1)) return Place::vertex1;
  const V from2 = difference<Number>(point, corner[2]);
  const Number u2 = dot(u, from2);
  const Number v2 = dot(v, from2);
  if (at_most_zero(-v2) && at_most_zero(u2 - v2)) return Place::vertex2;

  if (at_most_zero(u0 * v1 - u1 * v0) && at_most_zero(-u0) && at_most_zero(u1)) return Place::edge01;
  if (at_most_zero(u2 * v0 - u0 * v2) && at_most_zero(-v0) && at_most_zero(v2)) return Place::edge20;
  if (at_most_zero(u1 * v2 - u2 * v1) && at_most_zero(u1 - v1) && at_most_zero(v2 - u2)) return Place::edge12;
  return Place::inside;
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

/// Of two pieces that hold the closest points of two parts of a face, that of the nearer part; where they are
/// equally near, the lower name, then `first`.
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

FaceTriangle triangle_of(const Surface& surface, std::uint32_t face, Piece which) {
  const Mesh& mesh = surface.mesh();
  FaceTriangle triangle;
  triangle.corners = simplex_of(surface, face_piece(face, which));
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
  const FaceTriangle triangle = triangle_of(surface, face, which);
  Place place{};
  if (certain_place(point, triangle.corners.point, place, squared))
    ++count.in_double;
  else
    place = decide(count, [&]<typename Number>(bool& unsure) {
      return place_in_triangle<Number>(point, triangle.corners.point, unsure);
    });
  switch (place) {
    case Place::vertex0:
    case Place::vertex1:
    case Place::vertex2:
      return vertex_piece(triangle.corners.vertex[static_cast<std::size_t>(place)]);
    case Place::edge01:
    case Place::edge12:
    case Place::edge20:
      return triangle.sides[static_cast<std::size_t>(place) - 3];
    case Place::inside:
      return face_piece(face, which);
    case Place::no_area:
      break;
  }
  return nearest_piece_of_sides(point, surface, triangle, count);
}

bool is_on_diagonal(const Mesh& mesh, std::uint32_t face, const FeaturePiece& piece) {
  const auto corner = mesh.face(face);
  if (piece.feature.kind == FeatureKind::vertex)
    return piece.feature.index == corner[0] || piece.feature.index == corner[2];
  return piece == diagonal_of(mesh, face);
}

bool coincide(const Surface& surface, std::uint32_t vertex, std::uint32_t other) {
  return surface.position(vertex) == surface.position(other);
}

/// An end of a segment under the name that a point of zero length goes by: its lower vertex.
std::uint32_t end_vertex(const Surface& surface, const Simplex& segment, std::size_t end) {
  if (!coincide(surface, segment.vertex[0], segment.vertex[1])) return segment.vertex[end];
  return std::min(segment.vertex[0], segment.vertex[1]);
}

/// The piece of a segment that a place on it is.
FeaturePiece piece_along(const FeaturePiece& segment, const Simplex& ends, Along place) {
  if (place == Along::inside) return segment;
  return vertex_piece(ends.vertex[place == Along::first ? 0 : 1]);
}

/// How the closest points of two lines lie to the segments on them.
enum class LinePair : std::uint8_t { inside_both, at_an_end, parallel };

template <typename Number>
LinePair classify_lines(const Simplex& a, const Simplex& b, bool& unsure) {
  const Vector<Number> u = difference<Number>(a.point[1], a.point[0]);
  const Vector<Number> v = difference<Number>(b.point[1], b.point[0]);
  const Vector<Number> normal = cross(u, v);
  const Number determinant = dot(normal, normal);
  if (sign(determinant, unsure) == 0) return LinePair::parallel;
  const Vector<Number> w = difference<Number>(b.point[0], a.point[0]);
  // Parameters times the determinant, both in (0, determinant) for interior points.
  const Number s = dot(cross(w, v), normal);
  const Number t = dot(cross(w, u), normal);
  const bool inside = sign(s, unsure) > 0 && sign(determinant - s, unsure) > 0 && sign(t, unsure) > 0 &&
                      sign(determinant - t, unsure) > 0;
  return inside ? LinePair::inside_both : LinePair::at_an_end;
}

/// The closest points of each end of either segment and the other segment, keeping those at the least
/// distance.
class NearestEnds {
 public:
  NearestEnds(const Surface& surface_a, const Surface& surface_b, DecisionCount& count)
      : surface_a_(surface_a), surface_b_(surface_b), count_(count) {}

  void add(const FeaturePiece& piece_a, const FeaturePiece& piece_b) {
    const std::array name{piece_a, piece_b};
    const auto* const end = found_.names.begin() + found_.size;
    if (std::find(found_.names.cbegin(), static_cast<decltype(found_.names.cbegin())>(end), name) != end)
      return;
    const int order = found_.size == 0 ? -1 : compare_with_found(name);
    if (order > 0) return;
    if (order < 0) found_.size = 0;
    found_.names[found_.size++] = name;
  }
  [[nodiscard]] const SegmentPairNames& found() const { return found_; }

 private:
  [[nodiscard]] int compare_with_found(const std::array<FeaturePiece, 2>& name) const {
    const auto& best = found_.names[0];
    const Simplex best_a = simplex_of(surface_a_, best[0]);
    const Simplex best_b = simplex_of(surface_b_, best[1]);
    const Simplex a = simplex_of(surface_a_, name[0]);
    const Simplex b = simplex_of(surface_b_, name[1]);
    return decide(count_, [&]<typename Number>(bool& unsure) {
      return compare(hull_distance_squared<Number>(a, b), hull_distance_squared<Number>(best_a, best_b),
                     unsure);
    });
  }

  const Surface& surface_a_;
  const Surface& surface_b_;
  DecisionCount& count_;
  SegmentPairNames found_;
};

}  // namespace

FeaturePiece diagonal_of(const Mesh& mesh, std::uint32_t face) {
  const auto corner = mesh.face(face);
  const auto [low, high] = std::minmax(corner[0], corner[2]);
  for (const std::uint32_t edge : mesh.face_edges(face))
    if (edge != Mesh::no_edge && mesh.edge(edge) == std::array{low, high}) return edge_piece(edge);
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
  const int place = decide(count, [&]<typename Number>(bool& unsure) {
    const Vector<Number> direction = difference<Number>(ends.point[1], ends.point[0]);
    if (sign(dot(direction, difference<Number>(point, ends.point[0])), unsure) <= 0) return -1;
    return sign(dot(direction, difference<Number>(point, ends.point[1])), unsure) >= 0 ? 1 : 0;
  });
  if (place == 0) return segment;
  return vertex_piece(ends.vertex[place < 0 ? 0 : 1]);
}

FeaturePiece nearest_piece_of_face(const Eigen::Vector3d& point, const Surface& surface, std::uint32_t face,
                                   DecisionCount& count, SquaredRange& squared) {
  const Mesh& mesh = surface.mesh();
  const FeaturePiece first = nearest_piece_of_triangle(point, surface, face, Piece::first, count, squared);
  if (triangle_count(mesh, face) == 1) return first;
  SquaredRange squared_second;
  // A point on the diagonal belongs to both triangles, so the triangle that names another one is at least as
  // near.
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

SegmentPairNames nearest_pieces_of_segments(const Surface& surface_a, const FeaturePiece& segment_a,
                                            const Surface& surface_b, const FeaturePiece& segment_b,
                                            DecisionCount& count, SquaredRange& squared) {
  const Simplex a = simplex_of(surface_a, segment_a);
  const Simplex b = simplex_of(surface_b, segment_b);
  std::array<Along, 2> places{};
  if (certain_places({a.point[0], a.point[1]}, {b.point[0], b.point[1]}, places, squared)) {
    ++count.in_double;
    SegmentPairNames names;
    names.size = 1;
    names.names[0] = {piece_along(segment_a, a, places[0]), piece_along(segment_b, b, places[1])};
    return names;
  }
  const LinePair lines =
      decide(count, [&]<typename Number>(bool& unsure) { return classify_lines<Number>(a, b, unsure); });
  if (lines == LinePair::inside_both) {
    SegmentPairNames names;
    names.size = 1;
    names.names[0] = {segment_a, segment_b};
    return names;
  }
  NearestEnds ends(surface_a, surface_b, count);
  for (std::size_t end = 0; end < 2; ++end) {
    const std::uint32_t vertex_a = end_vertex(surface_a, a, end);
    ends.add(vertex_piece(vertex_a),
             nearest_piece_of_segment(surface_a.position(vertex_a), surface_b, segment_b, count));
    const std::uint32_t vertex_b = end_vertex(surface_b, b, end);
    ends.add(nearest_piece_of_segment(surface_b.position(vertex_b), surface_a, segment_a, count),
             vertex_piece(vertex_b));
  }
  return ends.found();
}

bool is_folded(const Surface& surface, std::uint32_t face, DecisionCount& count) {
  const Mesh& mesh = surface.mesh();
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
