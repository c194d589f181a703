#include <cmath>
#include <numbers>

#include "models/models.hpp"
#include "models/surface_grid.hpp"

namespace graze::models {

void MeshData::add_face(std::initializer_list<std::uint32_t> face) {
  corners.insert(corners.end(), face);
  corner_counts.push_back(static_cast<std::uint32_t>(face.size()));
}

void add_cell(MeshData& mesh, const std::array<std::uint32_t, 4>& cell, Faces faces) {
  if (faces == Faces::quads) {
    mesh.add_face({cell[0], cell[1], cell[2], cell[3]});
  } else {
    mesh.add_face({cell[0], cell[1], cell[2]});
    mesh.add_face({cell[0], cell[2], cell[3]});
  }
}

Eigen::Vector2d on_circle(std::uint32_t index, std::uint32_t count) {
  const double angle = 2 * std::numbers::pi * index / count;
  return {std::cos(angle), std::sin(angle)};
}

MeshData sphere(std::uint32_t segments, std::uint32_t rings, Faces faces) {
  std::vector<ProfilePoint> profile;
  for (std::uint32_t ring = 1; ring <= rings; ++ring) {
    const double angle = std::numbers::pi * ring / (rings + 1);
    profile.push_back({std::sin(angle), -std::cos(angle)});
  }
  return revolved(profile, -1, 1, segments, faces);
}

MeshData torus(std::uint32_t around, std::uint32_t across, double radius, double tube_radius, Faces faces) {
  MeshData mesh;
  for (std::uint32_t i = 0; i < around; ++i) {
    const Eigen::Vector2d outward = on_circle(i, around);
    for (std::uint32_t j = 0; j < across; ++j) {
      const Eigen::Vector2d tube = on_circle(j, across) * tube_radius;
      const double reach = radius + tube.x();
      mesh.positions.emplace_back(outward.x() * reach, outward.y() * reach, tube.y());
    }
  }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return (i % around) * across + j % across; };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j)
      add_cell(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}, faces);
  return mesh;
}

MeshData box(const Eigen::Vector3d& size, Faces faces) {
  MeshData mesh;
  for (unsigned i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1U, (i >> 1U) & 1U, i >> 2U);
    mesh.positions.emplace_back(size.cwiseProduct(corner - Eigen::Vector3d::Constant(0.5)));
  }
  const std::array<std::array<std::uint32_t, 4>, 6> sides = {
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& side : sides) add_cell(mesh, side, faces);
  return mesh;
}

MeshData sheet(std::uint32_t columns, std::uint32_t rows, double width, double height, Faces faces) {
  MeshData mesh;
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t column = 0; column <= columns; ++column)
      mesh.positions.emplace_back(width * (static_cast<double>(column) / columns - 0.5),
                                  height * (static_cast<double>(row) / rows - 0.5), 0);
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t low = row * (columns + 1) + column;
      const std::uint32_t high = low + columns + 1;
      add_cell(mesh, {low, low + 1, high + 1, high}, faces);
    }
  }
  return mesh;
}

}  // namespace graze::models
