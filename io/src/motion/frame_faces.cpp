#include "motion/frame_faces.hpp"

#include <algorithm>
#include <span>

#include "text/file_bytes.hpp"

namespace graze::io {
namespace {

std::uint64_t edge_of(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
}

}  // namespace

FrameFaces::FrameFaces(const Mesh& mesh) {
  for (std::uint32_t index = 0; index < mesh.face_count(); ++index) {
    const auto face = mesh.face(index);
    triangles_ += face.size() - 2;
    for (std::size_t i = 0; i < face.size(); ++i)
      edges_.push_back(edge_of(face[i], face[(i + 1) % face.size()]));
  }
  std::ranges::sort(edges_);
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
}

bool FrameFaces::is_known(std::span<const std::uint32_t> face) const {
  for (std::size_t i = 0; i < face.size(); ++i)
    if (!std::ranges::binary_search(edges_, edge_of(face[i], face[(i + 1) % face.size()]))) return false;
  return true;
}

std::string FrameFaces::difference(const RawSurface& frame) {
  if (frame.corner_counts.empty() || frame.corners == last_corners_) return "";
  std::size_t begin = 0;
  std::size_t triangles = 0;
  std::size_t unknown = 0;
  for (const std::uint32_t count : frame.corner_counts) {
    if (!is_known(std::span(frame.corners).subspan(begin, count))) ++unknown;
    begin += count;
    triangles += count - 2;
  }
  if (unknown > 0)
    return joined(unknown, " of its ", frame.corner_counts.size(),
                  " faces are not the mesh's, so its vertices may be in another order");
  if (triangles != triangles_)
    return joined("its faces have ", triangles, " triangles and the mesh's ", triangles_);
  last_corners_ = frame.corners;
  return "";
}

}  // namespace graze::io
