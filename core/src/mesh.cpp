#include <algorithm>
#include <graze/bytes_of.hpp>
#include <graze/error.hpp>
#include <graze/floating_point_scope.hpp>
#include <graze/mesh.hpp>
#include <string>
#include <unordered_map>

#include "block_order.hpp"
#include "limits.hpp"
#include "vertex_fans.hpp"

namespace graze {
namespace {

/// Rows of values in compressed form: row i is values[begin[i], begin[i + 1]), ascending, each value once.
class Rows {
 public:
  explicit Rows(std::size_t count) : count_(count) {}
  void add(std::uint32_t row, std::uint32_t value) { pairs_.emplace_back(row, value); }
  void write(std::vector<std::uint32_t>& values, std::vector<std::uint32_t>& begin) {
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    begin.assign(count_ + 1, 0);
    values.clear();
    values.reserve(pairs_.size());
    for (const auto& [row, value] : pairs_) {
      ++begin[row + 1];
      values.push_back(value);
    }
    for (std::size_t row = 0; row < count_; ++row) begin[row + 1] += begin[row];
  }

 private:
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
  std::size_t count_;
};

std::vector<Eigen::Vector3d> copy_of(const PositionView& view) {
  if (view.data() == nullptr && view.size() > 0) throw Error("mesh: the rest positions are null memory");
  if (view.size() >= Mesh::no_edge)
    throw Error("mesh: " + std::to_string(view.size()) + " vertices are more than 32-bit numbers name");
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(view.size());
  for (std::size_t i = 0; i < view.size(); ++i) positions.push_back(view[i]);
  return positions;
}

}  // namespace

Mesh Mesh::from_triangles(PositionView rest, std::span<const std::array<std::uint32_t, 3>> triangles) {
  std::vector<std::uint32_t> corners;
  corners.reserve(triangles.size() * 3);
  for (const auto& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return from_polygons(rest, corners, std::vector<std::uint32_t>(triangles.size(), 3));
}

Mesh Mesh::from_quads(PositionView rest, std::span<const std::array<std::uint32_t, 4>> quads) {
  std::vector<std::uint32_t> corners;
  corners.reserve(quads.size() * 4);
  for (const auto& quad : quads) corners.insert(corners.end(), quad.begin(), quad.end());
  return from_polygons(rest, corners, std::vector<std::uint32_t>(quads.size(), 4));
}

Mesh Mesh::from_polygons(PositionView rest, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> corner_counts) {
  const FloatingPointScope scope;
  Mesh mesh;
  mesh.rest_ = copy_of(rest);
  mesh.corners_.assign(corners.begin(), corners.end());
  mesh.face_begin_.reserve(corner_counts.size() + 1);
  std::uint64_t corner = 0;
  mesh.face_begin_.push_back(0);
  for (std::size_t face = 0; face < corner_counts.size(); ++face) {
    if (corner_counts[face] != 3 && corner_counts[face] != 4)
      throw Error("mesh: face " + std::to_string(face) + " has " + std::to_string(corner_counts[face]) +
                  " corners; a face is a triangle or a quad");
    corner += corner_counts[face];
    if (corner > corners.size()) break;
    mesh.face_begin_.push_back(static_cast<std::uint32_t>(corner));
  }
  if (corner != corners.size())
    throw Error("mesh: the faces' corner counts add up to " +
                std::string(corner > corners.size() ? "more than " : "") +
                std::to_string(std::min<std::uint64_t>(corner, corners.size())) + ", but " +
                std::to_string(corners.size()) + " corners were given");
  mesh.check_faces();
  mesh.number_edges();
  mesh.list_incidence();
  list_fans(mesh, mesh.fans_, mesh.fan_begin_);
  mesh.check_rest();
  mesh.look_for_unused();
  mesh.regions_ = RegionTree(mesh);
  mesh.block_order_ = block_order_of(mesh);
  list_stretch_groups(mesh, mesh.stretch_groups_, mesh.stretch_group_begin_);
  return mesh;
}

void Mesh::check_faces() const {
  if (face_count() == 0) throw Error("mesh: it has no face, so it has no surface");
  if (corners_.size() >= no_edge) throw Error("mesh: its faces have more corners than 32-bit numbers count");
  for (std::uint32_t index = 0; index < face_count(); ++index)
    for (const std::uint32_t corner : face(index))
      if (corner >= vertex_count())
        throw Error("mesh: face " + std::to_string(index) + " names vertex " + std::to_string(corner) +
                    ", but there are " + std::to_string(vertex_count()) + " vertices");
}

void Mesh::check_rest() const {
  for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex)
    if (is_used(vertex) && !is_within_limits(rest_[vertex]))
      throw Error("mesh: the rest position of vertex " + std::to_string(vertex) +
                  " is not finite or has a coordinate beyond 2^120");
}

void Mesh::look_for_unused() {
  for (std::uint32_t vertex = 0; vertex < vertex_count(); ++vertex)
    uses_all_vertices_ = uses_all_vertices_ && is_used(vertex);
}

void Mesh::number_edges() {
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  numbers.reserve(corners_.size());
  face_edges_.reserve(corners_.size());
  for (std::uint32_t index = 0; index < face_count(); ++index) {
    const auto ring = face(index);
    for (std::size_t corner = 0; corner < ring.size(); ++corner) {
      const auto [low, high] = std::minmax(ring[corner], ring[(corner + 1) % ring.size()]);
      if (low == high) {
        face_edges_.push_back(no_edge);
        continue;
      }
      const std::uint64_t key = (std::uint64_t{low} << 32) | high;
      const auto [entry, is_new] = numbers.try_emplace(key, edge_count());
      if (is_new) edges_.push_back({low, high});
      face_edges_.push_back(entry->second);
    }
  }
}

void Mesh::list_incidence() {
  Rows neighbours(vertex_count());
  for (const auto& [low, high] : edges_) {
    neighbours.add(low, high);
    neighbours.add(high, low);
  }
  Rows faces_of_vertex(vertex_count());
  Rows faces_of_edge(edge_count());
  for (std::uint32_t index = 0; index < face_count(); ++index) {
    for (const std::uint32_t corner : face(index)) faces_of_vertex.add(corner, index);
    for (const std::uint32_t edge : face_edges(index))
      if (edge != no_edge) faces_of_edge.add(edge, index);
  }
  neighbours.write(neighbours_, neighbour_begin_);
  faces_of_vertex.write(vertex_faces_, vertex_face_begin_);
  faces_of_edge.write(edge_faces_, edge_face_begin_);
}

std::size_t Mesh::byte_count() const {
  return sizeof(Mesh) + bytes_of(rest_) + bytes_of(corners_) + bytes_of(face_begin_) + bytes_of(face_edges_) +
         bytes_of(edges_) + bytes_of(neighbours_) + bytes_of(neighbour_begin_) + bytes_of(vertex_faces_) +
         bytes_of(vertex_face_begin_) + bytes_of(fans_) + bytes_of(fan_begin_) + bytes_of(edge_faces_) +
         bytes_of(edge_face_begin_) + bytes_of(block_order_) + bytes_of(stretch_groups_) +
         bytes_of(stretch_group_begin_) + regions_.byte_count();
}

}  // namespace graze
