#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/peers/rigid_bodies/convex_hull.hpp"
#include "bench/peers/rigid_bodies/placed_hull.hpp"
#include "bench/peers/rigid_bodies/rigid_finders.hpp"
#include "bench/peers/rigid_bodies/separating_axes.hpp"

namespace graze::bench {
namespace {

using Eigen::Vector3d;
/// A corner of a clipped polygon. Its number is the same as long as the same planes make it.
struct Corner {
  Vector3d point;
  std::uint64_t number = 0;
};
using Polygon = std::vector<Corner>;

constexpr double face_preference = 5e-4;  // m: edges have to separate by so much more than faces

/// Cuts away what is in front of a plane. What it adds where it enters the polygon has the number `plane`,
/// and where it leaves it one more.
void clip(Polygon& polygon, const Vector3d& normal, double offset, std::uint64_t plane, Polygon& clipped) {
  clipped.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner& from = polygon[i];
    const Corner& to = polygon[(i + 1) % polygon.size()];
    const double height_from = normal.dot(from.point) - offset;
    const double height_to = normal.dot(to.point) - offset;
    if (height_from <= 0) clipped.push_back(from);
    if (height_from * height_to < 0)
      clipped.push_back({from.point + height_from / (height_from - height_to) * (to.point - from.point),
                         height_from < 0 ? plane : plane + 1});
  }
  polygon.swap(clipped);
}

/// A number that tells contacts of two bodies apart, from a few small ones.
std::uint64_t key_of(std::initializer_list<std::uint64_t> numbers) {
  std::uint64_t key = 1;
  for (const std::uint64_t number : numbers) key = key << 12U | number;
  return key;
}

/// Finds contacts of two convex bodies by their best separating axis: the face of one that the other's face
/// is clipped to, or the nearest points of two edges.
class Clipper {
 public:
  Clipper(double distance, std::vector<RigidContact>& contacts) : distance_(distance), contacts_(contacts) {}

  void add(const PlacedHull& a, const PlacedHull& b) {
    const std::optional<SeparatingAxes> axes = separating_axes(a, b, distance_);
    if (!axes) return;
    const bool is_face_of_a = axes->a.separation + face_preference >= axes->b.separation;
    const double by_face = std::max(axes->a.separation, axes->b.separation);
    const std::size_t before = contacts_.size();
    if (axes->edges.separation <= by_face + face_preference) {
      if (is_face_of_a)
        add_faces(a, axes->a.face, b, false);
      else
        add_faces(b, axes->b.face, a, true);
    }
    const bool has_edges = std::isfinite(axes->edges.separation);
    if (contacts_.size() == before && has_edges) add_edges(axes->edges, a, b);
  }

 private:
  void add_faces(const PlacedHull& reference, std::uint32_t face, const PlacedHull& other, bool is_b) {
    const Vector3d normal = reference.normals[face];
    const std::uint32_t other_face = other.face_along(-normal);
    polygon_.clear();
    for (const std::uint32_t corner : other.hull->faces[other_face].corners)
      polygon_.push_back({other.points[corner], corner});
    const std::vector<std::uint32_t>& corners = reference.hull->faces[face].corners;
    for (std::size_t i = 0; i < corners.size() && !polygon_.empty(); ++i) {
      const Vector3d& from = reference.points[corners[i]];
      const Vector3d side = (reference.points[corners[(i + 1) % corners.size()]] - from).cross(normal);
      clip(polygon_, side, side.dot(from), 1024 + 2 * i, clipped_);
    }
    for (const auto& [point, number] : polygon_) {
      const double separation = normal.dot(point) - reference.offsets[face];
      if (separation >= distance_) continue;
      const Vector3d on_face = point - separation * normal;
      const std::uint64_t key = key_of({reference.part, other.part, face, other_face, number});
      if (is_b)
        add({other.body, reference.body, key, separation}, point, on_face, -normal);
      else
        add({reference.body, other.body, key, separation}, on_face, point, normal);
    }
  }

  void add_edges(const EdgeAxis& edges, const PlacedHull& a, const PlacedHull& b) {
    const Vector3d way = edges.point_b - edges.point_a;
    const Vector3d cross = edges.along_a.cross(edges.along_b);
    const double square = cross.squaredNorm();
    const Vector3d on_a = edges.point_a + way.cross(edges.along_b).dot(cross) / square * edges.along_a;
    const Vector3d on_b = edges.point_b + way.cross(edges.along_a).dot(cross) / square * edges.along_b;
    add({a.body, b.body, key_of({a.part, b.part}), edges.separation}, on_a, on_b, edges.normal);
  }

