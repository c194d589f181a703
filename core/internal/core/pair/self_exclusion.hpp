#pragma once

#include <array>
#include <cstdint>
#include <graze/export.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"
#include "core/pair/near_list.hpp"
#include "core/surface/surface.hpp"

namespace graze {

/// How far features of one surface are apart at rest that are tested against each other, by region: at least
/// so far is each feature that a leaf owns from any other. Fields are empty where nothing is known.
struct RestGaps {
  std::vector<float> of_contacts;   ///< features that may be in contact
  std::vector<float> of_piercings;  ///< edges and faces, where it counts that they pierce each other
  std::vector<Box> boxes;           ///< of the corners of a leaf's features at rest
};

/// Says which features of one surface are not tested against each other: those that share a vertex or belong
/// to one neighbourhood, and those that are near at rest. Immutable. Any number of threads may read it.
class GRAZE_API SelfExclusion {
 public:
  /// `rings` is the most edges between two vertices that are neighbours.
  SelfExclusion(std::shared_ptr<const IndexedMesh> mesh, std::uint32_t rings, RestGaps rest_gaps = {});

  /// Whether two features have a vertex in common.
  [[nodiscard]] bool share_vertex(const FeatureRef& a, const FeatureRef& b) const;
  /// Whether a vertex of one feature is joined to a vertex of the other by as many edges as there are rings,
  /// or fewer. So it is for features that share a vertex.
  [[nodiscard]] bool are_neighbours(const FeatureRef& a, const FeatureRef& b) const;
  /// Whether the closest points of two features are strictly nearer than a distance at rest. The folder
  /// closest_features has it, since that is where distances are decided.
  [[nodiscard]] bool are_near_at_rest(const FeatureRef& a, const FeatureRef& b, double distance) const;

  /// Vertices and faces that lie at opposite ends of the rest shape, along each axis: most likely some of
  /// them are tested against each other.
  struct FarPair {
    std::uint32_t vertex = 0;
    std::uint32_t face = 0;
  };
  [[nodiscard]] const std::array<FarPair, 3>& far_pairs() const { return far_pairs_; }
  [[nodiscard]] const IndexedMesh& mesh() const { return rest_.mesh(); }
  [[nodiscard]] const RestGaps& rest_gaps() const { return rest_gaps_; }

  /// Bytes held, without the mesh.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  void find_far_pairs();
  [[nodiscard]] bool are_joined(std::uint32_t one, std::uint32_t other, std::uint32_t edges) const;

  Surface rest_;
  std::uint32_t rings_;
  RestGaps rest_gaps_;
  std::array<FarPair, 3> far_pairs_;
};

/// The vertices of a feature. `room` is for those that the mesh does not list. A fold has those of its quad.
inline std::span<const std::uint32_t> feature_vertices(const IndexedMesh& mesh, const FeatureRef& feature,
                                                       std::array<std::uint32_t, 2>& room) {
  if (feature.kind == FeatureRefKind::face || feature.kind == FeatureRefKind::fold)
    return mesh.face(feature.index);
  const bool is_edge = feature.kind == FeatureRefKind::edge;
  room = is_edge ? mesh.edge(feature.index) : std::array{feature.index, feature.index};
  return std::span(room).first(is_edge ? 2 : 1);
}

/// Says what a query about a surface and itself leaves out.
struct SelfQuery {
  const SelfExclusion* exclusion = nullptr;  ///< null for two surfaces
  double rest_distance = 0;     ///< features nearer than that at rest are left out. 0: none are for that
  bool is_of_vertices = false;  ///< whether pairs are of two vertices
};

}  // namespace graze
