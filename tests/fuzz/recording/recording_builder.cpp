#include "fuzz/recording/recording_builder.hpp"

#include "core/mesh/indexed_mesh.hpp"
#include "recording/chunks.hpp"

namespace graze::fuzz {
namespace {

ByteBuffer bytes_of_records(std::span<const Record> records) {
  ByteBuffer bytes;
  for (const Record& record : records) write_record(bytes, record);
  return bytes;
}

}  // namespace

RecordingBuilder::RecordingBuilder(const std::filesystem::path& path, const SceneSettings& settings)
    : output_(path) {
  begin_chunk(chunk_);
  write_fields(chunk_, SettingsChunk{"0.0.0", settings, false});
  put(ChunkKind::settings, 0);
}

void RecordingBuilder::add_mesh(const Mesh& mesh) {
  write_mesh(chunk_, indexed(mesh), meshes_);
  output_.put(ChunkKind::mesh, meshes_++, chunk_);
}

void RecordingBuilder::add_keyframe(std::span<const Record> records) {
  begin_chunk(chunk_);
  write_fields(chunk_, std::uint64_t{records.size()});
  append_records(chunk_, bytes_of_records(records).bytes());
  put(ChunkKind::keyframe, steps_ + 1);
}

void RecordingBuilder::add_step(std::span<const Record> records, const std::vector<RecordedRow>& rows,
                                bool is_fresh) {
  StepHead head;
  head.is_fresh = is_fresh;
  head.report.frame = ++steps_;
  head.report.pairs = rows.size();
  head.report.rows = rows;
  head.hash = hash_of(head.report);
  head.record_count = records.size();
  begin_chunk(chunk_);
  write_fields(chunk_, head);
  append_records(chunk_, bytes_of_records(records).bytes());
  put(ChunkKind::step, steps_);
}

void RecordingBuilder::put(ChunkKind kind, std::uint64_t number) {
  seal_chunk(chunk_, kind, number);
  output_.put(kind, number, chunk_);
}

}  // namespace graze::fuzz
