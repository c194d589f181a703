#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <stdexcept>
#include <tuple>

#include "models/surface_net.hpp"

namespace graze::models {

namespace {

using Vertex = std::uint32_t;
using Corners = std::array<Vertex, 3>;

constexpr Vertex nobody = std::numeric_limits<Vertex>::max();

/// A closed triangle mesh that can lose vertices.
class Thinner {
 public:
  Thinner(const TriangleMesh& mesh, const Field& field, const Field& size)
      : positions_(mesh.positions),
        triangles_(mesh.triangles),
        triangles_of_(mesh.positions.size()),
        field_(field),
        size_(size),
        vertex_count_(mesh.positions.size()) {
    for (std::size_t i = 0; i < triangles_.size(); ++i)
      for (const Vertex corner : triangles_[i]) triangles_of_[corner].push_back(i);
  }

  void collapse_to(std::size_t vertex_count) {
    Queue queue;
    for (Vertex v = 0; v < positions_.size(); ++v) push_edges(queue, v);
    while (vertex_count_ > vertex_count) {
      if (queue.empty()) throw std::logic_error("thinned: no edge is left that can be collapsed");
      const auto [cost, u, v] = queue.top();
      queue.pop();
      if (!are_neighbours(u, v) || cost != cost_of(u, v) || !collapse(u, v)) continue;
      push_edges(queue, u);
      for (const Vertex neighbour : neighbours(u)) push_edges(queue, neighbour);
    }
  }

  void even_out(int rounds) {
    for (int round = 0; round < rounds; ++round) {
      flip_edges();
      for (Vertex v = 0; v < positions_.size(); ++v)
        if (!triangles_of_[v].empty()) relax(v);
    }
  }

  [[nodiscard]] TriangleMesh result() const {
    TriangleMesh mesh;
    std::vector<Vertex> number(positions_.size());
    for (Vertex v = 0; v < positions_.size(); ++v) {
      if (triangles_of_[v].empty()) continue;
      number[v] = static_cast<Vertex>(mesh.positions.size());
      mesh.positions.push_back(positions_[v]);
    }
    for (const Corners& corners : triangles_) {
      if (corners[0] != corners[1])
        mesh.triangles.push_back({number[corners[0]], number[corners[1]], number[corners[2]]});
    }
    return mesh;
  }

 private:
  using Queue = std::priority_queue<std::tuple<double, Vertex, Vertex>,
                                    std::vector<std::tuple<double, Vertex, Vertex>>, std::greater<>>;

  static bool has(const Corners& corners, Vertex v) {
    return std::find(corners.begin(), corners.end(), v) != corners.end();
  }

