#include "writers.hpp"

#include <bit>
#include <cstdint>
#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>

namespace graze::demo {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are little endian");

template <typename Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Calls visit(the corners of a face) for each face.
template <typename Visit>
void for_each_face(const models::MeshData& mesh, Visit visit) {
  std::size_t first = 0;
  for (const std::uint32_t count : mesh.corner_counts) {
    visit(std::span(mesh.corners).subspan(first, count));
    first += count;
  }
}

}  // namespace

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(path.string() + ": cannot be written; check its folder");
}

void write_obj(const std::filesystem::path& path, const models::MeshData& mesh) {
  std::ostringstream text;
  text.precision(9);
  for (const Eigen::Vector3d& point : mesh.positions)
    text << "v " << point.x() << ' ' << point.y() << ' ' << point.z() << '\n';
  for_each_face(mesh, [&](std::span<const std::uint32_t> corners) {
    text << 'f';
    for (const std::uint32_t corner : corners) text << ' ' << corner + 1;
    text << '\n';
  });
  write_text(path, text.str());
}

void write_ply(const std::filesystem::path& path, const models::MeshData& mesh) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(mesh.corner_counts.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (const Eigen::Vector3d& point : mesh.positions)
    for (int axis = 0; axis < 3; ++axis) append(bytes, point[axis]);
  for_each_face(mesh, [&](std::span<const std::uint32_t> corners) {
    append(bytes, static_cast<std::uint8_t>(corners.size()));
    for (const std::uint32_t corner : corners) append(bytes, corner);
  });
  write_text(path, bytes);
}

void write_pc2(const std::filesystem::path& path, const std::vector<std::vector<Eigen::Vector3d>>& frames) {
  std::string bytes("POINTCACHE2\0", 12);
  append(bytes, std::int32_t{1});
  append(bytes, static_cast<std::int32_t>(frames.front().size()));
  append(bytes, 0.0F);
  append(bytes, 1.0F);
  append(bytes, static_cast<std::int32_t>(frames.size()));
  for (const std::vector<Eigen::Vector3d>& positions : frames)
    for (const Eigen::Vector3d& point : positions)
      for (int axis = 0; axis < 3; ++axis) append(bytes, static_cast<float>(point[axis]));
  write_text(path, bytes);
}

}  // namespace graze::demo
