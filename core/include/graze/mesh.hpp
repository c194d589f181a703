#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <graze/bytes_of.hpp>
#include <graze/error.hpp>
#include <graze/export.hpp>
#include <graze/made_once.hpp>
#include <graze/number_tuple.hpp>
#include <graze/position_view.hpp>
#include <graze/region_tree.hpp>
#include <graze/rest_reach.hpp>
#include <limits>
#include <ranges>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace graze {

/// A vector, array or span of corners one after the other, as 32-bit integers.
template <typename Range>
concept CornerRange = std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range> &&
    Index32<std::ranges::range_value_t<Range>>;

/// Numbers of corners, of any integer type.
template <typename Range>
concept CountRange = std::ranges::sized_range<Range> && std::integral<std::ranges::range_value_t<Range>>;

/// Whether corners and their counts are taken as they are.
template <typename Corners, typename Counts>
concept AreUnsigned = std::convertible_to<const Corners&, std::span<const std::uint32_t>> &&
    std::convertible_to<const Counts&, std::span<const std::uint32_t>>;

/// All corners one after the other, or an element with `count` corners for each face.
template <typename Element, std::size_t count>
concept FaceElement = Index32<Element> || CornerTuple<Element, count>;

/// Faces of `count` corners each, in another form than a span of std::array<std::uint32_t, count>.
template <typename Range, std::size_t count>
concept FacesOf = std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range> &&
    FaceElement<std::ranges::range_value_t<Range>, count> &&
    !std::convertible_to<const Range&, std::span<const std::array<std::uint32_t, count>>>;

/// Topology and rest shape of a surface of triangles and quads, with its octree of regions. Immutable; share
/// it between any number of objects and threads.
///
/// Vertex and face numbers are the caller's. Edges are numbered in the order in which they first appear
/// walking the faces' corners, the corner pair (last, first) at the end of each face. A face that repeats a
/// vertex is accepted; the pair of a vertex with itself is no edge. A vertex that no face uses is not part of
/// the surface: it is never read and may hold anything.
class GRAZE_API Mesh {
 public:
  /// Stands in `face_edges` where two consecutive corners are the same vertex.
  static constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();

  /// Positions and the corners of each face. Throws Error for no face, a corner that names no vertex, a used
  /// vertex that is not finite or beyond 2^120, or a face of another number of corners than 3 or 4.
  static Mesh from_triangles(PositionView rest, std::span<const std::array<std::uint32_t, 3>> triangles);
  static Mesh from_quads(PositionView rest, std::span<const std::array<std::uint32_t, 4>> quads);
  /// Faces as other programs keep them, in a vector, array or span. Either all corners one after the other,
  /// as 32-bit integers with a sign or without. Or a face in each element: Eigen::Vector3i (Vector4i for
  /// quads), std::array<int, 3>, or a caller's own struct of so many 32-bit integers. Throws Error also where
  /// the corners are no whole number of faces. A negative corner names no vertex.
  template <typename Triangles>
  requires FacesOf<Triangles, 3>
  static Mesh from_triangles(PositionView rest, const Triangles& triangles) {
    return from_corners(rest, 3, triangles);
  }
  template <typename Quads>
  requires FacesOf<Quads, 4>
  static Mesh from_quads(PositionView rest, const Quads& quads) { return from_corners(rest, 4, quads); }
  /// A face in each row of a matrix of Eigen's of 32-bit integers, such as libigl's `Eigen::MatrixXi F`.
  /// Throws Error also where it has not 3 columns, or 4 for quads.
  template <typename Faces>
  requires Index32<typename Faces::Scalar>
  static Mesh from_triangles(PositionView rest, const Eigen::MatrixBase<Faces>& triangles) {
    return from_rows(rest, 3, triangles);
  }
  template <typename Faces>
  requires Index32<typename Faces::Scalar>
  static Mesh from_quads(PositionView rest, const Eigen::MatrixBase<Faces>& quads) {
    return from_rows(rest, 4, quads);
  }
  /// Triangles and quads mixed: `corners` holds the corners of all faces one after the other, `corner_counts`
  /// how many each face has.
  static Mesh from_polygons(PositionView rest, std::span<const std::uint32_t> corners,
                            std::span<const std::uint32_t> corner_counts);
  /// Triangles and quads mixed, from corners with a sign, or counts of any integer type.
  template <CornerRange Corners, CountRange Counts>
  requires(!AreUnsigned<Corners, Counts>) static Mesh
      from_polygons(PositionView rest, const Corners& corners, const Counts& corner_counts) {
    std::vector<std::uint32_t> counts;
    counts.reserve(std::ranges::size(corner_counts));
    for (const auto count : corner_counts)
      counts.push_back(std::in_range<std::uint32_t>(count) ? static_cast<std::uint32_t>(count) : 0);
    return from_polygons(rest, as_unsigned(corners), std::span<const std::uint32_t>(counts));
  }

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

