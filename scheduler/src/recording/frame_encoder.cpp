#include "recording/frame_encoder.hpp"

#include <utility>
#include <variant>

namespace graze {

void FrameEncoder::write_settings(const SceneSettings& settings, bool is_cut) {
  begin_chunk(chunk_);
  write_fields(chunk_, SettingsChunk{GRAZE_VERSION, settings, is_cut});
  put_chunk(ChunkKind::settings, 0);
}

std::uint64_t FrameEncoder::write_frame(const CapturedFrame& frame) {
  if (frame.is_fresh) is_behind_ = is_lost_ = false;
  write_meshes(meshes_of_skipped_);
  write_meshes(frame.meshes);
  StepHead head;
  head.is_fresh = frame.is_fresh || is_behind_;
  head.dropped_before = frame.dropped_before + dropped_;
  const std::uint64_t dropped = head.dropped_before;
  std::swap(head.report, report_);  // for its memory
  summarize(*frame.report, head.report);
  write_keyframe(head.report.frame, head.is_fresh);
  output_.count_dropped(dropped);
  write_step(std::move(head), frame.records.bytes(), frame.record_count);
  is_behind_ = false;
  dropped_ = 0;
  meshes_of_skipped_.clear();
  return dropped;
}

/// The model may have a part of the frame already. To apply all records again makes no difference: each sets
/// something, and the last one that sets it counts.
void FrameEncoder::skip_frame(const CapturedFrame& frame) noexcept {
  dropped_ += frame.dropped_before + 1;
  if (frame.is_fresh) {
    model_.clear();
    is_lost_ = false;
  }
  if (is_lost_) return;
  is_behind_ = true;
  try {
    meshes_of_skipped_.insert(meshes_of_skipped_.end(), frame.meshes.begin(), frame.meshes.end());
    ByteSource source(frame.records.bytes());
    visit_records(source, frame.record_count, [&](const Record& record) { model_.apply(record); });
    model_.end_frame();
  } catch (...) {
    is_behind_ = false;
    is_lost_ = true;
    meshes_of_skipped_.clear();
  }
}

/// Writes those that the recording lacks.
void FrameEncoder::write_meshes(const NumberedMeshes& meshes) {
  for (const auto& [number, mesh] : meshes)
    if (!output_.has_mesh(number)) write_mesh(*mesh, number);
}

void FrameEncoder::write_mesh(const IndexedMesh& mesh, std::uint32_t number) {
  graze::write_mesh(chunk_, mesh, number);
  output_.put(ChunkKind::mesh, number, chunk_);
}

void FrameEncoder::write_keyframe(std::uint64_t frame, bool is_fresh) {
  if (is_fresh && !is_behind_) model_.clear();
  if (has_keyframe_ && !is_fresh && ++steps_since_keyframe_ < keyframe_interval_) return;
  has_keyframe_ = true;
  steps_since_keyframe_ = 0;
  has_last_rows_ = false;  // whoever begins here does not know them
  clear_kept();
  if (!is_fresh) model_.rebuild([&](const Record& record) { keep_record(record); });
  begin_chunk(chunk_);
  write_fields(chunk_, kept_count_);
  append_records(chunk_, kept_records_.bytes());
  put_chunk(ChunkKind::keyframe, frame);
  name_meshes();
}

void FrameEncoder::write_step(StepHead head, std::span<const std::byte> records, std::uint64_t record_count) {
  clear_kept();
  if (is_behind_) model_.rebuild([&](const Record& record) { keep_record(record); });
  ByteSource source(records);
  visit_records(source, record_count, [&](const Record& record) {
    const auto* const memory = std::get_if<MemoryRecord>(&record);
    if (memory != nullptr && model_.holds(*memory)) return;
    model_.apply(record);
    keep_record(record);
  });
  model_.end_frame();
  head.record_count = kept_count_;
  head.hash = hash_of(head.report);
  leave_out_rows_of_last(head);
  begin_chunk(chunk_);
  write_fields(chunk_, head);
  append_records(chunk_, kept_records_.bytes());
  name_meshes();  // before the step comes, which may drop what no segment uses
  put_chunk(ChunkKind::step, head.report.frame);
  std::swap(report_, head.report);
}

void FrameEncoder::leave_out_rows_of_last(StepHead& head) {
  head.has_rows_of_last = has_last_rows_ && head.report.rows == last_rows_;
  has_last_rows_ = true;
  std::swap(last_rows_, head.report.rows);
  if (head.has_rows_of_last)
    head.report.rows.clear();
  else
    head.report.rows = last_rows_;
}

void FrameEncoder::put_chunk(ChunkKind kind, std::uint64_t number) {
  seal_chunk(chunk_, kind, number);
  output_.put(kind, number, chunk_);
}

void FrameEncoder::clear_kept() {
  kept_records_.clear();
  kept_count_ = 0;
  kept_meshes_.clear();
}

void FrameEncoder::keep_record(const Record& record) {
  write_record(kept_records_, record);
  ++kept_count_;
  if (const auto* const added = std::get_if<AddRecord>(&record)) kept_meshes_.push_back(added->mesh);
  if (const auto* const replaced = std::get_if<ReplaceRecord>(&record))
    kept_meshes_.push_back(replaced->mesh);
}

/// Tells the output which meshes its last segment uses.
void FrameEncoder::name_meshes() {
  for (const std::uint32_t mesh : kept_meshes_) output_.use_mesh(mesh);
}

}  // namespace graze
