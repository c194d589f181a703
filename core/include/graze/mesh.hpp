#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <graze/error.hpp>
#include <graze/export.hpp>
#include <graze/number_tuple.hpp>
#include <graze/position_view.hpp>
#include <limits>
#include <memory>
#include <ranges>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace graze {

class IndexedMesh;

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
  Mesh(const Mesh&) = default;
  Mesh& operator=(const Mesh&) = default;

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

  [[nodiscard]] std::uint32_t vertex_count() const;
  [[nodiscard]] std::uint32_t face_count() const;
  [[nodiscard]] std::uint32_t edge_count() const;

  /// Rest positions, one for each vertex, unused ones included.
  [[nodiscard]] std::span<const Eigen::Vector3d> rest() const;

  /// A face's corners as they came: 3 or 4.
  [[nodiscard]] std::span<const std::uint32_t> face(std::uint32_t index) const;
  /// The edge from each corner of a face to the next, `no_edge` where they are one vertex.
  [[nodiscard]] std::span<const std::uint32_t> face_edges(std::uint32_t index) const;
  /// An edge's two vertices, the lower first.
  [[nodiscard]] std::array<std::uint32_t, 2> edge(std::uint32_t index) const;

  // The lists that follow are each made as a whole when one of them is first asked for, by any thread, since
  // few uses of a mesh need all of them.

  /// The vertices that share an edge with `vertex`, ascending.
  [[nodiscard]] std::span<const std::uint32_t> vertex_neighbours(std::uint32_t vertex) const;
  /// The faces that use `vertex`, ascending, each once.
  [[nodiscard]] std::span<const std::uint32_t> vertex_faces(std::uint32_t vertex) const;
  /// The faces that have `edge`, ascending, each once.
  [[nodiscard]] std::span<const std::uint32_t> edge_faces(std::uint32_t edge) const;
  /// Whether any face uses `vertex`.
  [[nodiscard]] bool is_used(std::uint32_t vertex) const;
  /// Whether every vertex is used.
  [[nodiscard]] bool uses_all_vertices() const;

  /// Bytes held now: with the region tree, and with such lists as have been made.
  [[nodiscard]] std::size_t byte_count() const;

 private:
  friend const IndexedMesh& indexed(const Mesh& mesh);

  explicit Mesh(std::shared_ptr<const IndexedMesh> data);

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

  std::shared_ptr<const IndexedMesh> data_;  ///< never null
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