  [[nodiscard]] std::vector<Vertex> neighbours(Vertex v) const {
    std::vector<Vertex> result;
    for (const std::size_t triangle : triangles_of_[v])
      for (const Vertex corner : triangles_[triangle])
        if (corner != v) result.push_back(corner);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  [[nodiscard]] bool are_neighbours(Vertex u, Vertex v) const {
    return std::any_of(triangles_of_[u].begin(), triangles_of_[u].end(),
                       [&](std::size_t triangle) { return has(triangles_[triangle], v); });
  }

  [[nodiscard]] double cost_of(Vertex u, Vertex v) const {
    const Eigen::Vector3d middle = (positions_[u] + positions_[v]) / 2;
    return (positions_[u] - positions_[v]).norm() / size_(middle);
  }

  void push_edges(Queue& queue, Vertex v) const {
    for (const Vertex neighbour : neighbours(v)) {
      const Vertex low = std::min(v, neighbour);
      const Vertex high = std::max(v, neighbour);
      queue.emplace(cost_of(low, high), low, high);
    }
  }

  [[nodiscard]] Eigen::Vector3d normal(const Corners& corners) const {
    const Eigen::Vector3d& origin = positions_[corners[0]];
    return (positions_[corners[1]] - origin).cross(positions_[corners[2]] - origin);
  }

  /// Whether the triangles of `v` that do not have `other` keep facing their way with `v` moved to `place`.
  [[nodiscard]] bool keeps_facing(Vertex v, Vertex other, const Eigen::Vector3d& place) const {
    for (const std::size_t triangle : triangles_of_[v]) {
      const Corners& corners = triangles_[triangle];
      if (has(corners, other)) continue;
      std::array<Eigen::Vector3d, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = corners[i] == v ? place : positions_[corners[i]];
      const Eigen::Vector3d before = normal(corners).normalized();
      const Eigen::Vector3d after = (p[1] - p[0]).cross(p[2] - p[0]).normalized();
      if (before.dot(after) < 0.3) return false;
    }
    return true;
  }

  /// Joins v to u in their middle, if the surface stays a manifold and no triangle turns over.
  bool collapse(Vertex u, Vertex v) {
    const std::vector<Vertex> around_u = neighbours(u);
    const std::vector<Vertex> around_v = neighbours(v);
    std::vector<Vertex> common;
    std::set_intersection(around_u.begin(), around_u.end(), around_v.begin(), around_v.end(),
                          std::back_inserter(common));
    if (common.size() != 2 || around_u.size() + around_v.size() > 12) return false;
    for (const Vertex shared : common)
      if (triangles_of_[shared].size() < 5) return false;
    const Eigen::Vector3d place = on_surface(field_, (positions_[u] + positions_[v]) / 2);
    if (!keeps_facing(u, v, place) || !keeps_facing(v, u, place)) return false;

    const std::vector<std::size_t> of_v = triangles_of_[v];
    for (const std::size_t triangle : of_v) {
      Corners& corners = triangles_[triangle];
      if (has(corners, u)) {
        for (const Vertex corner : Corners(corners)) std::erase(triangles_of_[corner], triangle);
        corners = {u, u, u};
      } else {
        std::replace(corners.begin(), corners.end(), v, u);
        triangles_of_[u].push_back(triangle);
      }
    }
    triangles_of_[v].clear();
    positions_[u] = place;
    --vertex_count_;
    return true;
  }

  void flip_edges() {
    for (Vertex u = 0; u < positions_.size(); ++u) {
      for (const Vertex v : neighbours(u))
        if (u < v && are_neighbours(u, v)) flip(u, v);
    }
  }

  /// The triangle in which `to` follows `from`, and its third corner.
  [[nodiscard]] std::pair<std::size_t, Vertex> left_of(Vertex from, Vertex to) const {
    for (const std::size_t triangle : triangles_of_[from]) {
      const Corners& corners = triangles_[triangle];
      for (std::size_t i = 0; i < 3; ++i)
        if (corners[i] == from && corners[(i + 1) % 3] == to) return {triangle, corners[(i + 2) % 3]};
    }
    throw std::logic_error("thinned: the mesh is not closed");
  }

  /// The cosine and sine, up to one factor, of the angle at `corner`.
  [[nodiscard]] Eigen::Vector2d angle(Vertex corner, Vertex p, Vertex q) const {
    const Eigen::Vector3d to_p = (positions_[p] - positions_[corner]).normalized();
    const Eigen::Vector3d to_q = (positions_[q] - positions_[corner]).normalized();
    return {to_p.dot(to_q), to_p.cross(to_q).norm()};
  }

  /// Replaces the edge u-v by the other diagonal where the angles against it add up to more than half a turn.
  void flip(Vertex u, Vertex v) {
    const auto [left, p] = left_of(u, v);
    const auto [right, q] = left_of(v, u);
    if (p == q || are_neighbours(p, q) || triangles_of_[u].size() < 5 || triangles_of_[v].size() < 5) return;
    const Eigen::Vector2d at_p = angle(p, u, v);
    const Eigen::Vector2d at_q = angle(q, u, v);
    if (at_p.x() * at_q.y() + at_q.x() * at_p.y() > -1e-9) return;
    const Eigen::Vector3d facing =
        normal(triangles_[left]).normalized() + normal(triangles_[right]).normalized();
    const Corners first{u, q, p};
    const Corners second{q, v, p};
    if (facing.norm() < 1.6 || normal(first).dot(facing) <= 0 || normal(second).dot(facing) <= 0) return;
    triangles_[left] = first;
    triangles_[right] = second;
    std::erase(triangles_of_[v], left);
    std::erase(triangles_of_[u], right);
    triangles_of_[q].push_back(left);
    triangles_of_[p].push_back(right);
  }

  /// Moves a vertex along the surface towards the middle of its neighbours.
  void relax(Vertex v) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const Vertex neighbour : neighbours(v)) {
      const double weight = 1 / size_(positions_[neighbour]);
      sum += weight * positions_[neighbour];
      weights += weight;
    }
    const Eigen::Vector3d outward = normal_at(field_, positions_[v]);
    Eigen::Vector3d step = 0.5 * (sum / weights - positions_[v]);
    step -= step.dot(outward) * outward;
    const Eigen::Vector3d place = on_surface(field_, positions_[v] + step);
    if (keeps_facing(v, nobody, place)) positions_[v] = place;
  }

  std::vector<Eigen::Vector3d> positions_;
  std::vector<Corners> triangles_;  ///< {u, u, u} once it is gone
  std::vector<std::vector<std::size_t>> triangles_of_;
  const Field& field_;
  const Field& size_;
  std::size_t vertex_count_;
};

}  // namespace

TriangleMesh thinned(const TriangleMesh& mesh, const Field& field, const Field& size,
                     std::size_t vertex_count) {
  Thinner thinner(mesh, field, size);
  thinner.even_out(3);
  thinner.collapse_to(vertex_count);
  thinner.even_out(12);
  return thinner.result();
}

}  // namespace graze::models
