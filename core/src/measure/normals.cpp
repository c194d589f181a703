#include "measure/normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "arithmetic/direction.hpp"

namespace graze {
namespace {

std::optional<Eigen::Vector3d> triangle_normal(const std::array<Eigen::Vector3d, 3>& point,
                                               DecisionCount& count) {
  return unit_direction(count, [&]<typename Number>() { return normal_of_corners<Number>(point); });
}

/// The angle of a triangle at its corner `at`.
double angle_at(const std::array<Eigen::Vector3d, 3>& point, std::size_t at) {
  const Eigen::Vector3d u = (point[(at + 1) % 3] - point[at]).stableNormalized();
  const Eigen::Vector3d v = (point[(at + 2) % 3] - point[at]).stableNormalized();
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Adds a triangle's normal, weighted by its angle at a vertex, or by a half turn where it holds the whole
/// edge.
class WeightedSum {
 public:
  WeightedSum(const Surface& surface, DecisionCount& count) : surface_(surface), count_(count) {}

  void add_face(std::uint32_t face, const Feature& feature) {
    add(simplex_of(surface_, face_piece(face, Piece::first)), feature);
    if (triangle_count(surface_.mesh(), face) == 2)
      add(simplex_of(surface_, face_piece(face, Piece::second)), feature);
  }
  [[nodiscard]] const Eigen::Vector3d& sum() const { return sum_; }

 private:
  void add(const Simplex& triangle, const Feature& feature) {
    const double weight = feature.kind == FeatureKind::vertex ? vertex_weight(triangle, feature.index)
                                                              : edge_weight(triangle, feature.index);
    if (weight == 0) return;
    if (const auto normal = triangle_normal(triangle.point, count_)) sum_ += *normal * weight;
  }
  static double vertex_weight(const Simplex& triangle, std::uint32_t vertex) {
    for (std::size_t i = 0; i < 3; ++i)
      if (triangle.vertex[i] == vertex) return angle_at(triangle.point, i);
    return 0;
  }
  [[nodiscard]] double edge_weight(const Simplex& triangle, std::uint32_t edge) const {
    const auto ends = surface_.mesh().edge(edge);
    std::size_t found = 0;
    for (const std::uint32_t vertex : triangle.vertex)
      if (vertex == ends[0] || vertex == ends[1]) ++found;
    return found == 2 ? std::numbers::pi : 0;
  }

  const Surface& surface_;
  DecisionCount& count_;
  Eigen::Vector3d sum_ = Eigen::Vector3d::Zero();
};

}  // namespace

std::optional<Eigen::Vector3d> face_normal(const Surface& surface, const FeaturePiece& piece,
                                           DecisionCount& count) {
  const auto normal_of = [&](Piece which) {
    return triangle_normal(simplex_of(surface, face_piece(piece.feature.index, which)).point, count);
  };
  if (piece.piece != Piece::fold) return normal_of(piece.piece);
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const Eigen::Vector3d sum =
      normal_of(Piece::first).value_or(zero) + normal_of(Piece::second).value_or(zero);
  if (sum.norm() < 0x1p-40) return std::nullopt;  // folded flat upon itself
  return sum.normalized();
}

Eigen::Vector3d weighted_normal(const Surface& surface, const FeaturePiece& piece, DecisionCount& count) {
  const IndexedMesh& mesh = surface.mesh();
  const std::uint32_t index = piece.feature.index;
  if (piece.feature.kind == FeatureKind::face)
    return face_normal(surface, piece, count).value_or(Eigen::Vector3d::Zero());
  WeightedSum weighted(surface, count);
  const auto faces =
      piece.feature.kind == FeatureKind::vertex ? mesh.vertex_faces(index) : mesh.edge_faces(index);
  for (const std::uint32_t face : faces) weighted.add_face(face, piece.feature);
  return weighted.sum();
}

Side side_of(const Surface& surface, const FeaturePiece& piece, const Eigen::Vector3d& gap,
             DecisionCount& count) {
  const Eigen::Vector3d normal = weighted_normal(surface, piece, count);
  const Eigen::Vector3d direction = gap.stableNormalized();
  const double along = normal.dot(direction);
  // Unit normals and the direction are within 2^-44 of the true ones, angles nearly so. A vertex has at most
  // a few thousand triangles before the sum of its weights exceeds 2^-36 / 2^-44.
  if (!(std::abs(along) > 0x1p-36)) return Side::none;
  return along > 0 ? Side::front : Side::back;
}

Eigen::Vector3d touching_normal(const Surface& surface_a, const FeaturePiece& piece_a,
                                const Surface& surface_b, const FeaturePiece& piece_b, DecisionCount& count) {
  const auto averaged = [&](const Surface& surface,
                            const FeaturePiece& piece) -> std::optional<Eigen::Vector3d> {
    const Eigen::Vector3d sum = weighted_normal(surface, piece, count);
    if (sum.norm() < 0x1p-40) return std::nullopt;
    return sum.normalized();
  };
  const auto is_face = [](const FeaturePiece& piece) { return piece.feature.kind == FeatureKind::face; };
  if (is_face(piece_a))
    if (const auto normal = face_normal(surface_a, piece_a, count)) return *normal;
  if (is_face(piece_b))
    if (const auto normal = face_normal(surface_b, piece_b, count)) return -*normal;
  if (piece_a.feature.kind == FeatureKind::edge && piece_b.feature.kind == FeatureKind::edge) {
    const Simplex a = simplex_of(surface_a, piece_a);
    const Simplex b = simplex_of(surface_b, piece_b);
    const auto across = unit_direction(count, [&]<typename Number>() {
      return cross(difference<Number>(a.point[1], a.point[0]), difference<Number>(b.point[1], b.point[0]));
    });
    if (across) {
      const Eigen::Vector3d ends = weighted_normal(surface_a, vertex_piece(a.vertex[0]), count) +
                                   weighted_normal(surface_a, vertex_piece(a.vertex[1]), count);
      return across->dot(ends) < 0 ? Eigen::Vector3d(-*across) : *across;
    }
  }
  if (const auto normal = averaged(surface_a, piece_a)) return *normal;
  if (const auto normal = averaged(surface_b, piece_b)) return -*normal;
  return Eigen::Vector3d::UnitZ();
}

}  // namespace graze
