#include <algorithm>
#include <graze/error.hpp>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <set>
#include <utility>

#include "recording/frame_encoder.hpp"
#include "recording/scene_model.hpp"
#include "replay/recording_reader.hpp"

namespace graze {

/// Copies a part of a recording. Frames before the part only move a model of the scene, from which the part's
/// first frame is made.
class RecordingCut {
 public:
  RecordingCut(const Recording& recording, const RecordingPart& part, const std::filesystem::path& file)
      : reader_(*recording.reader_),
        part_(part),
        serials_(part.objects.begin(), part.objects.end()),
        output_(file),
        encoder_(output_, RecorderSettings().keyframe_interval),
        check_(reader_.new_check()) {}

  void run() {
    const std::size_t count = reader_.steps().size();
    const std::size_t last = std::min(part_.last_frame, count - 1);
    std::size_t index = reader_.step_to_begin_at(part_.first_frame);
    reader_.visit_keyframe(index, payload_, check_, [&](const Record& record) { model_.apply(record); });
    const bool is_whole = part_.first_frame == 0 && serials_.empty();
    encoder_.write_settings(reader_.settings().settings, reader_.settings().is_cut || !is_whole);
    for (; index <= last; ++index) read_step(index);
    output_.finish(last + 1 == count ? reader_.dropped_at_end() : 0);
  }

 private:
  void read_step(std::size_t index) {
    const bool is_first = index == part_.first_frame;
    StepHead head = reader_.visit_step(
        index, payload_, check_, [&](StepHead& begun) { begin_step(begun, is_first); },
        [&](const Record& record) {
          model_.apply(record);
          keep(record);
        });
    model_.end_frame();
    reader_.check_passed(index, payload_);
    if (index < part_.first_frame) return;
    head.is_fresh = head.is_fresh || is_first;
    head.dropped_before = is_first ? 0 : head.dropped_before;
    write_step(std::move(head));
  }

  void begin_step(StepHead& head, bool is_first) {
    if (head.is_fresh) model_.clear();
    if (head.has_rows_of_last) head.report.rows = std::move(rows_);
    rows_ = head.report.rows;
    records_.clear();
    count_ = 0;
    if (is_first && !head.is_fresh) model_.rebuild([&](const Record& record) { keep(record); });
  }

  void write_step(StepHead head) {
    for (const std::uint32_t mesh : std::exchange(new_meshes_, {})) {
      reader_.load_mesh(mesh, chunk_);
      output_.put(ChunkKind::mesh, mesh, chunk_);
    }
    std::erase_if(head.report.rows,
                  [&](const RecordedRow& row) { return !is_kept(row.a) || !is_kept(row.b); });
    encoder_.write_keyframe(head.report.frame, head.is_fresh);
    encoder_.write_step(std::move(head), std::as_const(records_).bytes(), count_);
  }

  /// Keeps a record if what it tells of is kept.
  void keep(const Record& record) {
    if (const auto* const added = std::get_if<AddRecord>(&record)) {
      if (!serials_.empty() && !serials_.contains(added->serial)) return;
      kept_.insert(added->object);
      use_mesh(added->mesh);
    }
    if (!std::visit([&](const auto& one) { return tells_of_kept(one); }, record)) return;
    if (const auto* const replaced = std::get_if<ReplaceRecord>(&record)) use_mesh(replaced->mesh);
    write_record(records_, record);
    ++count_;
  }
  /// Copies a mesh with the next step, unless the part has it already.
  void use_mesh(std::uint32_t mesh) {
    if (written_meshes_.insert(mesh).second) new_meshes_.push_back(mesh);
  }
  [[nodiscard]] bool is_kept(ObjectId id) const { return kept_.contains(id); }
  template <typename OneRecord>
  [[nodiscard]] bool tells_of_kept(const OneRecord& record) const {
    return is_kept(record.object);
  }
  [[nodiscard]] bool tells_of_kept(const RefusePose& record) const { return is_kept(record.problem.object); }
  [[nodiscard]] bool tells_of_kept(const Diagnostic& record) const {
    return record.object == ObjectId() || is_kept(record.object);
  }
  [[nodiscard]] bool tells_of_kept(const IgnorePair& record) const {
    return is_kept(record.a) && is_kept(record.b);
  }
  [[nodiscard]] bool tells_of_kept(const IgnoreGroups& record) const {
    return is_kept(record.a) && is_kept(record.b);
  }
  [[nodiscard]] static bool tells_of_kept(const SetRule&) { return true; }
  [[nodiscard]] static bool tells_of_kept(const Reserve&) { return true; }

  const RecordingReader& reader_;
  const RecordingPart& part_;
  std::set<std::uint64_t> serials_;  ///< those to keep. An empty set means all
  FileOutput output_;
  FrameEncoder encoder_;
  RecordCheck check_;
  SceneModel model_;
  std::vector<RecordedRow> rows_;  ///< of the last step, all of them
  std::set<ObjectId> kept_;        ///< objects that the part has told of
  std::set<std::uint32_t> written_meshes_;
  std::vector<std::uint32_t> new_meshes_;
  ByteBuffer records_;
  std::uint64_t count_ = 0;
  ByteBuffer payload_;
  ByteBuffer chunk_;
};

void cut_recording(const Recording& recording, const RecordingPart& part, const std::filesystem::path& file) {
  if (part.first_frame >= recording.frame_count() || part.first_frame > part.last_frame)
    throw Error("the part has no frame: the recording has " + std::to_string(recording.frame_count()) +
                " frames, and the part would be from index " + std::to_string(part.first_frame) + " on");
  RecordingCut(recording, part, file).run();
}

}  // namespace graze
