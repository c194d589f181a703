#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <optional>

namespace graze {

/// @addtogroup recording
/// @{

/// Settings that every recorder has.
struct RecorderSettings {
  /// A whole copy of the scene's input is recorded before the first frame, and then every so many frames.
  /// Reading can begin at such a frame. At least 1.
  std::uint32_t keyframe_interval = 64;
  /// How many frames may wait to be written, at least 1. A frame for which there is no room is dropped.
  std::uint32_t waiting_frames = 32;
};

/// Settings of a recorder that keeps the last frames in memory.
struct RingSettings {
  /// About how many bytes the frames that are kept may take. The last keyframe and what follows are kept in
  /// any case.
  std::size_t byte_budget = std::size_t{256} << 20;
  /// How many frames are wanted at least, such as 600 for the last ten seconds at 60 Hz. What is older is
  /// dropped from keyframe to keyframe. 0 means as many as fit the budget.
  std::uint64_t frames = 0;
  /// A file that the frames are written to when the first report with a Diagnostic comes. Empty means none.
  std::filesystem::path on_diagnostic = {};
};

/// Counts what a recorder has done so far.
struct RecorderStatistics {
  /// Frames that were written, or put into the ring.
  std::uint64_t frames = 0;
  /// Frames that were dropped, since the writer could not follow. The next frame is marked.
  std::uint64_t dropped = 0;
  /// Bytes of the file so far, or of the ring now.
  std::uint64_t bytes = 0;
};

/// Records what a scene is given and what it answers. A Replay of the recording does it again, on another
/// machine and with another number of threads.
///
///     Recorder recorder(scene, "bug.graze");
///     for (...) { ...; scene.step(); }
///     recorder.close();
///
/// The step only copies what it is given. A thread of the recorder hashes reports and writes. Where it cannot
/// follow, frames are dropped and counted, and the step is not delayed. A recorder may be attached at any
/// time between two steps: it begins with the whole scene.
///
/// @par Threads
/// Constructor, close() and destructor must not run at the same time as a step of the scene. All else may
/// come from any thread. The scene may go before the recorder.
class GRAZE_API Recorder {
 public:
  /// Records into a file, which is opened and overwritten at once. Only one recorder may be attached to a
  /// scene. Throws Error if another one is, if the file cannot be opened, or if a number is 0.
  Recorder(Scene& scene, const std::filesystem::path& file, const RecorderSettings& settings = {});
  /// Keeps the last frames in memory. Throws Error if another recorder is attached, or if a number is 0.
  Recorder(Scene& scene, const RingSettings& ring, const RecorderSettings& settings = {});
  /// Detaches and finishes what is left to write. What goes wrong is not told; close() tells it.
  ~Recorder();
  /// Recorders are not copied.
  Recorder(const Recorder&) = delete;
  /// Recorders are not copied.
  Recorder& operator=(const Recorder&) = delete;

  /// Detaches from the scene, waits until all frames are written, and finishes the file. Throws Error if the
  /// file, or the one of RingSettings::on_diagnostic, could not be written. Later calls do nothing.
  void close();
  /// Waits for the frames of all steps that have returned, and writes the frames of the ring into a file.
  /// Throws Error if the file cannot be written, or if this recorder has no ring.
  void write(const std::filesystem::path& file);
  /// Returns what was recorded so far.
  [[nodiscard]] RecorderStatistics statistics() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze
