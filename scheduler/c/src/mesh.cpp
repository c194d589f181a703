#include <algorithm>
#include <array>
#include <graze/weld.hpp>

#include "calls.hpp"
#include "handles.hpp"
#include "positions.hpp"

using graze::Mesh;
using graze::c::array;
using graze::c::BadArgument;
using graze::c::given;
using graze::c::guarded;
using graze::c::mesh_of;
using graze::c::view_of;

namespace {

/// Gives the caller a handle of the mesh that `make` returns.
template <typename Make>
graze_status new_mesh(graze_mesh** room, const Make& make) {
  return guarded([&] {
    graze_mesh*& mesh = given(room, "mesh");
    mesh = new graze_mesh{std::make_shared<const Mesh>(make())};
  });
}

/// Returns the corners of faces that have `each` of them.
std::span<const uint32_t> corners_of(const uint32_t* first, std::size_t faces, std::size_t each) {
  if (faces > SIZE_MAX / each / sizeof(uint32_t)) throw BadArgument("more faces than memory can hold");
  return array(first, faces * each, "corners");
}

void copy_if_wanted(const std::vector<uint32_t>& numbers, uint32_t* room) {
  if (room != nullptr) std::ranges::copy(numbers, room);
}

/// Returns a list of one vertex or edge. The number is checked, since the C++ interface does not.
std::span<const uint32_t> list_of(const Mesh& mesh, uint8_t list, uint32_t index) {
  const uint32_t end = list == GRAZE_EDGE_FACES ? mesh.edge_count() : mesh.vertex_count();
  if (index >= end) throw BadArgument("index is " + std::to_string(index) + " of " + std::to_string(end));
  switch (list) {
    case GRAZE_VERTEX_NEIGHBOURS:
      return mesh.vertex_neighbours(index);
    case GRAZE_VERTEX_FACES:
      return mesh.vertex_faces(index);
    case GRAZE_EDGE_FACES:
      return mesh.edge_faces(index);
    default:
      throw BadArgument("list is " + std::to_string(list) + ", which names no list");
  }
}

const std::vector<uint32_t>& oddities_of(const graze::MeshOddities& oddities, uint8_t list) {
  switch (list) {
    case GRAZE_DEGENERATE_FACES:
      return oddities.degenerate_faces;
    case GRAZE_DUPLICATE_FACES:
      return oddities.duplicate_faces;
    case GRAZE_ISOLATED_VERTICES:
      return oddities.isolated_vertices;
    case GRAZE_DUPLICATE_VERTICES:
      return oddities.duplicate_vertices;
    case GRAZE_NON_MANIFOLD_EDGES:
      return oddities.non_manifold_edges;
    case GRAZE_BORDER_EDGES:
      return oddities.border_edges;
    case GRAZE_FLIPPED_EDGES:
      return oddities.flipped_edges;
    default:
      throw BadArgument("list is " + std::to_string(list) + ", which names no list");
  }
}

}  // namespace

