#pragma once

#include <bitset>
#include <cstdint>
#include <graze/export.hpp>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

/// A set of groups of faces.
using GroupSet = std::bitset<std::numeric_limits<std::uint8_t>::max() + std::size_t{1}>;

/// The groups of a mesh's faces, and for each vertex, edge and region the set of groups of its faces. A
/// feature refers to its set by the set's number, since a mesh has few different sets. Faces of hidden groups
/// are in no set, so the set of what only they have is empty. Immutable.
class GRAZE_API FaceGroups {
 public:
  /// Puts all faces of any mesh into group 0.
  FaceGroups() : sets_{GroupSet(1)}, partners_{~GroupSet()} {}
  /// Takes one group for each face of the mesh, or none: then all are in group 0. The faces of `hidden`
  /// groups are hidden.
  FaceGroups(const IndexedMesh& mesh, std::span<const std::uint8_t> group_of_face,
             std::span<const std::uint8_t> hidden = {});

  /// The sets by their numbers.
  [[nodiscard]] std::span<const GroupSet> sets() const { return sets_; }
  /// For each set the groups that it meets where no groups are ignored: all, or none if it is empty.
  [[nodiscard]] std::span<const GroupSet> partners() const { return partners_; }
  // The number of the set of groups of all faces that a feature belongs to and that are not hidden.
  [[nodiscard]] std::uint32_t of_vertex(std::uint32_t index) const { return at(vertices_, index); }
  [[nodiscard]] std::uint32_t of_edge(std::uint32_t index) const { return at(edges_, index); }
  [[nodiscard]] std::uint32_t of_face(std::uint32_t index) const { return at(faces_, index); }
  /// The number of the set of groups of all features that a region owns.
  [[nodiscard]] std::uint32_t of_region(std::uint32_t index) const { return at(regions_, index); }

  /// The groups that the mesh's faces are in, but for hidden ones.
  [[nodiscard]] const GroupSet& all() const { return sets_[of_region(0)]; }
  /// A face of a group in `all()`: the lowest.
  [[nodiscard]] std::uint32_t first_face_of(std::size_t group) const;

  /// Whether some faces are hidden.
  [[nodiscard]] bool hides_some() const { return hides_some_; }
  [[nodiscard]] bool hides(std::uint32_t face) const { return sets_[of_face(face)].none(); }
  /// The lowest face that is not hidden, or 0 if all are.
  [[nodiscard]] std::uint32_t first_seen_face() const { return first_seen_face_; }

  /// Bytes held.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// Gives equal sets one number, while the sets are made.
  class Numbering;

  static std::uint32_t at(const std::vector<std::uint32_t>& numbers, std::uint32_t index) {
    return numbers.empty() ? 0 : numbers[index];
  }
  void add_faces(const IndexedMesh& mesh, std::span<const std::uint8_t> group_of_face, const GroupSet& hidden,
                 Numbering& numbering);
  void add_regions(const RegionTree& tree, Numbering& numbering);

  std::vector<GroupSet> sets_;
  std::vector<GroupSet> partners_;
  std::vector<std::uint32_t>
      vertices_;  ///< numbers of sets. They are empty if all faces are in group 0, as the others
  std::vector<std::uint32_t> edges_;
  std::vector<std::uint32_t> faces_;
  std::vector<std::uint32_t> regions_;
  std::uint32_t first_seen_face_ = 0;
  bool hides_some_ = false;
};

}  // namespace graze
