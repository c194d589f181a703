#include "mesh/raw_object.hpp"

#include <algorithm>
#include <graze/io/error.hpp>

#include "mesh/triangulate.hpp"
#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

void require_finite(const std::filesystem::path& path, const std::string& object, const RawSurface& surface,
                    std::span<const std::uint32_t> file_vertices) {
  std::size_t begin = 0;
  for (std::size_t face = 0; face < surface.corner_counts.size(); ++face) {
    for (const auto vertex : std::span(surface.corners).subspan(begin, surface.corner_counts[face]))
      if (!surface.positions[vertex].allFinite())
        fail(path,
             joined("object '", object, "': vertex ", file_vertices.empty() ? vertex : file_vertices[vertex],
                    " (counted from 0), used by face ", face,
                    ", is not finite; give it numbers or remove the face"));
    begin += surface.corner_counts[face];
  }
}

}  // namespace

void turn_faces(RawSurface& surface) {
  auto begin = surface.corners.begin();
  for (const auto count : surface.corner_counts) {
    std::reverse(begin + 1, begin + count);
    begin += count;
  }
}

void turn_faces(RawSurface& surface, const std::vector<bool>& is_marked) {
  auto begin = surface.corners.begin();
  for (const auto count : surface.corner_counts) {
    const auto end = begin + count;
    const auto marked = std::count_if(begin, end, [&](std::uint32_t vertex) { return is_marked[vertex]; });
    if (2 * marked > static_cast<std::ptrdiff_t>(count)) std::reverse(begin + 1, end);
    begin = end;
  }
}

CutFaces cut_large_faces(RawSurface& surface) {
  CutFaces cut;
  RawSurface result;
  std::size_t begin = 0;
  for (std::size_t number = 0; number < surface.corner_counts.size(); ++number) {
    const std::uint32_t count = surface.corner_counts[number];
    const auto face = std::span<const std::uint32_t>(surface.corners).subspan(begin, count);
    begin += count;
    if (count <= 4) {
      result.add_face(face);
      continue;
    }
    const auto triangles = triangulate(surface.positions, face);
    if (!triangles) return {0, 0, number};
    for (const auto& triangle : *triangles) result.add_face(triangle);
    ++cut.faces;
    cut.triangles += triangles->size();
  }
  if (cut.faces > 0) {
    surface.corners = std::move(result.corners);
    surface.corner_counts = std::move(result.corner_counts);
  }
  return cut;
}

std::shared_ptr<const Mesh> make_mesh(const std::filesystem::path& path, const std::string& object,
                                      const RawSurface& surface,
                                      std::span<const std::uint32_t> file_vertices) {
  require_finite(path, object, surface, file_vertices);
  try {
    return std::make_shared<const Mesh>(
        Mesh::from_polygons(surface.positions, surface.corners, surface.corner_counts));
  } catch (const Error& error) {
    fail(path, joined("object '", object, "': ", error.what()));
  }
}

}  // namespace graze::io