  struct Found {
    std::uint32_t a, b;
    std::uint64_t key;
    double separation;
  };
  void add(const Found& found, const Vector3d& on_a, const Vector3d& on_b, const Vector3d& push) {
    RigidContact& contact = contacts_.emplace_back();
    contact.a = found.a;
    contact.b = found.b;
    contact.key = found.key;
    contact.separation = found.separation;
    for (int i = 0; i < 3; ++i) {
      contact.on_a[i] = on_a[i];
      contact.on_b[i] = on_b[i];
      contact.push[i] = push[i];
    }
  }

  double distance_;
  std::vector<RigidContact>& contacts_;
  Polygon polygon_, clipped_;  ///< working memory
};

class ClippedFaces final : public RigidContactFinder {
 public:
  ClippedFaces(std::span<const RigidBodyView> bodies, double distance) : distance_(distance) {
    for (std::uint32_t body = 0; body < bodies.size(); ++body) {
      is_fixed_.push_back(bodies[body].is_fixed);
      const RigidShape& shape = *bodies[body].shape;
      std::vector<ConvexHull>& hulls = hulls_of(shape);
      for (const ConvexHull& hull : hulls) {
        PlacedHull& part = parts_.emplace_back();
        part.hull = &hull;
        part.body = body;
        part.part = static_cast<std::uint32_t>(&hull - hulls.data());
        part.half = Eigen::Map<const Vector3d>(shape.half);
      }
    }
    order_.resize(parts_.size());
    std::iota(order_.begin(), order_.end(), 0);
  }

  /// Sweeps the parts along x, in the order of the last step, which is nearly that of now.
  void find(std::span<const double> poses, std::vector<RigidContact>& contacts) override {
    contacts.clear();
    for (PlacedHull& part : parts_) {
      const double* const pose = poses.data() + std::size_t{12} * part.body;
      part.place(Eigen::Map<const Eigen::Matrix3d>(pose), Eigen::Map<const Vector3d>(pose + 9));
    }
    sort();
    Clipper clipper(distance_, contacts);
    for (std::size_t i = 0; i < order_.size(); ++i) {
      const PlacedHull& first = parts_[order_[i]];
      for (std::size_t j = i + 1; j < order_.size(); ++j) {
        const PlacedHull& second = parts_[order_[j]];
        if (second.low.x() > first.high.x() + distance_) break;
        if (!are_met(first, second)) continue;
        const bool is_ordered = first.body < second.body;
        clipper.add(is_ordered ? first : second, is_ordered ? second : first);
      }
    }
    std::ranges::stable_sort(contacts, {}, [](const RigidContact& c) { return std::pair(c.a, c.b); });
  }

 private:
  std::vector<ConvexHull>& hulls_of(const RigidShape& shape) {
    std::vector<ConvexHull>& hulls = hulls_[&shape];
    if (hulls.empty())
      for (const std::vector<double>& part : shape.parts) {
        std::vector<Vector3d> points;
        for (std::size_t i = 0; i < part.size(); i += 3)
          points.emplace_back(part[i], part[i + 1], part[i + 2]);
        hulls.push_back(hull_of(points));
      }
    return hulls;
  }
  void sort() {
    for (std::size_t i = 1; i < order_.size(); ++i)
      for (std::size_t j = i; j > 0 && parts_[order_[j]].low.x() < parts_[order_[j - 1]].low.x(); --j)
        std::swap(order_[j], order_[j - 1]);
  }
  [[nodiscard]] bool are_met(const PlacedHull& a, const PlacedHull& b) const {
    return a.body != b.body && !(is_fixed_[a.body] && is_fixed_[b.body]) && are_near(a, b, distance_);
  }

  double distance_;
  std::vector<bool> is_fixed_;                                  ///< of each body
  std::map<const RigidShape*, std::vector<ConvexHull>> hulls_;  ///< of the parts of each shape
  std::vector<PlacedHull> parts_;
  std::vector<std::size_t> order_;  ///< of parts, by the lower end along x
};

}  // namespace

std::unique_ptr<RigidContactFinder> make_clipped_faces(std::span<const RigidBodyView> bodies,
                                                       double contact_distance) {
  return std::make_unique<ClippedFaces>(bodies, contact_distance);
}

}  // namespace graze::bench
