#include "walk/validate_front.hpp"

#ifdef GRAZE_VALIDATE
#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "core/base/require.hpp"
#include "core/pair/leaf_front.hpp"
#include "core/surface/surface.hpp"
#include "pair/bounds.hpp"

namespace graze {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// The present positions of some vertices, each once.
Points points_of(const Surface& surface, std::vector<std::uint32_t> vertices) {
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  Points points;
  for (const std::uint32_t vertex : vertices) points.push_back(surface.position(vertex));
  return points;
}

/// The features that a leaf owns, by their corners.
struct CornersOf {
  Points vertices;
  Points faces;
  Points edges;

  CornersOf(const Surface& surface, const Region& leaf) {
    const IndexedMesh& mesh = surface.mesh();
    const RegionTree& tree = mesh.regions();
    const auto members = tree.vertices(leaf);
    std::vector<std::uint32_t> of_faces;
    for (const std::uint32_t face : tree.faces(leaf))
      for (const std::uint32_t corner : mesh.face(face)) of_faces.push_back(corner);
    std::vector<std::uint32_t> of_edges;
    for (const std::uint32_t edge : tree.edges(leaf))
      for (const std::uint32_t end : mesh.edge(edge)) of_edges.push_back(end);
    vertices = points_of(surface, {members.begin(), members.end()});
    faces = points_of(surface, std::move(of_faces));
    edges = points_of(surface, std::move(of_edges));
  }
};

void require_apart(const Points& a, const Points& b, double lower, const char* what, std::size_t index) {
  for (const Eigen::Vector3d& point_a : a)
    for (const Eigen::Vector3d& point_b : b) require(upper_distance(point_a, point_b) >= lower, what, index);
}

void require_apart(const CornersOf& a, const CornersOf& b, double lower, const char* what,
                   std::size_t index) {
  for (const Points* const of_a : {&a.vertices, &a.faces, &a.edges})
    for (const Points* const of_b : {&b.vertices, &b.faces, &b.edges})
      require_apart(*of_a, *of_b, lower, what, index);
}

/// Checks each vertex with each face and each two edges. Two corners that neither leaf owns belong to another
/// pair of leaves, which is tested itself.
void require_features_apart(const CornersOf& a, const CornersOf& b, double lower, const char* what,
                            std::size_t index) {
  require_apart(a.vertices, b.faces, lower, what, index);
  require_apart(a.faces, b.vertices, lower, what, index);
  require_apart(a.edges, b.edges, lower, what, index);
}

double lower_now(const Surface& a, const Region& leaf_a, const Surface& b, const Region& leaf_b) {
  return lower_distance(a.box_now(leaf_a, RefitOf::faces), b.box_now(leaf_b, RefitOf::faces));
}

void validate_listed(const ListedLeaves& listed, const LeafFront& front, const Surface& a, const Surface& b) {
  const Region& leaf_a = a.mesh().regions().region(listed.pair.a);
  const Region& leaf_b = b.mesh().regions().region(listed.pair.b);
  const double motion = front.motion_now(a, b);
  const double lower = static_cast<double>(listed.lower) - motion;
  const double feature_lower_bound = static_cast<double>(front.apart) > motion
                                         ? static_cast<double>(listed.feature_lower_bound) - motion
                                         : 0;
  if (lower_now(a, leaf_a, b, leaf_b) >= std::max(lower, feature_lower_bound)) return;
  const CornersOf of_a(a, leaf_a);
  const CornersOf of_b(b, leaf_b);
  require_apart(of_a, of_b, lower, "listed leaves are nearer than their bound", listed.pair.a);
  require_features_apart(of_a, of_b, feature_lower_bound, "listed leaves are nearer than looks said",
                         listed.pair.a);
}

}  // namespace

/// Uses the leaves' own points where boxes do not decide it. A front may be made by boxes of an earlier
/// refit, and neither those nor the present boxes always give the greater bound.
void validate(const LeafFront& front, const Surface& a, const Surface& b) {
  const auto regions_a = a.mesh().regions().regions();
  const auto regions_b = b.mesh().regions().regions();
  const double unlisted_lower_bound = front.unlisted_lower_bound_now(a, b);
  if (!(unlisted_lower_bound > 0) || regions_a.size() * regions_b.size() > 4096) return;
  std::set<std::pair<std::uint32_t, std::uint32_t>> listed;
  for (const ListedLeaves& leaves : front.leaves) {
    listed.insert({leaves.pair.a, leaves.pair.b});
    validate_listed(leaves, front, a, b);
  }
  for (std::uint32_t i = 0; i < regions_a.size(); ++i)
    for (std::uint32_t j = 0; j < regions_b.size(); ++j) {
      if (!regions_a[i].is_leaf() || !regions_b[j].is_leaf() || listed.contains({i, j})) continue;
      if (lower_now(a, regions_a[i], b, regions_b[j]) >= unlisted_lower_bound) continue;
      require_apart(CornersOf(a, regions_a[i]), CornersOf(b, regions_b[j]), unlisted_lower_bound,
                    "a front misses leaves", i);
    }
}

}  // namespace graze
#else
namespace graze {
void validate(const LeafFront& /*front*/, const Surface& /*a*/, const Surface& /*b*/) {}
}  // namespace graze
#endif
