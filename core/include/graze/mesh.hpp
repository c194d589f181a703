#pragma once

#include <Eigen/Core>
#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <graze/error.hpp>
#include <graze/export.hpp>
#include <graze/link_guard.hpp>
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

/// @addtogroup mesh
/// @{

/// A contiguous range of corners one after the other, as 32-bit integers with a sign or without. A vector, an
/// array and a span are such ranges.
template <typename Range>
concept CornerRange = std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range> &&
    Index32<std::ranges::range_value_t<Range>>;

/// A range that says how many corners each face has. Its elements are of any integer type.
template <typename Range>
concept CountRange = std::ranges::sized_range<Range> && std::integral<std::ranges::range_value_t<Range>>;

/// @cond internal
/// Says whether corners and their counts convert to spans of `std::uint32_t`, so that nothing is copied.
template <typename Corners, typename Counts>
concept AreUnsigned = std::convertible_to<const Corners&, std::span<const std::uint32_t>> &&
    std::convertible_to<const Counts&, std::span<const std::uint32_t>>;

/// @endcond

/// An element of a list of faces. It is either one corner, or a whole face of `count` corners.
template <typename Element, std::size_t count>
concept FaceElement = Index32<Element> || CornerTuple<Element, count>;

/// A list of faces of `count` corners each, in another form than a span of `std::array<std::uint32_t,
/// count>`.
template <typename Range, std::size_t count>
concept FacesOf = std::ranges::contiguous_range<Range> && std::ranges::sized_range<Range> &&
    FaceElement<std::ranges::range_value_t<Range>, count> &&
    !std::convertible_to<const Range&, std::span<const std::array<std::uint32_t, count>>>;

/// Topology and rest shape of a surface of triangles and quads. It never changes, so any number of objects,
/// scenes and threads may share one. Scene::add() takes it as a `std::shared_ptr<const Mesh>`.
///
/// @par Vertices and faces
/// Their indices are the caller's. The surface is the faces. A vertex that no face uses is not part of it:
/// graze never reads it, and it may hold anything. A quad is its two triangles, split from its first corner.
/// Its inner diagonal is no edge. A face that repeats a vertex is accepted.
///
/// @par Edges
/// They are numbered in the order in which they first appear in the faces' corners. The edge from the last
/// corner to the first one comes at the end of each face. A vertex and itself make no edge.
///
/// @par Errors
/// The functions that make a mesh throw Error if there is no face, if a corner names no vertex, or if a face
/// has not 3 or 4 corners. They also throw Error if a vertex that a face uses has a coordinate that is not
/// finite or is beyond 2^120. They throw `std::bad_alloc` without memory. find_oddities() lists what is
/// unusual in a mesh but accepted.
class GRAZE_API Mesh {
 public:
  /// A copy shares what the mesh holds, so it is cheap. There is no move, so that a mesh is never empty.
  Mesh(const Mesh&) = default;
  /// Makes this mesh share what the other one holds.
  Mesh& operator=(const Mesh&) = default;

  /// Stands in face_edges() where two consecutive corners are the same vertex.
  static constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
  /// Stands for no vertex: for an old vertex that a new mesh does not have, in Scene::replace_mesh().
  static constexpr std::uint32_t no_vertex = std::numeric_limits<std::uint32_t>::max();

  /// @name Making a mesh
  /// @{

  /// Makes a mesh from rest positions and the three corners of each triangle. Positions are in the caller's
  /// units.
  static Mesh from_triangles(PositionView rest, std::span<const std::array<std::uint32_t, 3>> triangles);
  /// Makes a mesh from rest positions and the four corners of each quad. Positions are in the caller's units.
  static Mesh from_quads(PositionView rest, std::span<const std::array<std::uint32_t, 4>> quads);
  /// Makes a mesh from triangles as other programs keep them, in a vector, array or span.
  ///
  /// The range holds either all corners one after the other, as 32-bit integers with a sign or without. Or
  /// each element is a face: an `Eigen::Vector3i`, a `std::array<int, 3>`, or a struct of the caller's with
  /// three 32-bit integers. Also throws Error if the corners are no whole number of faces. A negative corner
  /// names no vertex.
  template <typename Triangles>
  requires FacesOf<Triangles, 3>
  static Mesh from_triangles(PositionView rest, const Triangles& triangles) {
    return from_corners(rest, 3, triangles);
  }
  /// Makes a mesh from quads as other programs keep them, in a vector, array or span. The forms are those of
  /// from_triangles(), with four corners for each face.
  template <typename Quads>
  requires FacesOf<Quads, 4>
  static Mesh from_quads(PositionView rest, const Quads& quads) { return from_corners(rest, 4, quads); }
  /// Makes a mesh from a matrix of Eigen with a triangle in each row, such as libigl's `Eigen::MatrixXi F`.
  /// Its entries are 32-bit integers. Also throws Error if the matrix has not three columns.
  template <typename Faces>
  requires Index32<typename Faces::Scalar>
  static Mesh from_triangles(PositionView rest, const Eigen::MatrixBase<Faces>& triangles) {
    return from_rows(rest, 3, triangles);
  }
  /// Makes a mesh from a matrix of Eigen with a quad in each row. Its entries are 32-bit integers. Also
  /// throws Error if the matrix has not four columns.
  template <typename Faces>
  requires Index32<typename Faces::Scalar>
  static Mesh from_quads(PositionView rest, const Eigen::MatrixBase<Faces>& quads) {
    return from_rows(rest, 4, quads);
  }
  /// Makes a mesh of triangles and quads mixed. `corners` holds the corners of all faces one after the other.
  /// `corner_counts` says for each face how many corners it has.
  static Mesh from_polygons(PositionView rest, std::span<const std::uint32_t> corners,
                            std::span<const std::uint32_t> corner_counts);
  /// Makes a mesh of triangles and quads mixed, from corners with a sign, or from counts of any integer type.
  template <CornerRange Corners, CountRange Counts>
  requires(!AreUnsigned<Corners, Counts>) static Mesh
      from_polygons(PositionView rest, const Corners& corners, const Counts& corner_counts) {
    std::vector<std::uint32_t> counts;
    counts.reserve(std::ranges::size(corner_counts));
    for (const auto count : corner_counts)
      counts.push_back(std::in_range<std::uint32_t>(count) ? static_cast<std::uint32_t>(count) : 0);
    return from_polygons(rest, as_unsigned(corners), std::span<const std::uint32_t>(counts));
  }

