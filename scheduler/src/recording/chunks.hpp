#pragma once

#include <array>
#include <cstdint>
#include <graze/mesh.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "core/mesh/indexed_mesh.hpp"
#include "recording/archive.hpp"
#include "recording/byte_buffer.hpp"
#include "recording/recorded_rows.hpp"
#include "recording/records.hpp"

namespace graze {

// The parts of a recording in a file, which docs/recording.md describes. All chunks begin at a multiple of 8.

/// The version that is written. Others are refused by name.
inline constexpr std::uint32_t recording_version = 4;
inline constexpr std::array<char, 8> recording_magic{'G', 'R', 'A', 'Z', 'E', 'R', 'E', 'C'};
inline constexpr std::array<char, 8> end_magic{'G', 'R', 'A', 'Z', 'E', 'E', 'N', 'D'};

enum class ChunkKind : std::uint32_t { settings = 1, mesh, keyframe, step, index };
/// For messages.
[[nodiscard]] const char* name_of(ChunkKind kind);

/// The first bytes of a file.
struct FileHead {
  std::array<char, 8> magic = recording_magic;
  std::uint32_t version = recording_version;
  std::uint32_t checksum = 0;  ///< of magic and version

  static constexpr std::size_t size = 16;
};
/// The head of a chunk, before its payload.
struct ChunkHead {
  ChunkKind kind{};
  std::uint32_t payload_checksum = 0;
  std::uint64_t payload_size = 0;  ///< a multiple of 8: the payload is padded with zeros
  std::uint64_t number = 0;        ///< of a frame or of a mesh
  std::uint32_t reserved = 0;
  std::uint32_t checksum = 0;  ///< of the fields before

  static constexpr std::size_t size = 32;
};
/// The last bytes of a file that was finished.
struct FileEnd {
  std::uint64_t index_offset = 0;
  std::array<char, 8> magic = end_magic;
  std::uint32_t dropped = 0;   ///< frames that were dropped after the last step
  std::uint32_t checksum = 0;  ///< of the fields before

  static constexpr std::size_t size = 24;
};

/// A chunk's place in the file.
struct IndexEntry {
  ChunkKind kind{};
  std::uint64_t number = 0;
  std::uint64_t offset = 0;
};

/// The payload of the first chunk.
struct SettingsChunk {
  std::string made_by;  ///< the version of graze
  SceneSettings settings;
  bool is_cut = false;  ///< it begins amid a run, so that phases and ages may differ from what it says
};
/// The payload of a mesh.
struct MeshChunk {
  PositionView rest;
  std::vector<std::uint32_t> corners;
  std::vector<std::uint8_t> corner_counts;
};
/// The beginning of a step's payload. Records follow.
struct StepHead {
  std::uint64_t hash = 0;            ///< `hash_of` the report
  std::uint64_t dropped_before = 0;  ///< frames that were dropped between this one and the one before
  bool is_fresh = false;             ///< its records make the scene from an empty one
  bool has_rows_of_last = false;     ///< the rows are those of the frame before, and left out here
  RecordedReport report;
  std::uint64_t record_count = 0;
};

template <Is<FileHead> T>
auto fields(T& r) {
  return std::tie(r.magic, r.version, r.checksum);
}
template <Is<ChunkHead> T>
auto fields(T& r) {
  return std::tie(r.kind, r.payload_checksum, r.payload_size, r.number, r.reserved, r.checksum);
}
template <Is<FileEnd> T>
auto fields(T& r) {
  return std::tie(r.index_offset, r.magic, r.dropped, r.checksum);
}
template <Is<IndexEntry> T>
auto fields(T& r) {
  return std::tie(r.kind, r.number, r.offset);
}
template <Is<SettingsChunk> T>
auto fields(T& r) {
  return std::tie(r.made_by, r.settings, r.is_cut);
}
template <Is<MeshChunk> T>
auto fields(T& r) {
  return std::tie(r.rest, r.corners, r.corner_counts);
}
template <Is<StepHead> T>
auto fields(T& r) {
  return std::tie(r.hash, r.dropped_before, r.is_fresh, r.has_rows_of_last, r.report, r.record_count);
}

/// Writes a head or an end with its checksum, which is its last field.
template <typename Head>
void write_checked(ByteBuffer& buffer, Head head);
/// Reads a head or an end. Returns false where its checksum is not that of its fields.
template <typename Head>
[[nodiscard]] bool read_checked(std::span<const std::byte> bytes, Head& head);

/// Empties a buffer, and leaves room for the head of a chunk. The payload is to follow.
void begin_chunk(ByteBuffer& chunk);
/// Pads the payload and writes the head before it.
void seal_chunk(ByteBuffer& chunk, ChunkKind kind, std::uint64_t number);

/// The number of a kind of record in a recording.
template <typename OneRecord, typename... Kinds>
[[nodiscard]] constexpr std::uint8_t kind_number(const std::variant<Kinds...>*) {
  std::uint8_t number = 0;
  (void)((std::is_same_v<OneRecord, Kinds> || (++number, false)) || ...);
  return number;
}
/// Writes a record, with the number of its kind.
template <typename OneRecord>
void write_record(ByteBuffer& buffer, const OneRecord& record) {
  ByteSink sink(buffer);
  sink(kind_number<OneRecord>(static_cast<const Record*>(nullptr)));
  sink(record);
}
inline void write_record(ByteBuffer& buffer, const Record& record) {
  std::visit([&](const auto& one) { write_record(buffer, one); }, record);
}
/// Reads the next record. Throws Error where there is none.
[[nodiscard]] Record read_record(ByteSource& source);
/// Appends records that were written into a buffer of their own. Their positions stay aligned.
void append_records(ByteBuffer& chunk, std::span<const std::byte> records);
/// Calls `visit(record)` with so many records that were appended.
template <typename Visit>
void visit_records(ByteSource& source, std::uint64_t count, const Visit& visit) {
  source.align();
  for (std::uint64_t i = 0; i < count; ++i) visit(read_record(source));
}

[[nodiscard]] MeshChunk mesh_chunk_of(const IndexedMesh& mesh);
/// The mesh of a chunk.
[[nodiscard]] Mesh mesh_in(const MeshChunk& chunk);
/// The chunk of a mesh.
void write_mesh(ByteBuffer& chunk, const IndexedMesh& mesh, std::uint64_t number);
[[nodiscard]] std::shared_ptr<const Mesh> read_mesh(ByteSource& source);

}  // namespace graze
