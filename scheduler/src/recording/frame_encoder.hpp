#pragma once

#include <cstdint>
#include <graze/settings.hpp>

#include "recording/chunk_output.hpp"
#include "recording/frame_capture.hpp"
#include "recording/recorded_rows.hpp"
#include "recording/scene_model.hpp"

namespace graze {

/// Makes chunks of captured frames. It knows what the recording says so far, so that it can leave out memory
/// that has not changed and put a keyframe in. Writing thread only.
class FrameEncoder {
 public:
  /// A keyframe comes before the first frame and then every `keyframe_interval` frames.
  FrameEncoder(ChunkOutput& output, std::uint32_t keyframe_interval)
      : output_(output), keyframe_interval_(keyframe_interval) {}

  /// Writes the recording's first chunk. `is_cut` is SettingsChunk::is_cut.
  void write_settings(const SceneSettings& settings, bool is_cut);
  /// Writes what a frame has taken up and answered. Returns how many dropped frames it tells of. A frame for
  /// which this throws is to be skipped.
  std::uint64_t write_frame(const CapturedFrame& frame);
  /// Takes up what a frame did to the scene without writing it. The next frame that is written begins with
  /// the whole scene, and tells that this one is missing.
  void skip_frame(const CapturedFrame& frame) noexcept;
  /// Whether there was no memory to skip a frame either. Then all frames are to be skipped up to one that has
  /// the whole scene.
  [[nodiscard]] bool needs_whole_scene() const { return is_lost_; }

  /// Writes a mesh.
  void write_mesh(const IndexedMesh& mesh, std::uint32_t number);
  /// Writes a keyframe if one is due: the scene as it is before `frame`.
  void write_keyframe(std::uint64_t frame, bool is_fresh);
  /// Writes a step, of so many records. `head` has everything but what this leaves out or counts.
  void write_step(StepHead head, std::span<const std::byte> records, std::uint64_t record_count);

 private:
  void write_meshes(const NumberedMeshes& meshes);
  void leave_out_rows_of_last(StepHead& head);
  void put_chunk(ChunkKind kind, std::uint64_t number);
  void clear_kept();
  void keep_record(const Record& record);
  void name_meshes();

  ChunkOutput& output_;
  std::uint32_t keyframe_interval_;
  std::uint32_t steps_since_keyframe_ = 0;
  bool has_keyframe_ = false;
  SceneModel model_;
  bool is_behind_ = false;     ///< frames were skipped: the model has more than the recording
  bool is_lost_ = false;       ///< the model lacks a part of a skipped frame
  std::uint64_t dropped_ = 0;  ///< frames that the next step is to tell of, besides those it knows of
  NumberedMeshes meshes_of_skipped_;
  RecordedReport report_;
  std::vector<RecordedRow> last_rows_;
  bool has_last_rows_ = false;
  ByteBuffer chunk_;
  // The records of the keyframe or step that is being written, and the meshes that they name.
  ByteBuffer kept_records_;
  std::uint64_t kept_count_ = 0;
  std::vector<std::uint32_t> kept_meshes_;
};

}  // namespace graze