  /// @}

  /// @name Vertices, faces and edges
  /// @{

  /// Returns the number of vertices, including those that no face uses.
  [[nodiscard]] std::uint32_t vertex_count() const;
  /// Returns the number of faces.
  [[nodiscard]] std::uint32_t face_count() const;
  /// Returns the number of edges.
  [[nodiscard]] std::uint32_t edge_count() const;

  /// Returns the rest positions, one for each vertex, including those that no face uses.
  [[nodiscard]] std::span<const Eigen::Vector3d> rest() const;

  /// Returns the 3 or 4 corners of a face, in the order in which they were given. There is no bounds check.
  [[nodiscard]] std::span<const std::uint32_t> face(std::uint32_t index) const;
  /// Returns for each corner of a face the edge from it to the next corner. It is #no_edge where both corners
  /// are the same vertex. There is no bounds check.
  [[nodiscard]] std::span<const std::uint32_t> face_edges(std::uint32_t index) const;
  /// Returns the two vertices of an edge, the lower one first. There is no bounds check.
  [[nodiscard]] std::array<std::uint32_t, 2> edge(std::uint32_t index) const;

  /// @}

  /// @name Neighbours
  /// Each of these lists is made as a whole when a thread first asks for it. Few uses of a mesh need all of
  /// them.
  /// @{

  /// Returns the vertices that share an edge with `vertex`, in ascending order. The first call makes the
  /// lists of all vertices. Any thread may make it.
  [[nodiscard]] std::span<const std::uint32_t> vertex_neighbours(std::uint32_t vertex) const;
  /// Returns the faces that use `vertex`, in ascending order and each once. The first call makes the lists of
  /// all vertices. Any thread may make it.
  [[nodiscard]] std::span<const std::uint32_t> vertex_faces(std::uint32_t vertex) const;
  /// Returns the faces that have `edge`, in ascending order and each once. The first call makes the lists of
  /// all edges. Any thread may make it.
  [[nodiscard]] std::span<const std::uint32_t> edge_faces(std::uint32_t edge) const;
  /// @}

  /// @name Used vertices, and memory
  /// @{

  /// Returns whether any face uses `vertex`. There is no bounds check.
  [[nodiscard]] bool is_used(std::uint32_t vertex) const;
  /// Returns whether some face uses each of the vertices.
  [[nodiscard]] bool uses_all_vertices() const;

  /// Returns how many bytes the mesh holds now, with its octree of regions and with the lists made so far.
  [[nodiscard]] std::size_t byte_count() const;

  /// @}

 private:
  friend const IndexedMesh& indexed(const Mesh& mesh);

  explicit Mesh(std::shared_ptr<const IndexedMesh> indexed);

  /// Makes a mesh of faces with `each` corners.
  static Mesh from_flat(PositionView rest, std::uint32_t each, std::span<const std::uint32_t> corners);
  /// Reads corners without a sign. Negative ones become numbers of 2^31 and more, which no vertex has.
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
      throw_error("mesh: a matrix of " + std::to_string(faces.rows()) + " rows and " +
                  std::to_string(faces.cols()) + " columns; give a face in each row, in " +
                  std::to_string(each) + " columns");
    std::vector<std::uint32_t> corners;
    corners.reserve(static_cast<std::size_t>(faces.size()));
    for (Eigen::Index row = 0; row < faces.rows(); ++row)
      for (Eigen::Index column = 0; column < faces.cols(); ++column)
        corners.push_back(static_cast<std::uint32_t>(faces.derived().coeff(row, column)));
    return from_flat(rest, each, corners);
  }

  std::shared_ptr<const IndexedMesh> indexed_;  ///< never null
};

/// Lists what is unusual in a mesh. Nothing in it is an error: graze accepts all of it. Every list is
/// ascending.
struct MeshOddities {
  /// Faces that repeat a corner, or that have no area at rest. A quad has no area if neither of its triangles
  /// has.
  std::vector<std::uint32_t> degenerate_faces;
  /// Faces with the same set of corners as an earlier face.
  std::vector<std::uint32_t> duplicate_faces;
  /// Vertices that no face uses.
  std::vector<std::uint32_t> isolated_vertices;
  /// Vertices that a face uses, and that have the rest position of an earlier one.
  std::vector<std::uint32_t> duplicate_vertices;
  /// Edges of more than two faces.
  std::vector<std::uint32_t> non_manifold_edges;
  /// Edges of one face. The surface is open there.
  std::vector<std::uint32_t> border_edges;
  /// Edges whose two faces run along them in the same direction, so that the faces are wound against each
  /// other.
  std::vector<std::uint32_t> flipped_edges;

  /// Returns true if every edge has exactly two faces.
  [[nodiscard]] bool closed_manifold() const { return non_manifold_edges.empty() && border_edges.empty(); }
};

/// Returns what is unusual in `mesh`.
GRAZE_API MeshOddities find_oddities(const Mesh& mesh);

/// @}

}  // namespace graze
