#include <tiny_obj_loader.h>

#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

/// Faces of 3 and 4 corners of all shapes together, as tinyobjloader reads them.
std::multiset<Corners> oracle_faces(const std::vector<tinyobj::shape_t>& shapes) {
  std::multiset<Corners> faces;
  for (const auto& shape : shapes) {
    std::size_t corner = 0;
    for (const std::size_t count : shape.mesh.num_face_vertices) {
      Corners face;
      for (std::size_t i = 0; i < count; ++i)
        face.push_back(static_cast<std::uint32_t>(shape.mesh.indices[corner + i].vertex_index));
      corner += count;
      if (count <= 4) faces.insert(face);
    }
  }
  return faces;
}

}  // namespace

TEST_CASE("OBJ files of the world are read as tinyobjloader reads them") {
  const auto file =
      GENERATE(as<std::string>(), "organs/body_large_small_intestine.obj", "bodies/chain__10-links.obj",
               "bodies/friction__arch__arch-101-stones.obj", "bodies/mechanisms__gears__chain.obj",
               "poses/cow-poses-2.obj", "caches/max_cache_box_44.obj", "instruments/needle_40mm.obj",
               "nasty/trimesh/quadknot.obj", "nasty/trimesh/negative_indices.obj",
               "nasty/tinyobjloader/cornell_box.obj", "nasty/tinyobjloader/issue-161-inconsistent-f.obj",
               "nasty/manifold/Havocglass8_left.obj");
  const auto path = shared_file(file);
  if (is_missing(path)) return;
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  REQUIRE(tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, path.c_str(), nullptr, false));

  const auto mesh_file = MeshFile::read(path);
  std::multiset<Corners> faces;
  for (const auto& object : mesh_file.objects()) {
    const bool is_whole = object.file_vertices.empty();
    const std::size_t vertices = is_whole ? object.mesh->vertex_count() : object.file_vertex_count;
    REQUIRE(vertices * 3 == attributes.vertices.size());
    for (auto face : faces_of(*object.mesh)) {
      for (auto& corner : face) corner = is_whole ? corner : object.file_vertices[corner];
      faces.insert(face);
    }
  }
  CHECK(faces == oracle_faces(shapes));
  double largest = 0;
  const auto& first = mesh_file.objects()[0];
  const auto rest = first.mesh->rest();
  for (std::size_t i = 0; i < rest.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t vertex = first.file_vertices.empty() ? i : first.file_vertices[i];
      const double oracle = attributes.vertices[3 * vertex + axis];
      largest = std::max(largest, std::abs(rest[i][static_cast<Eigen::Index>(axis)] - oracle) /
                                      std::max(std::abs(oracle), 1e-3));
    }
  CHECK(largest < 1e-12);
}