extern "C" {

graze_status graze_mesh_from_triangles(const graze_positions* rest, const uint32_t* corners,
                                       size_t triangle_count, graze_mesh** mesh) {
  return new_mesh(mesh, [&] {
    return Mesh::from_triangles(view_of(rest, "rest"), corners_of(corners, triangle_count, 3));
  });
}

graze_status graze_mesh_from_quads(const graze_positions* rest, const uint32_t* corners, size_t quad_count,
                                   graze_mesh** mesh) {
  return new_mesh(
      mesh, [&] { return Mesh::from_quads(view_of(rest, "rest"), corners_of(corners, quad_count, 4)); });
}

graze_status graze_mesh_from_polygons(const graze_positions* rest, const uint32_t* corners,
                                      size_t corner_count, const uint32_t* corner_counts, size_t face_count,
                                      graze_mesh** mesh) {
  return new_mesh(mesh, [&] {
    return Mesh::from_polygons(view_of(rest, "rest"), array(corners, corner_count, "corners"),
                               array(corner_counts, face_count, "corner_counts"));
  });
}

graze_status graze_mesh_weld(const graze_mesh* mesh, double distance, uint32_t* new_vertex_of_old,
                             uint32_t* new_face_of_old, graze_mesh** welded) {
  return new_mesh(welded, [&] {
    const graze::WeldedMesh made = graze::weld(mesh_of(mesh), distance);
    copy_if_wanted(made.new_of_old, new_vertex_of_old);
    copy_if_wanted(made.new_face_of_old, new_face_of_old);
    return made.mesh;
  });
}

graze_status graze_mesh_share(const graze_mesh* mesh, graze_mesh** shared) {
  return guarded([&] { graze::c::give_mesh(given(mesh, "mesh").mesh, shared); });
}

void graze_mesh_release(graze_mesh* mesh) {
  delete mesh;
}

uint32_t graze_mesh_vertex_count(const graze_mesh* mesh) {
  return mesh ? mesh->mesh->vertex_count() : 0;
}

uint32_t graze_mesh_face_count(const graze_mesh* mesh) {
  return mesh ? mesh->mesh->face_count() : 0;
}

uint32_t graze_mesh_edge_count(const graze_mesh* mesh) {
  return mesh ? mesh->mesh->edge_count() : 0;
}

size_t graze_mesh_corner_count(const graze_mesh* mesh) {
  if (mesh == nullptr) return 0;
  size_t count = 0;
  for (uint32_t face = 0; face < mesh->mesh->face_count(); ++face) count += mesh->mesh->face(face).size();
  return count;
}

const double* graze_mesh_rest(const graze_mesh* mesh) {
  return mesh ? mesh->mesh->rest().data()->data() : nullptr;
}

graze_status graze_mesh_faces(const graze_mesh* mesh, uint32_t* corners, uint32_t* corner_counts) {
  return guarded([&] {
    const Mesh& read = mesh_of(mesh);
    for (uint32_t face = 0; face < read.face_count(); ++face) {
      const auto of_face = read.face(face);
      if (corners != nullptr) corners = std::ranges::copy(of_face, corners).out;
      if (corner_counts != nullptr) corner_counts[face] = static_cast<uint32_t>(of_face.size());
    }
  });
}

graze_status graze_mesh_face_edges(const graze_mesh* mesh, uint32_t* edges) {
  return guarded([&] {
    const Mesh& read = mesh_of(mesh);
    uint32_t* next = &given(edges, "edges");
    for (uint32_t face = 0; face < read.face_count(); ++face)
      next = std::ranges::copy(read.face_edges(face), next).out;
  });
}

graze_status graze_mesh_edges(const graze_mesh* mesh, uint32_t* vertices) {
  return guarded([&] {
    const Mesh& read = mesh_of(mesh);
    uint32_t* next = &given(vertices, "vertices");
    for (uint32_t edge = 0; edge < read.edge_count(); ++edge)
      next = std::ranges::copy(read.edge(edge), next).out;
  });
}

graze_status graze_mesh_list(const graze_mesh* mesh, uint8_t list, uint32_t index, const uint32_t** first,
                             size_t* count) {
  return guarded([&] {
    const auto found = list_of(mesh_of(mesh), list, index);
    given(count, "count") = found.size();
    given(first, "first") = found.data();
  });
}

bool graze_mesh_is_used(const graze_mesh* mesh, uint32_t vertex) {
  return mesh != nullptr && vertex < mesh->mesh->vertex_count() && mesh->mesh->is_used(vertex);
}

bool graze_mesh_uses_all_vertices(const graze_mesh* mesh) {
  return mesh != nullptr && mesh->mesh->uses_all_vertices();
}

size_t graze_mesh_byte_count(const graze_mesh* mesh) {
  return mesh ? mesh->mesh->byte_count() : 0;
}

graze_status graze_mesh_oddities(const graze_mesh* mesh, uint8_t list, uint32_t* found, size_t room,
                                 size_t* count) {
  return guarded([&] {
    const auto to_fill = array(found, room, "found");
    const graze::MeshOddities oddities = graze::find_oddities(mesh_of(mesh));
    const std::vector<uint32_t>& all = oddities_of(oddities, list);
    given(count, "count") = all.size();
    std::copy_n(all.data(), std::min(room, all.size()), to_fill.data());
  });
}

}  // extern "C"
