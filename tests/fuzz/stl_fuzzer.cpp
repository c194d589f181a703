// An STL file of any bytes, text or binary, is read or refused. What is read has indices in range, no more
// corners than bytes, and becomes meshes or is refused for a position.

#include "byte_reader.hpp"
#include "finding.hpp"
#include "formats/read_stl.hpp"
#include "input_folder.hpp"

namespace graze::fuzz {
namespace {

void run(ByteReader reader) {
  const auto bytes = reader.rest();
  const auto path = write_input("file.stl", bytes);
  io::RawFile file;
  if (!accepts([&] { file = io::read_stl(path); })) return;
  for (const std::string& warning : file.warnings)
    expect(warning.find('\n') == std::string::npos, "a warning of several lines");
  for (io::RawObject& object : file.objects) {
    io::RawSurface& surface = object.surface;
    std::size_t corners = 0;
    for (const std::uint32_t count : surface.corner_counts) corners += count;
    expect(corners == surface.corners.size() && corners <= bytes.size(), "corners that nobody wrote");
    for (const std::uint32_t corner : surface.corners)
      expect(corner < surface.positions.size(), "a corner that names no vertex");
    if (surface.corner_counts.empty()) continue;
    accepts([&] {
      io::cut_large_faces(surface);
      io::make_mesh(path, object.name, surface);
    });
  }
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
