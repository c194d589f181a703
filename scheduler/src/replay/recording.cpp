#include <graze/recording.hpp>

#include "replay/recording_reader.hpp"

namespace graze {

Recording::Recording(const std::filesystem::path& file) : reader_(std::make_unique<RecordingReader>(file)) {}
Recording::~Recording() = default;

const SceneSettings& Recording::settings() const {
  return reader_->settings().settings;
}
const std::string& Recording::made_by() const {
  return reader_->settings().made_by;
}
bool Recording::is_finished() const {
  return reader_->is_finished();
}
bool Recording::is_cut() const {
  return reader_->settings().is_cut || (frame_count() > 0 && frame(0).frame != 1);
}
std::size_t Recording::frame_count() const {
  return reader_->steps().size();
}
std::uint64_t Recording::dropped_at_end() const {
  return reader_->dropped_at_end();
}
std::size_t Recording::mesh_count() const {
  return reader_->mesh_count();
}
std::uint64_t Recording::byte_count() const {
  return reader_->byte_count();
}
void Recording::check() const {
  reader_->check_all();
}

RecordedFrame Recording::frame(std::size_t index) const {
  ByteBuffer payload;
  const StepHead head = reader_->step_head(index, payload);
  const RecordedReport& report = head.report;
  return {.frame = report.frame,
          .tag = report.tag,
          .pairs = static_cast<std::size_t>(report.pairs),
          .pairs_in_contact = static_cast<std::size_t>(report.pairs_in_contact),
          .contacts = report.contacts,
          .diagnostics = report.diagnostics,
          .dropped_before = head.dropped_before,
          .has_keyframe = reader_->steps()[index].keyframe_offset != 0,
          .complete = report.complete,
          .step_ms = report.step_ms};
}

}  // namespace graze
