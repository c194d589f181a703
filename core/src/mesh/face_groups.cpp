#include "core/mesh/face_groups.hpp"

#include <algorithm>
#include <utility>

#include "core/base/bytes_of.hpp"

namespace graze {

class FaceGroups::Numbering {
 public:
  explicit Numbering(std::vector<GroupSet>& sets) : sets_(sets) { (void)number_of(GroupSet()); }

  [[nodiscard]] std::uint32_t number_of(const GroupSet& set) {
    const auto [known, is_new] = number_.try_emplace(set, static_cast<std::uint32_t>(sets_.size()));
    if (is_new) sets_.push_back(set);
    return known->second;
  }
  /// The number of a set and one group more.
  [[nodiscard]] std::uint32_t with(std::uint32_t number, std::uint8_t group) {
    if (sets_[number].test(group)) return number;
    return number_of(GroupSet(sets_[number]).set(group));
  }

 private:
  std::vector<GroupSet>& sets_;
  std::unordered_map<GroupSet, std::uint32_t> number_;
};

FaceGroups::FaceGroups(const IndexedMesh& mesh, std::span<const std::uint8_t> group_of_face,
                       std::span<const std::uint8_t> hidden) {
  GroupSet are_hidden;
  for (const std::uint8_t group : hidden) are_hidden.set(group);
  Numbering numbering(sets_);
  add_faces(mesh, group_of_face, are_hidden, numbering);
  add_regions(mesh.regions(), numbering);
  for (const GroupSet& set : sets_) partners_.push_back(set.none() ? set : ~GroupSet());
}

/// Adds each face's group to its corners and edges, unless the group is hidden.
void FaceGroups::add_faces(const IndexedMesh& mesh, std::span<const std::uint8_t> group_of_face,
                           const GroupSet& hidden, Numbering& numbering) {
  vertices_.assign(mesh.vertex_count(), 0);
  edges_.assign(mesh.edge_count(), 0);
  faces_.assign(mesh.face_count(), 0);
  bool sees_some = false;
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::uint8_t group = group_of_face.empty() ? 0 : group_of_face[face];
    if (hidden.test(group)) {
      hides_some_ = true;
      continue;
    }
    if (!std::exchange(sees_some, true)) first_seen_face_ = face;
    faces_[face] = numbering.with(0, group);
    for (const std::uint32_t corner : mesh.face(face))
      vertices_[corner] = numbering.with(vertices_[corner], group);
    for (const std::uint32_t edge : mesh.face_edges(face))
      if (edge != IndexedMesh::no_edge) edges_[edge] = numbering.with(edges_[edge], group);
  }
}

/// Joins the sets of what each leaf owns, and those of children. A child comes after its parent.
void FaceGroups::add_regions(const RegionTree& tree, Numbering& numbering) {
  std::vector<GroupSet> groups(tree.region_count());
  for (std::size_t index = groups.size(); index-- > 0;) {
    const Region& region = tree.regions()[index];
    GroupSet& set = groups[index];
    if (region.is_leaf()) {
      for (const std::uint32_t vertex : tree.vertices(region)) set |= sets_[vertices_[vertex]];
      for (const std::uint32_t edge : tree.edges(region)) set |= sets_[edges_[edge]];
      for (const std::uint32_t face : tree.faces(region)) set |= sets_[faces_[face]];
    }
    if (index > 0) groups[region.parent] |= set;
  }
  regions_.resize(groups.size());
  std::transform(groups.begin(), groups.end(), regions_.begin(),
                 [&](const GroupSet& set) { return numbering.number_of(set); });
}

std::uint32_t FaceGroups::first_face_of(std::size_t group) const {
  const auto found = std::find_if(faces_.begin(), faces_.end(),
                                  [&](std::uint32_t number) { return sets_[number].test(group); });
  return found == faces_.end() ? 0 : static_cast<std::uint32_t>(found - faces_.begin());
}

std::size_t FaceGroups::byte_count() const {
  return bytes_of(sets_) + bytes_of(partners_) + bytes_of(vertices_) + bytes_of(edges_) + bytes_of(faces_) +
         bytes_of(regions_);
}

}  // namespace graze
