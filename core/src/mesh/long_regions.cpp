#include "core/mesh/long_regions.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>

#include "core/base/bytes_of.hpp"
#include "core/mesh/indexed_mesh.hpp"

namespace graze {
namespace {

/// A leaf is long if it is this many times as long as it is wide.
constexpr double least_length = 4;
/// A mesh with fewer long leaves counts as having none: the axes of space serve those as well.
constexpr std::size_t least_count = 8;

/// The corners that give the axes of a leaf, and how long the leaf is along the first of these.
struct Lengthwise {
  std::array<std::uint32_t, 3> corners{};
  double length = 0;
};

/// The longest of the sides of the faces and edges that a leaf owns.
Lengthwise longest_side(const IndexedMesh& mesh, const Region& leaf) {
  Lengthwise longest;
  const auto take = [&](std::uint32_t first, std::uint32_t second) {
    const double length = (mesh.rest()[second] - mesh.rest()[first]).norm();
    if (length > longest.length) longest = {{first, second, first}, length};
  };
  for (const std::uint32_t edge : mesh.regions().edges(leaf)) take(mesh.edge(edge)[0], mesh.edge(edge)[1]);
  for (const std::uint32_t face : mesh.regions().faces(leaf)) {
    const auto corner = mesh.face(face);
    for (std::size_t i = 0; i < corner.size(); ++i) take(corner[i], corner[(i + 1) % corner.size()]);
  }
  return longest;
}

template <typename Visit>
void visit_corners(const IndexedMesh& mesh, const Region& leaf, const Visit& visit) {
  for (const auto& list : {mesh.regions().vertices(leaf), mesh.regions().border(leaf)})
    for (const std::uint32_t vertex : list) visit(vertex, mesh.rest()[vertex]);
}

/// The axes of a leaf, if it is long along the longest side of its faces.
std::optional<Lengthwise> axes_if_long(const IndexedMesh& mesh, const Region& leaf) {
  Lengthwise axes = longest_side(mesh, leaf);
  if (!(axes.length > 0)) return std::nullopt;
  const Eigen::Vector3d from = mesh.rest()[axes.corners[0]];
  const Eigen::Vector3d along = (mesh.rest()[axes.corners[1]] - from) / axes.length;
  double low = 0;
  double high = 0;
  double furthest = 0;
  Eigen::Vector3d least = Eigen::Vector3d::Zero();
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  visit_corners(mesh, leaf, [&](std::uint32_t vertex, const Eigen::Vector3d& point) {
    const double height = along.dot(point - from);
    const Eigen::Vector3d beside = (point - from) - height * along;
    low = std::min(low, height);
    high = std::max(high, height);
    least = least.cwiseMin(beside);
    most = most.cwiseMax(beside);
    if (const double distance = beside.squaredNorm(); distance > furthest) {
      furthest = distance;
      axes.corners[2] = vertex;
    }
  });
  axes.length = high - low;
  if (axes.length > least_length * (most - least).maxCoeff()) return axes;
  return std::nullopt;
}

}  // namespace

LongRegions::LongRegions(const IndexedMesh& mesh) {
  const auto regions = mesh.regions().regions();
  std::vector<Lengthwise> longest(regions.size());
  std::size_t leaves = 0;
  for (std::size_t index = 0; index < regions.size(); ++index) {
    // A leaf without a face may be as narrow as one edge, whatever the mesh is like.
    if (!regions[index].is_leaf() || regions[index].face_count == 0) continue;
    const std::optional<Lengthwise> axes = axes_if_long(mesh, regions[index]);
    if (!axes) continue;
    ++leaves;
    longest[index] = *axes;
  }
  if (leaves < least_count) return;
  index_of_.assign(regions.size(), none);
  for (std::size_t index = regions.size(); index-- > 0;) {
    const Lengthwise& axes = longest[index];
    if (!(axes.length > 0)) continue;
    index_of_[index] = static_cast<std::uint32_t>(all_.size());
    all_.push_back({static_cast<std::uint32_t>(index), axes.corners});
    if (index == 0) continue;
    Lengthwise& parent = longest[regions[index].parent];
    if (axes.length > parent.length) parent = axes;
  }
  all_.shrink_to_fit();
}

std::size_t LongRegions::byte_count() const {
  return bytes_of(all_) + bytes_of(index_of_);
}

}  // namespace graze
