#pragma once

#include <array>
#include <cstdint>
#include <graze/contact.hpp>

#include "arithmetic/arithmetic.hpp"
#include "arithmetic/certain.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// Which flat piece of a feature a closest point lies in. A quad is two triangles, split from its first
/// corner, that meet in its fold. Every other feature is one piece.
enum class Piece : std::uint8_t { fold, first, second };

/// A flat piece of a feature: a vertex, an edge, a triangle of a face, or a quad's fold.
struct FeaturePiece {
  Feature feature;
  Piece piece = Piece::first;

  friend auto operator<=>(const FeaturePiece&, const FeaturePiece&) = default;
};

inline FeaturePiece vertex_piece(std::uint32_t index) {
  return {{FeatureKind::vertex, index}, Piece::first};
}
inline FeaturePiece edge_piece(std::uint32_t index) {
  return {{FeatureKind::edge, index}, Piece::first};
}
inline FeaturePiece face_piece(std::uint32_t index, Piece piece) {
  return {{FeatureKind::face, index}, piece};
}

/// How many corners a piece has: 1, 2 or 3.
inline std::uint32_t corner_count(const FeaturePiece& piece) {
  if (piece.feature.kind == FeatureKind::face) return piece.piece == Piece::fold ? 2 : 3;
  return piece.feature.kind == FeatureKind::vertex ? 1 : 2;
}
/// Their vertices, and 0 for those that it has not.
inline std::array<std::uint32_t, 3> corners_of(const IndexedMesh& mesh, const FeaturePiece& piece) {
  const std::uint32_t index = piece.feature.index;
  if (piece.feature.kind == FeatureKind::vertex) return {index, 0, 0};
  if (piece.feature.kind == FeatureKind::edge) return {mesh.edge(index)[0], mesh.edge(index)[1], 0};
  const auto corner = mesh.face(index);
  if (piece.piece == Piece::first) return {corner[0], corner[1], corner[2]};
  return {corner[0], corner[2], piece.piece == Piece::second ? corner[3] : 0};
}

/// The corners of a piece: 1, 2 or 3 points of the surface.
struct Simplex {
  std::uint32_t size = 0;
  std::array<std::uint32_t, 3> vertex{};
  std::array<Eigen::Vector3d, 3> point;
};
Simplex simplex_of(const Surface& surface, const FeaturePiece& piece);

/// How many triangles face `face` is made of.
inline std::uint32_t triangle_count(const IndexedMesh& mesh, std::uint32_t face) {
  return static_cast<std::uint32_t>(mesh.face(face).size()) - 2;
}

/// The feature that joins a quad's first and third corner: its fold, or an edge of the same face.
FeaturePiece diagonal_of(const IndexedMesh& mesh, std::uint32_t face);

/// The piece of a segment or face in whose relative interior the point closest to `point` lies. A point that
/// several pieces share goes to the lowest dimension, then to the lowest index. `segment` is an edge or a
/// fold. `squared` is narrowed where more is known of the distance.
FeaturePiece nearest_piece_of_segment(const Eigen::Vector3d& point, const Surface& surface,
                                      const FeaturePiece& segment, DecisionCount& count);
FeaturePiece nearest_piece_of_face(const Eigen::Vector3d& point, const Surface& surface, std::uint32_t face,
                                   DecisionCount& count, SquaredRange& squared);

/// The pieces with the closest points of two segments (edges or folds). There is one pair of pieces where the
/// points are unique or lie in both interiors. Parallel segments have a pair at each end of the common
/// stretch. `squared` is narrowed where more is known of the distance.
struct ClosestPiecesOfSegments {
  std::uint32_t size = 0;
  std::array<std::array<FeaturePiece, 2>, 4> pieces;
};
ClosestPiecesOfSegments nearest_pieces_of_segments(const Surface& surface_a, const FeaturePiece& segment_a,
                                                   const Surface& surface_b, const FeaturePiece& segment_b,
                                                   DecisionCount& count, SquaredRange& squared);

/// Whether that is one pair of points, inside both segments.
bool are_nearest_inside(const Surface& surface_a, const FeaturePiece& segment_a, const Surface& surface_b,
                        const FeaturePiece& segment_b, DecisionCount& count, SquaredRange& squared);

/// Whether a quad's diagonal is a fold. It is one where the corners do not lie in one plane. It is one as
/// well where they do, but with both triangles on one side of the diagonal: they lie on each other, and the
/// diagonal is a border.
bool is_folded(const Surface& surface, std::uint32_t face, DecisionCount& count);

}  // namespace graze
