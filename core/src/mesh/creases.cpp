#include "mesh/creases.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "arithmetic/arithmetic.hpp"
#include "core/mesh/indexed_mesh.hpp"

namespace graze {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

/// The triangle of a face that has an edge, in the sense of the face. Nothing where its corners are not three
/// vertices.
std::optional<Triangle> triangle_at(const IndexedMesh& mesh, std::uint32_t face, std::uint32_t edge) {
  const auto corner = mesh.face(face);
  const auto ends = mesh.edge(edge);
  for (std::size_t last = 2; last < corner.size(); ++last) {
    const std::array<std::uint32_t, 3> triangle{corner[0], corner[last - 1], corner[last]};
    const auto is_end = [&](std::uint32_t vertex) { return vertex == ends[0] || vertex == ends[1]; };
    const bool has_both = std::find(triangle.begin(), triangle.end(), ends[0]) != triangle.end() &&
                          std::find(triangle.begin(), triangle.end(), ends[1]) != triangle.end();
    if (has_both && std::count_if(triangle.begin(), triangle.end(), is_end) == 2)
      return Triangle{mesh.rest()[triangle[0]], mesh.rest()[triangle[1]], mesh.rest()[triangle[2]]};
  }
  return std::nullopt;
}

/// Whether the normals of two triangles differ by more than the angle of a crease, in plain double. Nothing
/// where that is not certain.
std::optional<bool> certainly_bends(const Triangle& left, const Triangle& right) {
  const auto sides = [](const Triangle& triangle) {
    return std::array<Eigen::Vector3d, 2>{triangle[1] - triangle[0], triangle[2] - triangle[0]};
  };
  const auto [u, v] = sides(left);
  const auto [s, t] = sides(right);
  const Eigen::Vector3d n = u.cross(v);
  const Eigen::Vector3d m = s.cross(t);
  const double along = n.dot(m);
  // Each product of four sides is wrong by some 30 roundings at most, relative to their lengths.
  const double lengths = u.norm() * v.norm() * s.norm() * t.norm();
  if (!(lengths < 0x1p400)) return std::nullopt;
  if (along < -lengths * 0x1p-46 - 0x1p-400) return true;
  const double rest = 128 * along * along - 127 * n.squaredNorm() * m.squaredNorm();
  const double error = lengths * lengths * 0x1p-38 + 0x1p-400;
  if (along > lengths * 0x1p-46 + 0x1p-400 && rest > error) return false;
  return rest < -error ? std::optional(true) : std::nullopt;
}

bool bends(const Triangle& left, const Triangle& right) {
  if (const auto certainly = certainly_bends(left, right)) return *certainly;
  DecisionCount count;
  const auto with_normals = [&](const auto& value) {
    return decide_sign(count, [&]<typename Number>() {
      const auto normal_of = [](const Triangle& triangle) { return normal_of_corners<Number>(triangle); };
      return value(normal_of(left), normal_of(right));
    });
  };
  const auto along = [](const auto& n, const auto& m) { return dot(n, m); };
  if (with_normals(along) < 0) return true;
  return with_normals([&](const auto& n, const auto& m) {
           const auto product = dot(n, m);
           return product * product * 128.0 - dot(n, n) * dot(m, m) * 127.0;
         }) < 0;
}

bool is_crease(const IndexedMesh& mesh, std::uint32_t edge) {
  const auto faces = mesh.edge_faces(edge);
  return faces.size() != 2 || is_crease_between(mesh, edge, {faces[0], faces[1]});
}

}  // namespace

bool is_crease_between(const IndexedMesh& mesh, std::uint32_t edge,
                       const std::array<std::uint32_t, 2>& faces) {
  const auto left = triangle_at(mesh, faces[0], edge);
  const auto right = triangle_at(mesh, faces[1], edge);
  return left && right && bends(*left, *right);
}

std::vector<bool> find_creases(const IndexedMesh& mesh) {
  std::vector<bool> creases(mesh.edge_count());
  for (std::uint32_t edge = 0; edge < mesh.edge_count(); ++edge) creases[edge] = is_crease(mesh, edge);
  return creases;
}

}  // namespace graze
