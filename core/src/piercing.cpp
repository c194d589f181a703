#include "piercing.hpp"

#include "certain.hpp"

namespace graze {
namespace {

/// Where a segment crosses a triangle.
enum class Crossing : std::uint8_t { none, inside, on_side };

/// `open_side` is the side (0-1, 1-2, 2-0) that counts as inside, a quad's fold; 3 for none.
template <typename Number>
Crossing crossing(const Simplex& segment, const Simplex& triangle, std::size_t open_side, bool& unsure) {
  const Eigen::Vector3d& p = segment.point[0];
  std::array<Vector<Number>, 3> corner;
  for (std::size_t i = 0; i < 3; ++i) corner[i] = difference<Number>(triangle.point[i], p);
  const Vector<Number> normal = cross(difference<Number>(triangle.point[1], triangle.point[0]),
                                      difference<Number>(triangle.point[2], triangle.point[0]));
  const int side_p = -sign(dot(normal, corner[0]), unsure);
  const int side_q = sign(dot(normal, difference<Number>(segment.point[1], triangle.point[0])), unsure);
  if (side_p * side_q != -1) return Crossing::none;
  const Vector<Number> direction = difference<Number>(segment.point[1], p);
  Crossing result = Crossing::inside;
  for (std::size_t side = 0; side < 3; ++side) {
    const int turn = sign(dot(direction, cross(corner[side], corner[(side + 1) % 3])), unsure);
    if (turn == 0 && side == open_side)
      result = Crossing::on_side;
    else if (turn != side_q)
      return Crossing::none;
  }
  return result;
}

}  // namespace

std::optional<FeaturePiece> pierced_piece(const Surface& surface, const FeaturePiece& segment,
                                          const Surface& other, std::uint32_t face, DecisionCount& count) {
  const Simplex ends = simplex_of(surface, segment);
  const bool is_quad = triangle_count(other.mesh(), face) == 2;
  const bool has_fold = is_quad && diagonal_of(other.mesh(), face).feature.kind == FeatureKind::face;
  const auto cross_triangle = [&](Piece piece, std::size_t open_side) {
    const Simplex triangle = simplex_of(other, face_piece(face, piece));
    const Passing passing = certain_passing({ends.point[0], ends.point[1]}, triangle.point);
    if (passing != Passing::unsure) {
      ++count.in_double;
      return passing == Passing::yes ? Crossing::inside : Crossing::none;
    }
    return decide(count, [&]<typename Number>(bool& unsure) {
      return crossing<Number>(ends, triangle, open_side, unsure);
    });
  };
  // The fold is side 2-0 of the first triangle and side 0-1 of the second.
  const bool first = cross_triangle(Piece::first, has_fold ? 2 : 3) != Crossing::none;
  const bool second = is_quad && cross_triangle(Piece::second, has_fold ? 0 : 3) != Crossing::none;
  if (!first && !second) return std::nullopt;
  if (!second) return face_piece(face, Piece::first);
  if (!first) return face_piece(face, Piece::second);
  const Simplex first_triangle = simplex_of(other, face_piece(face, Piece::first));
  const Simplex second_triangle = simplex_of(other, face_piece(face, Piece::second));
  const int order = decide(count, [&]<typename Number>(bool& unsure) {
    return compare(crossing_parameter<Number>(ends, first_triangle, unsure),
                   crossing_parameter<Number>(ends, second_triangle, unsure), unsure);
  });
  return face_piece(face, order <= 0 ? Piece::first : Piece::second);
}

}  // namespace graze
