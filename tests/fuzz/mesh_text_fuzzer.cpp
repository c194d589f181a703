// OBJ, PLY and OFF: the first byte chooses the format, the rest is the file. What is read is written as each
// of the three in turn and must read back as the same surface.

#include <charconv>
#include <cmath>
#include <graze/io/mesh_file.hpp>

#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/files/mesh_text.hpp"
#include "input_folder.hpp"
#include "mesh/raw_object.hpp"

namespace graze::fuzz {
namespace {

using io::RawFile;
using io::RawSurface;

RawFile read_as(MeshFormat format, const std::filesystem::path& path) {
  if (format == MeshFormat::obj) return io::read_obj(path);
  if (format == MeshFormat::ply) return io::read_ply(path);
  return io::read_off(path);
}

bool same(double a, double b) {
  return a == b ? std::signbit(a) == std::signbit(b) : std::isnan(a) && std::isnan(b);
}

bool same(const RawSurface& a, const RawSurface& b) {
  if (a.corners != b.corners || a.corner_counts != b.corner_counts ||
      a.positions.size() != b.positions.size())
    return false;
  for (std::size_t i = 0; i < a.positions.size(); ++i)
    for (const Eigen::Index axis : {0, 1, 2})
      if (!same(a.positions[i][axis], b.positions[i][axis])) return false;
  return true;
}

void check(const RawSurface& surface, std::size_t byte_count) {
  expect(surface.positions.size() <= byte_count, "more vertices than bytes");
  std::size_t corners = 0;
  for (const std::uint32_t count : surface.corner_counts) {
    expect(count >= 3, "a face of fewer than 3 corners");
    corners += count;
  }
  expect(corners == surface.corners.size(), "corners of no face");
  for (const std::uint32_t corner : surface.corners)
    expect(corner < surface.positions.size(), "a corner that names no vertex");
}

void check_written_again(const RawSurface& surface) {
  for (const MeshFormat format : mesh_formats) {
    const std::string text = mesh_text(format, surface);
    const auto path = input_folder().write("again", text);
    const RawFile again = read_as(format, path);
    expect(again.objects.size() == 1, "a written surface reads as several objects");
    if (!same(again.objects[0].surface, surface))
      finding("a written surface reads back as another:\n" + text);
  }
}

void check_announced(MeshFormat format, const std::filesystem::path& path, std::size_t vertex_count) {
  if (format == MeshFormat::ply)
    expect(io::announced_ply_vertices(path) == vertex_count, "the PLY header announces another count");
  if (format == MeshFormat::off)
    expect(io::announced_off_vertices(path) == vertex_count, "the OFF header announces another count");
}

void check_mesh(const std::filesystem::path& path) {
  const bool taken = accepts([&] {
    const io::MeshFile file = io::MeshFile::read(path);
    expect(!file.objects().empty(), "a mesh file without an object");
    for (const std::string& warning : file.warnings())
      expect(warning.find('\n') == std::string::npos, "a warning of several lines");
    for (const io::LoadedObject& object : file.objects())
      for (std::uint32_t face = 0; face < object.mesh->face_count(); ++face)
        for (const std::uint32_t corner : object.mesh->face(face))
          expect(object.mesh->rest()[corner].allFinite(), "a used vertex that is not finite");
  });
  static_cast<void>(taken);  // a file without faces has a surface and no mesh
}

void run(ByteReader reader) {
  const MeshFormat format = mesh_formats[reader.below(mesh_formats.size())];
  const auto path = write_input("mesh" + extension_of(format), reader.rest());
  RawFile file;
  if (!accepts([&] { file = read_as(format, path); })) return;
  expect(!file.objects.empty(), "no object");
  for (const io::RawObject& object : file.objects) check(object.surface, reader.rest().size());
  check_announced(format, path, file.objects[0].surface.positions.size());
  if (file.objects.size() == 1) check_written_again(file.objects[0].surface);
  check_mesh(path);
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
