// Vertex caches and numbered sequences for a mesh of a few vertices. The first byte chooses the kind, the
// second the number of vertices. The rest is the cache, or the sequence's files, each behind its length in
// two bytes.

#include <bit>
#include <cmath>
#include <graze/io/motion.hpp>

#include "byte_reader.hpp"
#include "finding.hpp"
#include "fuzz/files/mesh_text.hpp"
#include "input_folder.hpp"

namespace graze::fuzz {
namespace {

using Positions = std::vector<Eigen::Vector3d>;

Mesh fan(std::uint32_t vertex_count) {
  const Positions rest(vertex_count, Eigen::Vector3d::Zero());
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1 % vertex_count, 2 % vertex_count}};
  return Mesh::from_triangles(rest, faces);
}

bool same_bits(const Positions& a, const Positions& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (const Eigen::Index axis : {0, 1, 2})
      if (std::bit_cast<std::uint64_t>(a[i][axis]) != std::bit_cast<std::uint64_t>(b[i][axis])) return false;
  return true;
}

/// The float that stands `offset` bytes into the file.
double float_at(std::span<const std::uint8_t> bytes, std::size_t offset, bool is_big_endian) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i)
    word |= std::uint32_t{bytes[offset + i]} << (8 * (is_big_endian ? 3 - i : i));
  return static_cast<double>(std::bit_cast<float>(word));
}

/// Every frame against the bytes themselves.
void check_cache(std::span<const std::uint8_t> bytes, bool is_pc2, std::uint32_t vertex_count,
                 io::PositionSource& source) {
  const std::size_t begin = is_pc2 ? 32 : 8 + std::size_t{4} * source.frame_count();
  const std::size_t frame_bytes = std::size_t{12} * vertex_count;
  expect(begin + source.frame_count() * frame_bytes <= bytes.size(), "more frames than bytes");
  Positions positions;
  for (std::uint32_t frame = 0; frame < source.frame_count(); ++frame) {
    source.read(frame, positions);
    expect(positions.size() == vertex_count, "another number of positions than vertices");
    for (std::size_t i = 0; i < 3 * std::size_t{vertex_count}; ++i) {
      const double expected = float_at(bytes, begin + frame * frame_bytes + 4 * i, !is_pc2);
      const double read = positions[i / 3][static_cast<Eigen::Index>(i % 3)];
      expect(read == expected || (std::isnan(read) && std::isnan(expected)),
             "another number than the file's");
    }
  }
}

void check_last_holds(io::PositionSource& source) {
  expect(source.frame_count() >= 1, "a motion without a frame");
  Positions last;
  Positions beyond;
  if (!accepts([&] { source.read(source.frame_count() - 1, last); })) return;
  source.read(~std::uint32_t{0}, beyond);
  expect(same_bits(last, beyond), "the last frame does not hold");
}

void run_cache(ByteReader reader, bool is_named_pc2, const Mesh& mesh) {
  const std::span<const std::uint8_t> bytes = reader.rest();
  const auto path = write_input(is_named_pc2 ? "cache.pc2" : "cache.mdd", bytes);
  std::unique_ptr<io::PositionSource> source;
  if (!accepts([&] { source = io::open_vertex_cache(path, mesh); })) return;
  const bool is_pc2 = reader.text(12) == std::string("POINTCACHE2\0", 12);
  check_cache(bytes, is_pc2, mesh.vertex_count(), *source);
  check_last_holds(*source);
}

void run_sequence(ByteReader reader, MeshFormat format, const Mesh& mesh) {
  constexpr std::uint32_t most_files = 4;
  std::uint32_t count = 0;
  for (; count < most_files && !reader.at_end(); ++count)
    input_folder().write("frame_" + std::to_string(count) + extension_of(format),
                         reader.text(reader.below(65536)));
  for (std::uint32_t old = count; old < most_files; ++old)
    std::filesystem::remove(input_folder() / ("frame_" + std::to_string(old) + extension_of(format)));
  std::unique_ptr<io::PositionSource> source;
  const auto pattern = input_folder() / ("frame_#" + extension_of(format));
  const bool opened = accepts([&] { source = io::open_sequence(pattern, mesh, 0); });
  if (!opened) return;
  expect(source->frame_count() == count, "another number of frames than files");
  for (std::uint32_t frame = 0; frame < count; ++frame) {
    Positions positions;
    if (accepts([&] { source->read(frame, positions); }))
      expect(positions.size() == mesh.vertex_count(), "another number of positions than vertices");
  }
  check_last_holds(*source);
}

void run(ByteReader reader) {
  constexpr std::uint32_t caches = 2;
  const std::uint32_t kind = reader.below(caches + mesh_formats.size());
  const Mesh mesh = fan(1 + reader.below(8));
  if (kind < caches)
    run_cache(reader, kind == 0, mesh);
  else
    run_sequence(reader, mesh_formats[kind - caches], mesh);
}

}  // namespace
}  // namespace graze::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  graze::fuzz::run(graze::fuzz::ByteReader({data, size}));
  return 0;
}
