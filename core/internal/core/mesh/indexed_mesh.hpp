#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>
#include <span>
#include <vector>

#include "core/base/bytes_of.hpp"
#include "core/base/made_once.hpp"
#include "core/mesh/long_regions.hpp"
#include "core/mesh/region_tree.hpp"
#include "core/mesh/rest_reach.hpp"

namespace graze {

/// The data behind a Mesh: topology, rest shape, the octree of regions, and lists that queries need. It is
/// immutable. Members that Mesh also has mean the same here.
class GRAZE_API IndexedMesh {
 public:
  static constexpr std::uint32_t no_edge = Mesh::no_edge;

  /// From the faces' corners one after the other, and how many each face has. Throws Error as
  /// Mesh::from_polygons says.
  IndexedMesh(PositionView rest, std::span<const std::uint32_t> corners,
              std::span<const std::uint32_t> corner_counts);

  [[nodiscard]] std::uint32_t vertex_count() const { return static_cast<std::uint32_t>(rest_.size()); }
  [[nodiscard]] std::uint32_t face_count() const { return face_count_; }
  [[nodiscard]] std::uint32_t edge_count() const { return static_cast<std::uint32_t>(edges_.size()); }

  /// Rest positions, one for each vertex, unused ones included.
  [[nodiscard]] std::span<const Eigen::Vector3d> rest() const { return rest_; }

  /// A face's corners as they came: 3 or 4.
  [[nodiscard]] std::span<const std::uint32_t> face(std::uint32_t index) const {
    return of_face(corners_, index);
  }
  /// The edge from each corner of a face to the next, `no_edge` where they are one vertex.
  [[nodiscard]] std::span<const std::uint32_t> face_edges(std::uint32_t index) const {
    return of_face(face_edges_, index);
  }
  /// An edge's two vertices, the lower first.
  [[nodiscard]] std::array<std::uint32_t, 2> edge(std::uint32_t index) const { return edges_[index]; }

  // Each of the lists below is made as a whole when one of them is first asked for, by any thread. Few uses
  // of a mesh need all of them.

  /// The vertices that share an edge with `vertex`, ascending.
  [[nodiscard]] std::span<const std::uint32_t> vertex_neighbours(std::uint32_t vertex) const {
    return neighbours().row(vertex);
  }
  /// The faces that use `vertex`, ascending, each once.
  [[nodiscard]] std::span<const std::uint32_t> vertex_faces(std::uint32_t vertex) const {
    return faces_of_vertices().row(vertex);
  }
  /// The faces that have `edge`, ascending, each once.
  [[nodiscard]] std::span<const std::uint32_t> edge_faces(std::uint32_t edge) const {
    return faces_of_edges().row(edge);
  }
  /// The corners across from `edge`, one for each triangle that has it, if its corners are three vertices. A
  /// quad counts as two triangles.
  [[nodiscard]] std::span<const std::uint32_t> edge_across(std::uint32_t edge) const {
    return corners_across_edges().row(edge);
  }
  /// Whether an edge is a crease at rest: a border, an edge of three faces or more, or one at which the
  /// surface bends by more than 5.07°. See find_creases().
  [[nodiscard]] bool is_crease(std::uint32_t edge) const { return creases().edges[edge]; }
  /// The vertices around `vertex` as a fan of triangles. Each two that follow one another make a triangle
  /// with `vertex`, in the sense of its face. `vertex` itself stands between two that make none, which gives
  /// a triangle without area. A quad counts as two triangles. Triangles that have no area at any position
  /// are left out.
  [[nodiscard]] std::span<const std::uint32_t> vertex_fans(std::uint32_t vertex) const {
    return fans().row(vertex);
  }
  /// The used vertices, ordered so that each eight of them are near each other at rest. The order halves
  /// their box along its longest side, then halves the halves, with whole eights on either side.
  [[nodiscard]] std::span<const std::uint32_t> block_order() const { return blocks().order; }
  /// Which groups of sixteen blocks the vertices of a stretch (VertexStretches) are in, ascending.
  [[nodiscard]] std::span<const std::uint32_t> stretch_groups(std::uint32_t stretch) const {
    return blocks().stretch_groups.row(stretch);
  }

