#include "recording/chunks.hpp"

#include <algorithm>
#include <utility>

#include "recording/crc32.hpp"

namespace graze {
namespace {

constexpr std::size_t checksum_size = sizeof(std::uint32_t);

/// Reads the record of a kind by its place in the list of records.
template <std::size_t... kinds>
Record read_record_of(ByteSource& source, std::size_t kind, std::index_sequence<kinds...>) {
  Record record;
  const auto read = [&]<std::size_t place>() {
    source(record.emplace<place>());
    return true;
  };
  if (!((kind == kinds && read.template operator()<kinds>()) || ...))
    throw Error("a record is of kind " + std::to_string(kind) + ", which is not known");
  return record;
}

}  // namespace

const char* name_of(ChunkKind kind) {
  switch (kind) {
    case ChunkKind::settings:
      return "settings";
    case ChunkKind::mesh:
      return "mesh";
    case ChunkKind::keyframe:
      return "keyframe";
    case ChunkKind::step:
      return "frame";
    case ChunkKind::index:
      return "index";
  }
  return "unknown";
}

template <typename Head>
void write_checked(ByteBuffer& buffer, Head head) {
  const std::size_t begin = buffer.size();
  ByteSink sink(buffer);
  sink(head);
  const std::size_t covered = Head::size - checksum_size;
  head.checksum = crc32(std::as_const(buffer).bytes().subspan(begin, covered));
  buffer.shrink(begin + covered);
  sink(head.checksum);
}

template <typename Head>
bool read_checked(std::span<const std::byte> bytes, Head& head) {
  ByteSource source(bytes);
  source(head);
  return head.checksum == crc32(bytes.first(Head::size - checksum_size));
}

template void write_checked(ByteBuffer& buffer, FileHead head);
template void write_checked(ByteBuffer& buffer, ChunkHead head);
template void write_checked(ByteBuffer& buffer, FileEnd head);
template bool read_checked(std::span<const std::byte> bytes, FileHead& head);
template bool read_checked(std::span<const std::byte> bytes, ChunkHead& head);
template bool read_checked(std::span<const std::byte> bytes, FileEnd& head);

void begin_chunk(ByteBuffer& chunk) {
  chunk.clear();
  chunk.grow(ChunkHead::size);
}

void seal_chunk(ByteBuffer& chunk, ChunkKind kind, std::uint64_t number) {
  align(chunk);
  const std::span<const std::byte> payload = std::as_const(chunk).bytes().subspan(ChunkHead::size);
  ByteBuffer head;
  write_checked(head, ChunkHead{kind, crc32(payload), payload.size(), number});
  std::copy_n(head.bytes().begin(), ChunkHead::size, chunk.bytes().begin());
}

void append_records(ByteBuffer& chunk, std::span<const std::byte> records) {
  align(chunk);
  chunk.append(records);
}

Record read_record(ByteSource& source) {
  std::uint8_t kind = 0;
  source(kind);
  return read_record_of(source, kind, std::make_index_sequence<std::variant_size_v<Record>>());
}

MeshChunk mesh_chunk_of(const IndexedMesh& mesh) {
  MeshChunk written;
  written.rest = PositionView(mesh.rest());
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face) {
    const std::span<const std::uint32_t> corners = mesh.face(face);
    written.corners.insert(written.corners.end(), corners.begin(), corners.end());
    written.corner_counts.push_back(static_cast<std::uint8_t>(corners.size()));
  }
  return written;
}

void write_mesh(ByteBuffer& chunk, const IndexedMesh& mesh, std::uint64_t number) {
  begin_chunk(chunk);
  write_fields(chunk, mesh_chunk_of(mesh));
  seal_chunk(chunk, ChunkKind::mesh, number);
}

Mesh mesh_in(const MeshChunk& chunk) {
  return Mesh::from_polygons(chunk.rest, chunk.corners, chunk.corner_counts);
}

std::shared_ptr<const Mesh> read_mesh(ByteSource& source) {
  MeshChunk read;
  source(read);
  return std::make_shared<const Mesh>(mesh_in(read));
}

}  // namespace graze
