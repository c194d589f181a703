#pragma once

#include <cstdint>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/position_view.hpp>
#include <limits>
#include <vector>

namespace graze {

/// @addtogroup mesh
/// @{

/// A mesh in which vertices at one place have become one vertex, as weld() makes it.
struct WeldedMesh {
  /// Stands in #new_face_of_old for no face.
  static constexpr std::uint32_t no_face = std::numeric_limits<std::uint32_t>::max();

  /// The welded mesh. Each of its vertices is at the rest position of the first old vertex that became it.
  Mesh mesh;
  /// The new vertex of each old vertex. It is Mesh::no_vertex where no face used the old vertex. Positions of
  /// the old vertices become positions of the new ones by it:
  ///
  ///     for (std::size_t old = 0; old < positions.size(); ++old)
  ///       if (welded.new_of_old[old] != graze::Mesh::no_vertex)
  ///         welded_positions[welded.new_of_old[old]] = positions[old];
  std::vector<std::uint32_t> new_of_old;
  /// The new face of each old face. It is #no_face where the old face has lost its surface.
  std::vector<std::uint32_t> new_face_of_old;
};

/// Makes a mesh whose vertices at one place are one vertex. Files for rendering double a vertex at each seam
/// of its texture or of its normals. The surface has a border there, so it is refused as a solid until it is
/// welded.
///
/// Vertices are visited in the order of their indices. A vertex becomes the first one before it that stayed
/// and whose rest position is at most `distance` away. Without such a vertex it stays. A distance of 0 joins
/// vertices whose coordinates are equal. It should be below the length of the shortest edge. Otherwise the
/// ends of an edge may become one vertex.
///
/// Faces keep their order. A quad that loses a corner becomes a triangle. A face of which fewer than three
/// different vertices are left has lost its surface and is left out. So is a quad whose opposite corners
/// became one.
///
/// Throws Error if the distance is negative or not finite, and if no face is left. Throws `std::bad_alloc`
/// without memory. Any thread may call it.
[[nodiscard]] GRAZE_API WeldedMesh weld(const Mesh& mesh, double distance = 0);

/// A list of faces from which Mesh::from_triangles() makes a mesh.
template <typename Faces>
concept TriangleList = requires(const PositionView& points, const Faces& faces) {
  Mesh::from_triangles(points, faces);
};

/// A list of faces from which only Mesh::from_quads() makes a mesh.
template <typename Faces>
concept QuadList = !TriangleList<Faces> && requires(const PositionView& points, const Faces& faces) {
  Mesh::from_quads(points, faces);
};

/// Makes a welded mesh from rest positions and triangles. `triangles` is what Mesh::from_triangles() takes.
/// Throws what that function throws, too.
template <TriangleList Triangles>
[[nodiscard]] WeldedMesh weld(PositionView points, const Triangles& triangles, double distance = 0) {
  return weld(Mesh::from_triangles(points, triangles), distance);
}

/// Makes a welded mesh from rest positions and quads, with four corners in each element of `quads`. Throws
/// what Mesh::from_quads() throws, too.
template <QuadList Quads>
[[nodiscard]] WeldedMesh weld(PositionView points, const Quads& quads, double distance = 0) {
  return weld(Mesh::from_quads(points, quads), distance);
}

/// @}

}  // namespace graze
