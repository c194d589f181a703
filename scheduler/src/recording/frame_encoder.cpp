#include "recording/frame_encoder.hpp"

#include <utility>
#include <variant>

namespace graze {

void FrameEncoder::write_settings(const SceneSettings& settings, bool is_cut) {
  chunk_.clear();
  chunk_.grow(ChunkHead::size);
  write_fields(chunk_, SettingsChunk{GRAZE_VERSION, settings, is_cut});
  seal_chunk(chunk_, ChunkKind::settings, 0);
  output_.put(ChunkKind::settings, 0, chunk_);
}

void FrameEncoder::write_frame(const CapturedFrame& frame) {
  for (const auto& [number, mesh] : frame.new_meshes) write_mesh(*mesh, number);
  StepHead head;
  head.is_fresh = frame.is_fresh;
  head.dropped_before = frame.dropped_before;
  std::swap(head.report, report_);  // for its memory
  summarize(*frame.report, head.report);
  write_keyframe(head.report.frame, frame.is_fresh);
  write_step(std::move(head), frame.records.bytes(), frame.record_count);
}

void FrameEncoder::write_mesh(const IndexedMesh& mesh, std::uint32_t number) {
  chunk_.clear();
  graze::write_mesh(chunk_, mesh, number);
  output_.put(ChunkKind::mesh, number, chunk_);
}

void FrameEncoder::write_keyframe(std::uint64_t frame, bool is_fresh) {
  if (is_fresh) model_.clear();
  if (has_keyframe_ && !is_fresh && ++steps_since_keyframe_ < keyframe_interval_) return;
  has_keyframe_ = true;
  steps_since_keyframe_ = 0;
  has_last_rows_ = false;  // whoever begins here does not know them
  kept_records_.clear();
  kept_count_ = 0;
  std::vector<std::uint32_t> meshes;
  model_.rebuild([&](const Record& record) {
    keep_record(record);
    if (const auto* const added = std::get_if<AddRecord>(&record)) meshes.push_back(added->mesh);
  });
  chunk_.clear();
  chunk_.grow(ChunkHead::size);
  write_fields(chunk_, kept_count_);
  append_records(chunk_, kept_records_.bytes());
  seal_chunk(chunk_, ChunkKind::keyframe, frame);
  output_.put(ChunkKind::keyframe, frame, chunk_);
  for (const std::uint32_t mesh : meshes) output_.use_mesh(mesh);
}

void FrameEncoder::write_step(StepHead head, std::span<const std::byte> records, std::uint64_t record_count) {
  kept_records_.clear();
  kept_count_ = 0;
  ByteSource source(records);
  visit_records(source, record_count, [&](const Record& record) {
    const auto* const memory = std::get_if<MemoryRecord>(&record);
    if (memory != nullptr && model_.holds(*memory)) return;
    model_.apply(record);
    keep_record(record);
    if (const auto* const added = std::get_if<AddRecord>(&record)) output_.use_mesh(added->mesh);
  });
  head.record_count = kept_count_;
  head.hash = hash_of(head.report);
  head.has_rows_of_last = has_last_rows_ && head.report.rows == last_rows_;
  has_last_rows_ = true;
  std::swap(last_rows_, head.report.rows);
  if (head.has_rows_of_last)
    head.report.rows.clear();
  else
    head.report.rows = last_rows_;
  chunk_.clear();
  chunk_.grow(ChunkHead::size);
  write_fields(chunk_, head);
  append_records(chunk_, kept_records_.bytes());
  seal_chunk(chunk_, ChunkKind::step, head.report.frame);
  output_.put(ChunkKind::step, head.report.frame, chunk_);
  std::swap(report_, head.report);
}

void FrameEncoder::keep_record(const Record& record) {
  write_record(kept_records_, record);
  ++kept_count_;
}

}  // namespace graze
