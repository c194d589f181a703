#include <algorithm>
#include <tuple>
#include <utility>

#include "support/oracle/oracle_features.hpp"

namespace graze::oracle {

namespace {

constexpr std::size_t leaf_capacity = 30;
constexpr std::uint32_t deepest_level = 40;

/// Builds the octree of one rest shape.
class Octree {
 public:
  explicit Octree(const Shape& rest) : rest_(rest), exact_(rest) {
    const Extent root = extent_of(rest, exact_.used);
    offsets_.resize(rest.positions.size());
    for (const std::uint32_t vertex : exact_.used)
      offsets_[vertex] = exact(rest.positions[vertex] - root.min);
    divide(0, exact_.used, Point{0, 0, 0}, exact(root.max - root.min));
  }

  std::vector<OracleRegion> regions() && {
    std::sort(regions_.begin(), regions_.end(), [](const OracleRegion& p, const OracleRegion& q) {
      return std::tie(p.level, p.vertices) < std::tie(q.level, q.vertices);
    });
    return std::move(regions_);
  }

 private:
  void divide(std::uint32_t level, const std::vector<std::uint32_t>& vertices, const Point& low,
              const Point& extent) {
    const bool leaf =
        vertices.size() <= leaf_capacity || level == deepest_level || all_in_one_point(vertices);
    regions_.push_back({level, leaf, middle_of(vertices), vertices});
    if (leaf) return;
    const Point half = Rational(1, 2) * extent;
    const Point centre = low + half;
    std::array<std::vector<std::uint32_t>, 8> parts;
    for (const std::uint32_t vertex : vertices) parts[octant(offsets_[vertex], centre)].push_back(vertex);
    for (std::size_t i = 0; i < 8; ++i) {
      if (parts[i].empty()) continue;
      const Point corner{i & 1U ? centre.x : low.x, i & 2U ? centre.y : low.y, i & 4U ? centre.z : low.z};
      divide(level + 1, parts[i], corner, half);
    }
  }

  static std::size_t octant(const Point& point, const Point& centre) {
    return (point.x >= centre.x ? 1U : 0U) + (point.y >= centre.y ? 2U : 0U) +
           (point.z >= centre.z ? 4U : 0U);
  }

  [[nodiscard]] bool all_in_one_point(const std::vector<std::uint32_t>& vertices) const {
    return std::all_of(vertices.begin(), vertices.end(), [&](std::uint32_t vertex) {
      return rest_.positions[vertex] == rest_.positions[vertices[0]];
    });
  }

  [[nodiscard]] std::uint32_t middle_of(const std::vector<std::uint32_t>& vertices) const {
    Point sum{0, 0, 0};
    for (const std::uint32_t vertex : vertices) sum = sum + exact_.points[vertex];
    const Point average = Rational(1, static_cast<unsigned long>(vertices.size())) * sum;
    std::uint32_t middle = vertices[0];
    Rational best = squared_length(exact_.points[middle] - average);
    for (const std::uint32_t vertex : vertices) {
      const Rational candidate = squared_length(exact_.points[vertex] - average);
      if (candidate >= best) continue;
      best = candidate;
      middle = vertex;
    }
    return middle;
  }

  const Shape& rest_;
  ExactShape exact_;
  std::vector<Point> offsets_;
  std::vector<OracleRegion> regions_;
};

std::vector<std::vector<std::uint32_t>> leaves_of(const Shape& rest) {
  std::vector<std::vector<std::uint32_t>> leaves;
  for (OracleRegion& region : regions_of(rest))
    if (region.leaf) leaves.push_back(std::move(region.vertices));
  return leaves;
}

/// The closest vertex pair within the limit, ties to the lowest a, then b. `a` and `b` are ascending.
void add_nearest(const ExactShape& shape_a, const std::vector<std::uint32_t>& a, const ExactShape& shape_b,
                 const std::vector<std::uint32_t>& b, const Limit& limit, const FacePairs& pairs,
                 ExactContacts& contacts) {
  std::optional<std::pair<Name, ExactContact>> nearest;
  for (const std::uint32_t i : a) {
    for (const std::uint32_t j : b) {
      if (limit.certainly_excludes(shape_a.point_extents[i], shape_b.point_extents[j])) continue;
      if (!pairs.may_vertices(i, j)) continue;
      Rational candidate = squared_length(shape_a.points[i] - shape_b.points[j]);
      if (!limit.admits(candidate) || (nearest && candidate >= nearest->second.distance_squared)) continue;
      nearest.emplace(name_of({FeatureKind::vertex, i}, {FeatureKind::vertex, j}),
                      ExactContact{std::move(candidate), shape_a.points[i], shape_b.points[j], false});
    }
  }
  if (nearest) contacts.insert(std::move(*nearest));
}

}  // namespace

std::vector<OracleRegion> regions_of(const Shape& rest) {
  return Octree(rest).regions();
}

double radius(const OracleRegion& region, const std::vector<Eigen::Vector3d>& positions) {
  const Point middle = exact(positions[region.middle]);
  Rational largest = 0;
  for (const std::uint32_t vertex : region.vertices)
    largest = std::max(largest, squared_length(exact(positions[vertex]) - middle));
  return round_sqrt(largest);
}

std::vector<double> level_radii(const std::vector<OracleRegion>& tree,
                                const std::vector<Eigen::Vector3d>& positions) {
  std::vector<double> radii;
  for (const OracleRegion& region : tree) {
    if (region.level >= radii.size()) radii.resize(region.level + 1);
    radii[region.level] = std::max(radii[region.level], radius(region, positions));
  }
  return radii;
}

std::vector<Named> regions(const Shape& shape_a, const Shape& shape_b, double threshold, const Shape& rest_a,
                           const Shape& rest_b, const FacePairs& pairs) {
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  const Limit limit = Limit::below(threshold);
  const auto leaves_b = leaves_of(rest_b);
  ExactContacts contacts;
  for (const auto& leaf_a : leaves_of(rest_a)) {
    for (const auto& leaf_b : leaves_b) {
      if (limit.certainly_excludes(extent_of(shape_a, leaf_a), extent_of(shape_b, leaf_b))) continue;
      add_nearest(a, leaf_a, b, leaf_b, limit, pairs, contacts);
    }
  }
  return rounded(contacts);
}

std::vector<Named> vertices(const Shape& shape_a, const Shape& shape_b, double threshold,
                            const FacePairs& pairs) {
  const ExactShape a(shape_a);
  const ExactShape b(shape_b);
  const Limit limit = Limit::below(threshold);
  ExactContacts contacts;
  for (const std::uint32_t i : a.used)
    for (const std::uint32_t j : b.used) add_nearest(a, {i}, b, {j}, limit, pairs, contacts);
  return rounded(contacts);
}

}  // namespace graze::oracle
