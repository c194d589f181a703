#include "core/mesh/region_tree.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/box.hpp"
#include "core/base/bytes_of.hpp"
#include "core/mesh/indexed_mesh.hpp"
#include "mesh/feature_owners.hpp"
#include "mesh/middle_vertex.hpp"
#include "mesh/validate_tree.hpp"

namespace graze {
namespace {

class Builder {
 public:
  Builder(const IndexedMesh& mesh, std::vector<Region>& regions, std::vector<std::uint32_t>& vertices)
      : rest_(mesh.rest()), regions_(regions), vertices_(vertices) {
    Box box;
    for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); ++vertex)
      if (mesh.is_used(vertex)) {
        vertices_.push_back(vertex);
        box.add(rest_[vertex]);
      }
    size_ = box.max - box.min;
    offsets_.resize(rest_.size());
    for (const std::uint32_t vertex : vertices_) offsets_[vertex] = rest_[vertex] - box.min;
  }

  /// Appends the regions level by level and the index at which each level begins.
  void build(std::vector<std::uint32_t>& level_begin) {
    regions_.push_back({.vertex_count = static_cast<std::uint32_t>(vertices_.size())});
    level_begin.push_back(0);
    for (std::uint32_t begin = 0, end = 1; begin < end;) {
      for (std::uint32_t index = begin; index < end; ++index) subdivide(index);
      level_begin.push_back(end);
      begin = end;
      end = static_cast<std::uint32_t>(regions_.size());
    }
  }

 private:
  void subdivide(std::uint32_t index) {
    const Region region = regions_[index];
    if (region.vertex_count <= RegionTree::leaf_capacity || region.level == RegionTree::max_level ||
        coincide(region))
      return;
    const Eigen::Vector3d half = size_ * std::ldexp(1.0, -static_cast<int>(region.level) - 1);
    const std::array<std::uint32_t, 9> begin = sort_into_octants(region, half);
    regions_[index].first_child = static_cast<std::uint32_t>(regions_.size());
    for (std::size_t octant = 0; octant < 8; ++octant) {
      const std::uint32_t count = begin[octant + 1] - begin[octant];
      if (count == 0) continue;
      regions_.push_back(
          {.level = region.level + 1, .parent = index, .first_vertex = begin[octant], .vertex_count = count});
      ++regions_[index].child_count;
    }
  }

  [[nodiscard]] bool coincide(const Region& region) const {
    const auto members = std::span(vertices_).subspan(region.first_vertex, region.vertex_count);
    return std::all_of(members.begin(), members.end(),
                       [&](std::uint32_t vertex) { return rest_[vertex] == rest_[members.front()]; });
  }

  /// Sorts the region's vertices by octant, keeping their order within each, makes their offsets those within
  /// the octant, and returns where each octant begins.
  std::array<std::uint32_t, 9> sort_into_octants(const Region& region, const Eigen::Vector3d& half) {
    const auto members = std::span(vertices_).subspan(region.first_vertex, region.vertex_count);
    const auto octant_of = [&](std::uint32_t vertex) {
      std::size_t octant = 0;
      for (int axis = 0; axis < 3; ++axis)
        if (offsets_[vertex][axis] >= half[axis]) octant |= std::size_t{1} << axis;
      return octant;
    };
    std::array<std::uint32_t, 9> begin{};
    for (const std::uint32_t vertex : members) ++begin[octant_of(vertex) + 1];
    begin[0] = region.first_vertex;
    for (std::size_t octant = 0; octant < 8; ++octant) begin[octant + 1] += begin[octant];
    sorted_.assign(members.begin(), members.end());
    std::array<std::uint32_t, 9> next = begin;
    for (const std::uint32_t vertex : sorted_) {
      const std::size_t octant = octant_of(vertex);
      vertices_[next[octant]++] = vertex;
      for (int axis = 0; axis < 3; ++axis)
        if ((octant >> axis & 1U) != 0) offsets_[vertex][axis] -= half[axis];
    }
    return begin;
  }

  std::span<const Eigen::Vector3d> rest_;
  std::vector<Region>& regions_;
  std::vector<std::uint32_t>& vertices_;
  std::vector<std::uint32_t> sorted_;
  Eigen::Vector3d size_;  ///< of the root box
  /// The offset of each used vertex from the minimum of its region's box: from 0 to the box's size. So
  /// halving the size and taking half of it away do not round, and cuts are exact at every depth.
  std::vector<Eigen::Vector3d> offsets_;
};

/// The features of a mesh, sorted by the position of their owning vertex in the tree's vertex order. The
/// features at position i are order[begin[i], begin[i + 1]).
struct Owned {
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> begin;
};

template <typename OwnerOf>
Owned sort_by_owner(std::uint32_t feature_count, std::size_t position_count,
                    const OwnerOf& position_of_owner) {
  Owned owned;
  owned.begin.assign(position_count + 1, 0);
  for (std::uint32_t feature = 0; feature < feature_count; ++feature)
    ++owned.begin[position_of_owner(feature) + 1];
  std::partial_sum(owned.begin.begin(), owned.begin.end(), owned.begin.begin());
  owned.order.resize(feature_count);
  std::vector<std::uint32_t> next = owned.begin;
  for (std::uint32_t feature = 0; feature < feature_count; ++feature)
    owned.order[next[position_of_owner(feature)]++] = feature;
  return owned;
}

/// Leaves come by ascending level.
std::uint32_t median_leaf_level(std::span<const Region> regions) {
  std::uint64_t passed = 0;
  for (const Region& region : regions) {
    if (region.is_leaf()) passed += region.vertex_count;
    if (2 * passed >= regions.front().vertex_count) return region.level;
  }
  return 0;
}

}  // namespace