  // The lists that follow are each made as a whole when one of them is first asked for, by any thread, since
  // few uses of a mesh need all of them.

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
  /// The vertices around `vertex` in the order of its triangles, of which each has one of them and the next
  /// for its other corners, in its own sense. Where no triangle is between two of them `vertex` itself
  /// stands, so that there is a triangle without area; quads are two triangles, and others without area at
  /// any position are left out.
  [[nodiscard]] std::span<const std::uint32_t> vertex_fans(std::uint32_t vertex) const {
    return fans().row(vertex);
  }
  /// The used vertices in an order in which each eight of them are near each other at rest: halved along the
  /// longest side of their box, and the halves again, with whole eights on either side.
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
    neighbours,         ///< `vertex_neighbours`
    poses,              ///< `rest_reach`
  };
  /// Makes the lists of a use now, so that nobody waits for them later. Any thread.
  void prepare_for(Use use) const;

  /// Whether vertices are listed by stretches: of large meshes all of whose vertices are used.
  [[nodiscard]] bool has_stretches() const;
  /// Whether any face uses `vertex`.
  [[nodiscard]] bool is_used(std::uint32_t vertex) const { return used_.empty() || used_[vertex] != 0; }
  /// Whether every vertex is used.
  [[nodiscard]] bool uses_all_vertices() const { return used_.empty(); }

  /// The octree of regions, built with the mesh.
  [[nodiscard]] const RegionTree& regions() const { return regions_; }

  /// How far the rest shape reaches in any direction; made when it is first asked for, by any thread.
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
  struct Blocks {
    std::vector<std::uint32_t> order;
    Rows stretch_groups;
    [[nodiscard]] std::size_t byte_count() const { return bytes_of(order) + stretch_groups.byte_count(); }
  };

  Mesh() = default;

  /// Faces of `each` corners.
  static Mesh from_flat(PositionView rest, std::uint32_t each, std::span<const std::uint32_t> corners);
  /// Negative corners become numbers of 2^31 and more, which no vertex has.
  template <CornerRange Corners>
  static std::span<const std::uint32_t> as_unsigned(const Corners& corners) {
    return {reinterpret_cast<const std::uint32_t*>(std::ranges::data(corners)), std::ranges::size(corners)};
  }
  template <typename Faces>
  static Mesh from_corners(PositionView rest, std::uint32_t each, const Faces& faces) {
    if constexpr (CornerRange<Faces>) {
      return from_flat(rest, each, as_unsigned(faces));
    } else {
      std::vector<std::uint32_t> corners(each * std::ranges::size(faces));
      if (!corners.empty())
        std::memcpy(corners.data(), static_cast<const void*>(std::ranges::data(faces)),
                    corners.size() * sizeof(std::uint32_t));
      return from_flat(rest, each, corners);
    }
  }
  template <typename Faces>
  static Mesh from_rows(PositionView rest, std::uint32_t each, const Eigen::MatrixBase<Faces>& faces) {
    if (faces.cols() != static_cast<Eigen::Index>(each))
      throw Error("mesh: a matrix of " + std::to_string(faces.rows()) + " rows and " +
                  std::to_string(faces.cols()) + " columns; give a face in each row, in " +
                  std::to_string(each) + " columns");
    std::vector<std::uint32_t> corners;
    corners.reserve(static_cast<std::size_t>(faces.size()));
    for (Eigen::Index row = 0; row < faces.rows(); ++row)
      for (Eigen::Index column = 0; column < faces.cols(); ++column)
        corners.push_back(static_cast<std::uint32_t>(faces.derived().coeff(row, column)));
    return from_flat(rest, each, corners);
  }

  [[nodiscard]] std::span<const std::uint32_t> of_face(const std::vector<std::uint32_t>& values,
                                                       std::uint32_t face) const {
    const std::size_t begin = face_begin_.empty() ? std::size_t{face} * corners_each_ : face_begin_[face];
    const std::size_t count = face_begin_.empty() ? corners_each_ : face_begin_[face + 1] - begin;
    return std::span(values).subspan(begin, count);
  }
  void take_faces(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> corner_counts);
  void check_faces() const;
  void look_for_unused();
  void check_rest() const;
  void number_edges();
  [[nodiscard]] const Rows& neighbours() const;
  [[nodiscard]] const Rows& faces_of_vertices() const;
  [[nodiscard]] const Rows& faces_of_edges() const;
  [[nodiscard]] const Rows& fans() const;
  [[nodiscard]] const Blocks& blocks() const;

  std::vector<Eigen::Vector3d> rest_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::uint32_t> face_begin_;  ///< into these; empty where all faces have as many corners
  std::uint32_t corners_each_ = 0;
  std::uint32_t face_count_ = 0;
  std::vector<std::uint32_t> face_edges_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
  std::vector<std::uint8_t> used_;  ///< by vertex; empty where all are
  RegionTree regions_;
  MadeOnce<Rows> neighbours_, vertex_faces_, edge_faces_, fans_;
  MadeOnce<Blocks> blocks_;
  MadeOnce<RestReach> rest_reach_;
};

/// What is odd about a mesh: nothing here is an error, all of it is accepted. Every list is ascending.
struct MeshOddities {
  std::vector<std::uint32_t> degenerate_faces;   ///< zero area at rest, or a repeated corner
  std::vector<std::uint32_t> duplicate_faces;    ///< the same set of corners as an earlier face
  std::vector<std::uint32_t> isolated_vertices;  ///< no face uses them
  std::vector<std::uint32_t>
      duplicate_vertices;  ///< used, and at the rest position of an earlier used vertex
  std::vector<std::uint32_t> non_manifold_edges;  ///< more than two faces
  std::vector<std::uint32_t> border_edges;        ///< one face: the surface is open there
  std::vector<std::uint32_t> flipped_edges;       ///< two faces that run along it in the same direction

  /// Every edge has exactly two faces.
  [[nodiscard]] bool closed_manifold() const { return non_manifold_edges.empty() && border_edges.empty(); }
};

/// Lists what is odd about `mesh`.
GRAZE_API MeshOddities find_oddities(const Mesh& mesh);

}  // namespace graze
