#include "mesh_text.hpp"

#include <charconv>
#include <span>

namespace graze::fuzz {
namespace {

std::string shortest(double number) {
  std::array<char, 32> digits;
  const auto* const end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), static_cast<std::size_t>(end - digits.data())};
}

std::string header(MeshFormat format, std::size_t vertices, std::size_t faces) {
  if (format == MeshFormat::obj) return "# a surface\n";
  if (format == MeshFormat::off)
    return "OFF\n" + std::to_string(vertices) + " " + std::to_string(faces) + " 0\n";
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(faces) +
         "\nproperty list uint uint vertex_indices\nend_header\n";
}

}  // namespace

std::string extension_of(MeshFormat format) {
  if (format == MeshFormat::obj) return ".obj";
  return format == MeshFormat::ply ? ".ply" : ".off";
}

std::string mesh_text(MeshFormat format, const io::RawSurface& surface) {
  const bool is_obj = format == MeshFormat::obj;
  std::string text = header(format, surface.positions.size(), surface.corner_counts.size());
  for (const Eigen::Vector3d& p : surface.positions)
    text += (is_obj ? "v " : "") + shortest(p.x()) + " " + shortest(p.y()) + " " + shortest(p.z()) + "\n";
  std::size_t begin = 0;
  for (const std::uint32_t count : surface.corner_counts) {
    text += is_obj ? "f" : std::to_string(count);
    for (const std::uint32_t corner : std::span(surface.corners).subspan(begin, count))
      text += " " + std::to_string(corner + (is_obj ? 1U : 0U));
    text += "\n";
    begin += count;
  }
  return text;
}

}  // namespace graze::fuzz
