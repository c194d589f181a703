#include "bench/near_pairs.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

namespace graze::bench {
namespace {

using Point = Eigen::Vector3d;

struct Segment {
  Point from;
  Point along;
};

struct TriangleEdge {
  std::uint32_t edge;
  Segment segment;
};

double clamped(double value) {
  return std::clamp(value, 0.0, 1.0);
}

double squared_distance(const Point& point, const Segment& segment) {
  const double length = segment.along.squaredNorm();
  const double part = length > 0 ? clamped((point - segment.from).dot(segment.along) / length) : 0;
  return (segment.from + part * segment.along - point).squaredNorm();
}

/// Returns the squared distance of two segments. It is that of their lines if these are nearest inside both
/// segments, and otherwise that of an end of one segment to the other.
double squared_distance(const Segment& a, const Segment& b) {
  double least = std::min({squared_distance(a.from, b), squared_distance(a.from + a.along, b),
                           squared_distance(b.from, a), squared_distance(b.from + b.along, a)});
  const Point across = a.along.cross(b.along);
  const double area = across.squaredNorm();
  if (!(area > 0)) return least;
  const Point between = b.from - a.from;
  const double at_a = between.cross(b.along).dot(across) / area;
  const double at_b = between.cross(a.along).dot(across) / area;
  if (at_a >= 0 && at_a <= 1 && at_b >= 0 && at_b <= 1) {
    const double height = between.dot(across);
    least = std::min(least, height * height / area);
  }
  return least;
}

/// A triangle with what of its vertices and edges no earlier triangle has.
class PlacedTriangle {
 public:
  PlacedTriangle(const PlacedMesh& placed, std::uint32_t triangle) {
    const auto corners = placed.mesh.face(triangle);
    const auto edges = placed.mesh.face_edges(triangle);
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      corners_[i] = position(placed, corners[i]);
      owns_corner_[i] = placed.mesh.vertex_faces(corners[i]).front() == triangle;
    }
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Point& next = corners_[(i + 1) % corners_.size()];
      edges_[i] = {corners_[i], next - corners_[i]};
      owns_edge_[i] = edges[i] != Mesh::no_edge && placed.mesh.edge_faces(edges[i]).front() == triangle;
    }
  }

  [[nodiscard]] double squared_distance_to(const Point& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Segment& edge : edges_) least = std::min(least, squared_distance(point, edge));
    const Point normal = edges_[0].along.cross(edges_[1].along);
    const double area = normal.squaredNorm();
    const bool is_over = area > 0 && std::all_of(edges_.begin(), edges_.end(), [&](const Segment& edge) {
                           return normal.cross(edge.along).dot(point - edge.from) >= 0;
                         });
    if (!is_over) return least;
    const double height = normal.dot(point - corners_[0]);
    return std::min(least, height * height / area);
  }

  /// How many of its own vertices are near another triangle.
  [[nodiscard]] std::size_t vertices_near(const PlacedTriangle& other, double limit) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i)
      if (owns_corner_[i] && other.squared_distance_to(corners_[i]) < limit) ++count;
    return count;
  }
  /// How many of its own edges are near each of another's own.
  [[nodiscard]] std::size_t edges_near(const PlacedTriangle& other, double limit) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      for (std::size_t j = 0; owns_edge_[i] && j < edges_.size(); ++j)
        if (other.owns_edge_[j] && squared_distance(edges_[i], other.edges_[j]) < limit) ++count;
    return count;
  }

 private:
  static Point position(const PlacedMesh& placed, std::uint32_t vertex) {
    return Eigen::Map<const Eigen::Vector3f>(placed.positions + std::size_t{3} * vertex).cast<double>();
  }

  std::array<Point, 3> corners_;
  std::array<Segment, 3> edges_;
  std::array<bool, 3> owns_corner_{};
  std::array<bool, 3> owns_edge_{};
};

}  // namespace

/// A vertex or edge is no further from anything than all triangles that have it, so that those of the first
/// ones are enough.
std::size_t count_near_pairs(const PlacedMesh& a, const PlacedMesh& b, std::span<const TrianglePair> near,
                             double distance) {
  const double limit = distance * distance;
  std::size_t count = 0;
  for (const TrianglePair& pair : near) {
    const PlacedTriangle of_a(a, pair.triangle_a);
    const PlacedTriangle of_b(b, pair.triangle_b);
    count += of_a.vertices_near(of_b, limit) + of_b.vertices_near(of_a, limit) + of_a.edges_near(of_b, limit);
  }
  return count;
}

}  // namespace graze::bench