  /// The purposes for which a mesh makes further lists.
  enum class Use : std::uint8_t {
    blocks,             ///< `block_order`, `stretch_groups`
    normals_of_points,  ///< `vertex_fans`, `vertex_faces`
    normals,            ///< these and `edge_faces`
    faces_of_edges,     ///< `edge_faces`
    sides_of_edges,     ///< `edge_across`, `is_crease`
    neighbours,         ///< `vertex_neighbours`
    poses,              ///< `rest_reach`
  };
  /// Makes the lists of a use now, so that nobody waits for them later. Any thread.
  void prepare_for(Use use) const;

  /// Whether vertices are listed by stretches. They are in a large mesh without unused vertices.
  [[nodiscard]] bool has_stretches() const;
  /// Whether any face uses `vertex`.
  [[nodiscard]] bool is_used(std::uint32_t vertex) const { return used_.empty() || used_[vertex] != 0; }
  /// Whether every vertex is used.
  [[nodiscard]] bool uses_all_vertices() const { return used_.empty(); }

  /// The octree of regions, built with the mesh.
  [[nodiscard]] const RegionTree& regions() const { return regions_; }
  /// The regions of the octree whose faces are long.
  [[nodiscard]] const LongRegions& long_regions() const { return long_regions_; }

  /// How far the rest shape reaches in any direction. It is made when it is first asked for, by any thread.
  [[nodiscard]] const RestReach& rest_reach() const;

  /// Bytes held now: with the region tree, and with such lists as have been made.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  /// Lists of numbers one after the other: the list of i is values[begin[i], begin[i + 1]).
  struct Rows {
    std::vector<std::uint32_t> values;
    std::vector<std::uint32_t> begin;

    [[nodiscard]] std::span<const std::uint32_t> row(std::uint32_t index) const {
      return std::span(values).subspan(begin[index], begin[index + 1] - begin[index]);
    }
    [[nodiscard]] std::size_t byte_count() const { return bytes_of(values) + bytes_of(begin); }
  };
  struct Creases {
    std::vector<bool> edges;
    [[nodiscard]] std::size_t byte_count() const { return edges.capacity() / 8; }
  };
  struct Blocks {
    std::vector<std::uint32_t> order;
    Rows stretch_groups;
    [[nodiscard]] std::size_t byte_count() const { return bytes_of(order) + stretch_groups.byte_count(); }
  };

  [[nodiscard]] std::span<const std::uint32_t> of_face(const std::vector<std::uint32_t>& values,
                                                       std::uint32_t face) const {
    const std::size_t begin = face_begin_.empty() ? std::size_t{face} * corners_each_ : face_begin_[face];
    const std::size_t count = face_begin_.empty() ? corners_each_ : face_begin_[face + 1] - begin;
    return std::span(values).subspan(begin, count);
  }
  void take_faces(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> corner_counts);
  void check_faces() const;
  void find_unused();
  void check_rest() const;
  void number_edges();
  [[nodiscard]] const Rows& neighbours() const;
  [[nodiscard]] const Rows& faces_of_vertices() const;
  [[nodiscard]] const Rows& faces_of_edges() const;
  [[nodiscard]] const Rows& corners_across_edges() const;
  [[nodiscard]] const Rows& fans() const;
  [[nodiscard]] const Creases& creases() const;
  [[nodiscard]] const Blocks& blocks() const;

  std::vector<Eigen::Vector3d> rest_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t>
      face_begin_;  ///< into `corners_`. It is empty if all faces have the same number of corners
  std::uint32_t corners_each_ = 0;
  std::uint32_t face_count_ = 0;
  std::vector<std::uint32_t> face_edges_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<std::uint8_t> used_;  ///< by vertex. It is empty if all vertices are used
  RegionTree regions_;
  LongRegions long_regions_;
  MadeOnce<Rows> neighbours_, vertex_faces_, edge_faces_, edge_across_, fans_;
  MadeOnce<Creases> creases_;
  MadeOnce<Blocks> blocks_;
  MadeOnce<RestReach> rest_reach_;
};

/// Returns what a mesh holds.
inline const IndexedMesh& indexed(const Mesh& mesh) {
  return *mesh.indexed_;
}

}  // namespace graze
