#include "closest_features/piercing.hpp"

#include <array>

#include "arithmetic/certain.hpp"

namespace graze {
namespace {

/// How a segment crosses a triangle.
enum class Crossing : std::uint8_t { none, inside, on_side };

/// A segment that ends at a corner of a triangle has that end in its plane.
bool share_a_corner(std::span<const Eigen::Vector3d> segment, std::span<const Eigen::Vector3d, 3> triangle) {
  for (std::size_t end = 0; end < 2; ++end)
    for (const Eigen::Vector3d& corner : triangle)
      if (segment[end] == corner) return true;
  return false;
}

/// `open_side` is the side (0-1, 1-2, 2-0) that counts as inside, a quad's fold. It is 3 for none.
Crossing crossing(const Simplex& segment, const Simplex& triangle, std::size_t open_side,
                  DecisionCount& count) {
  const Eigen::Vector3d& p = segment.point[0];
  const Eigen::Vector3d& q = segment.point[1];
  const auto& corner = triangle.point;
  const auto side_of_plane = [&](const Eigen::Vector3d& end) {
    return decide_sign(count, [&]<typename Number>() {
      const Vector<Number> normal = normal_of_corners<Number>(corner);
      return dot(normal, difference<Number>(end, corner[0]));
    });
  };
  const int side_p = side_of_plane(p);
  if (side_p == 0) return Crossing::none;
  const int side_q = side_of_plane(q);
  if (side_p * side_q != -1) return Crossing::none;
  Crossing result = Crossing::inside;
  for (std::size_t side = 0; side < 3; ++side) {
    const int turn = decide_sign(count, [&]<typename Number>() {
      return dot(difference<Number>(q, p),
                 cross(difference<Number>(corner[side], p), difference<Number>(corner[(side + 1) % 3], p)));
    });
    if (turn == 0 && side == open_side)
      result = Crossing::on_side;
    else if (turn != side_q)
      return Crossing::none;
  }
  return result;
}

/// Whether an edge pierces a triangle that is a face. Most are decided without pieces, which take as long.
bool pierces_triangle(const Surface& surface, std::uint32_t edge, const Surface& other, std::uint32_t face,
                      DecisionCount& count) {
  const auto end = surface.mesh().edge(edge);
  const auto corner = other.mesh().face(face);
  const std::array<Eigen::Vector3d, 2> ends{surface.position(end[0]), surface.position(end[1])};
  const std::array<Eigen::Vector3d, 3> corners{other.position(corner[0]), other.position(corner[1]),
                                               other.position(corner[2])};
  if (share_a_corner(ends, corners)) return false;
  if (const Passing passing = certain_passing(ends, corners); passing != Passing::unsure) {
    ++count.in_double;
    return passing == Passing::yes;
  }
  return crossing(simplex_of(surface, edge_piece(edge)), simplex_of(other, face_piece(face, Piece::first)), 3,
                  count) != Crossing::none;
}

}  // namespace

std::optional<Piece> pierced_triangle(const Simplex& segment, std::span<const Simplex> triangles,
                                      bool has_fold, DecisionCount& count) {
  const auto crosses = [&](const Simplex& triangle, std::size_t fold_side) {
    if (share_a_corner(segment.point, triangle.point)) return false;
    const Passing passing = certain_passing({segment.point[0], segment.point[1]}, triangle.point);
    if (passing != Passing::unsure) {
      ++count.in_double;
      return passing == Passing::yes;
    }
    return crossing(segment, triangle, has_fold ? fold_side : 3, count) != Crossing::none;
  };
  // The fold is side 2-0 of the first triangle and side 0-1 of the second.
  const bool first = crosses(triangles[0], 2);
  const bool second = triangles.size() == 2 && crosses(triangles[1], 0);
  if (!first && !second) return std::nullopt;
  if (!second) return Piece::first;
  if (!first) return Piece::second;
  const int order = decide(count, [&]<typename Number>(bool& unsure) {
    return compare(crossing_parameter<Number>(segment, triangles[0], unsure),
                   crossing_parameter<Number>(segment, triangles[1], unsure), unsure);
  });
  return order <= 0 ? Piece::first : Piece::second;
}

std::optional<FeaturePiece> pierced_piece(const Surface& surface, const FeaturePiece& segment,
                                          const Surface& other, std::uint32_t face, DecisionCount& count) {
  const bool is_quad = triangle_count(other.mesh(), face) == 2;
  if (!is_quad && segment.feature.kind == FeatureKind::edge) {
    const bool pierces = pierces_triangle(surface, segment.feature.index, other, face, count);
    return pierces ? std::optional(face_piece(face, Piece::first)) : std::nullopt;
  }
  std::array<Simplex, 2> triangles;
  triangles[0] = simplex_of(other, face_piece(face, Piece::first));
  if (is_quad) triangles[1] = simplex_of(other, face_piece(face, Piece::second));
  const bool has_fold = is_quad && diagonal_of(other.mesh(), face).feature.kind == FeatureKind::face;
  const auto piece = pierced_triangle(simplex_of(surface, segment),
                                      std::span(triangles).first(is_quad ? 2 : 1), has_fold, count);
  if (!piece) return std::nullopt;
  return face_piece(face, *piece);
}

}  // namespace graze
