#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

/// Meshes made by calculation: the models of the paper's experiments in its own vertex and face counts, and
/// simple shapes for tests and demonstrations. All are the same on every machine up to the rounding of the
/// standard library's sine and cosine.
namespace graze::models {

/// Positions, the corners of all faces one after the other, and how many each face has.
struct MeshData {
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> corner_counts;

  void add_face(std::initializer_list<std::uint32_t> face);
};

/// Quads are planar or nearly so. Where a surface of quads closes at a pole it has triangles there.
enum class Faces { triangles, quads };

// The paper's models: closed, manifold, wound outward, z up, centred at the origin, within about 1 of it. As
// triangles they have these vertices / faces / edges.

MeshData torus(Faces faces = Faces::triangles);     ///< 768 / 1,536 / 2,304, around the z axis
MeshData pawn(Faces faces = Faces::triangles);      ///< 610 / 1,216 / 1,824, a chess pawn
MeshData cylinder(Faces faces = Faces::triangles);  ///< 258 / 512 / 768, around the z axis
MeshData human();                                   ///< 946 / 1,888 / 2,832, standing, facing -y
MeshData tooth();  ///< 1,202 / 2,400 / 3,600, a molar: four cusps above, two roots below

// Simple shapes.

/// A sphere of radius 1 of `rings` circles of `segments` vertices and two poles, with rings ≥ 1, segments
/// ≥ 3.
MeshData sphere(std::uint32_t segments, std::uint32_t rings, Faces faces = Faces::triangles);

/// A closed torus of `around` times `across` vertices, both ≥ 3. The tube's middle is a circle in z = 0.
MeshData torus(std::uint32_t around, std::uint32_t across, double radius, double tube_radius,
               Faces faces = Faces::triangles);

/// A closed box about the origin of 8 vertices and 6 quads or 12 triangles.
MeshData box(const Eigen::Vector3d& size, Faces faces = Faces::quads);

/// An open sheet about the origin in z = 0, normal +z, of columns × rows cells.
MeshData sheet(std::uint32_t columns, std::uint32_t rows, double width, double height,
               Faces faces = Faces::quads);

}  // namespace graze::models