RegionTree::RegionTree(const IndexedMesh& mesh) {
  Builder(mesh, regions_, vertices_).build(level_begin_);
  leaf_level_ = median_leaf_level(regions_);

  std::vector<std::uint32_t> position(mesh.vertex_count());
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) position[vertices_[i]] = i;
  const FeatureOwners owners(mesh);
  Owned owned_faces = sort_by_owner(mesh.face_count(), vertices_.size(),
                                    [&](std::uint32_t face) { return position[owners.of_face(face)]; });
  Owned owned_edges = sort_by_owner(mesh.edge_count(), vertices_.size(),
                                    [&](std::uint32_t edge) { return position[owners.of_edge(edge)]; });
  for (Region& region : regions_) {
    const std::uint32_t end = region.first_vertex + region.vertex_count;
    region.first_face = owned_faces.begin[region.first_vertex];
    region.face_count = owned_faces.begin[end] - region.first_face;
    region.first_edge = owned_edges.begin[region.first_vertex];
    region.edge_count = owned_edges.begin[end] - region.first_edge;
    region.middle = middle_vertex(mesh.rest(), vertices(region));
  }
  faces_ = std::move(owned_faces.order);
  edges_ = std::move(owned_edges.order);
  list_borders(mesh);
  list_places(mesh);
  choose_spread(mesh);
  validate(*this, mesh);
}

void RegionTree::list_borders(const IndexedMesh& mesh) {
  std::vector<std::uint32_t> listed_for(mesh.vertex_count(), 0);  // a leaf's number, plus one
  for (std::uint32_t index = 0; index < region_count(); ++index) {
    Region& leaf = regions_[index];
    if (!leaf.is_leaf()) continue;
    for (const std::uint32_t vertex : vertices(leaf)) listed_for[vertex] = index + 1;
    leaf.first_border = static_cast<std::uint32_t>(border_.size());
    const auto add = [&](std::uint32_t vertex) {
      if (std::exchange(listed_for[vertex], index + 1) != index + 1) border_.push_back(vertex);
    };
    for (const std::uint32_t face : faces(leaf))
      for (const std::uint32_t corner : mesh.face(face)) add(corner);
    for (const std::uint32_t edge : edges(leaf))
      for (const std::uint32_t end : mesh.edge(edge)) add(end);
    leaf.border_count = static_cast<std::uint32_t>(border_.size()) - leaf.first_border;
  }
  border_.shrink_to_fit();
}

void RegionTree::list_places(const IndexedMesh& mesh) {
  std::vector<std::uint32_t> local_index(mesh.vertex_count());
  const auto pad = [&](std::size_t begin, std::size_t each) {
    while ((local_indices_.size() - begin) % (4 * each) != 0) local_indices_.push_back(0);
  };
  local_begin_.resize(regions_.size());
  for (std::uint32_t index = 0; index < region_count(); ++index) {
    const Region& leaf = regions_[index];
    if (!leaf.is_leaf()) continue;
    std::uint32_t count = 0;
    for (const auto& list : {vertices(leaf), border(leaf)})
      for (const std::uint32_t vertex : list) local_index[vertex] = count++;
    LocalBegin& begin = local_begin_[index];
    begin.ends = static_cast<std::uint32_t>(local_indices_.size());
    for (const std::uint32_t edge : edges(leaf))
      for (const std::uint32_t end : mesh.edge(edge)) local_indices_.push_back(local_index[end]);
    pad(begin.ends, 2);
    begin.corners = static_cast<std::uint32_t>(local_indices_.size());
    for (const std::uint32_t face : faces(leaf)) {
      const auto corner = mesh.face(face);
      for (std::size_t second = 1; second + 1 < corner.size(); ++second)
        for (const std::size_t at : {std::size_t{0}, second, second + 1})
          local_indices_.push_back(local_index[corner[at]]);
    }
    begin.corner_count = static_cast<std::uint32_t>(local_indices_.size()) - begin.corners;
    pad(begin.corners, 3);
  }
  local_indices_.shrink_to_fit();
}

/// The second is the furthest from the first, the third the furthest from the line through both.
void RegionTree::choose_spread(const IndexedMesh& mesh) {
  spread_.assign(regions_.size(), {});
  for (std::uint32_t index = 0; index < region_count(); ++index) {
    const Region& leaf = regions_[index];
    if (!leaf.is_leaf()) continue;
    const auto furthest = [&](const auto& measure) {
      std::uint32_t found = vertices(leaf).front();
      double most = 0;
      for (const auto& list : {vertices(leaf), border(leaf)})
        for (const std::uint32_t vertex : list)
          if (const double here = measure(mesh.rest()[vertex]); here > most) {
            most = here;
            found = vertex;
          }
      return found;
    };
    auto& [first, second, third] = spread_[index];
    first = vertices(leaf).front();
    const Eigen::Vector3d from = mesh.rest()[first];
    second = furthest([&](const Eigen::Vector3d& point) { return (point - from).squaredNorm(); });
    const Eigen::Vector3d along = mesh.rest()[second] - from;
    third = furthest([&](const Eigen::Vector3d& point) { return (point - from).cross(along).squaredNorm(); });
  }
}

std::size_t RegionTree::byte_count() const {
  return bytes_of(regions_) + bytes_of(level_begin_) + bytes_of(vertices_) + bytes_of(faces_) +
         bytes_of(edges_) + bytes_of(border_) + bytes_of(local_indices_) + bytes_of(local_begin_) +
         bytes_of(spread_);
}

}  // namespace graze
