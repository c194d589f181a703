#include <graze/error.hpp>
#include <graze/mesh.hpp>

#include "core/mesh/indexed_mesh.hpp"

namespace graze {

Mesh::Mesh(std::shared_ptr<const IndexedMesh> indexed) : indexed_(std::move(indexed)) {}

Mesh Mesh::from_triangles(PositionView rest, std::span<const std::array<std::uint32_t, 3>> triangles) {
  return from_corners(rest, 3, triangles);
}

Mesh Mesh::from_quads(PositionView rest, std::span<const std::array<std::uint32_t, 4>> quads) {
  return from_corners(rest, 4, quads);
}

Mesh Mesh::from_flat(PositionView rest, std::uint32_t each, std::span<const std::uint32_t> corners) {
  if (corners.size() % each != 0)
    throw Error("mesh: " + std::to_string(corners.size()) + " corners are no whole number of faces of " +
                std::to_string(each));
  return from_polygons(rest, corners, std::vector<std::uint32_t>(corners.size() / each, each));
}

Mesh Mesh::from_polygons(PositionView rest, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> corner_counts) {
  return Mesh(std::make_shared<const IndexedMesh>(rest, corners, corner_counts));
}

std::uint32_t Mesh::vertex_count() const {
  return indexed_->vertex_count();
}
std::uint32_t Mesh::face_count() const {
  return indexed_->face_count();
}
std::uint32_t Mesh::edge_count() const {
  return indexed_->edge_count();
}
std::span<const Eigen::Vector3d> Mesh::rest() const {
  return indexed_->rest();
}
std::span<const std::uint32_t> Mesh::face(std::uint32_t index) const {
  return indexed_->face(index);
}
std::span<const std::uint32_t> Mesh::face_edges(std::uint32_t index) const {
  return indexed_->face_edges(index);
}
std::array<std::uint32_t, 2> Mesh::edge(std::uint32_t index) const {
  return indexed_->edge(index);
}
std::span<const std::uint32_t> Mesh::vertex_neighbours(std::uint32_t vertex) const {
  return indexed_->vertex_neighbours(vertex);
}
std::span<const std::uint32_t> Mesh::vertex_faces(std::uint32_t vertex) const {
  return indexed_->vertex_faces(vertex);
}
std::span<const std::uint32_t> Mesh::edge_faces(std::uint32_t edge) const {
  return indexed_->edge_faces(edge);
}
bool Mesh::is_used(std::uint32_t vertex) const {
  return indexed_->is_used(vertex);
}
bool Mesh::uses_all_vertices() const {
  return indexed_->uses_all_vertices();
}
std::size_t Mesh::byte_count() const {
  return sizeof(Mesh) + indexed_->byte_count();
}

}  // namespace graze
