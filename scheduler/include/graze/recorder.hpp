#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/enumerators.hpp>
#include <graze/export.hpp>
#include <graze/scene.hpp>
#include <memory>
#include <optional>
#include <string_view>

namespace graze {

/// @addtogroup recording
/// @{

/// Says what a step does while all frames of its recorder wait to be written.
enum class WhenBehind : std::uint8_t {
  /// The step is not delayed. Its frame is dropped and counted, and the next frame that is recorded begins
  /// with the whole scene. For a program that keeps a frame rate.
  drop,
  /// The step waits until a frame is written, so no frame is lost. For a run without a frame rate to keep.
  wait
};

/// Returns the enumerator's own name, such as "drop". It is empty for any other value.
[[nodiscard]] constexpr std::string_view name_of(WhenBehind when) {
  switch (when) {
    case WhenBehind::drop:
      return "drop";
    case WhenBehind::wait:
      return "wait";
  }
  return {};
}

/// Settings that every recorder has.
struct RecorderSettings {
  /// A whole copy of the scene's input is recorded before the first frame, and then every so many frames.
  /// Reading can begin at such a frame. At least 1.
  std::uint32_t keyframe_interval = 64;
  /// How many frames may wait to be written, at least 1. #when_behind says what happens to one more.
  std::uint32_t waiting_frames = 32;
  /// Whether a step drops its frame, or waits, while that many frames wait to be written.
  WhenBehind when_behind = WhenBehind::drop;
};

/// Settings of a recorder that keeps the last frames in memory.
struct RingSettings {
  /// About how many bytes the frames that are kept may take. The last keyframe and what follows are kept in
  /// any case.
  std::size_t byte_budget = std::size_t{256} << 20;
  /// How many frames are wanted at least, such as 600 for the last ten seconds at 60 Hz. What is older is
  /// dropped from keyframe to keyframe. It is at least 1. No value means as many as fit the budget.
  std::optional<std::uint64_t> frames = std::nullopt;
  /// A file that the frames are written to when the first report with a Diagnostic comes. Empty means none.
  std::filesystem::path on_diagnostic = {};
};

/// Counts what a recorder has done so far, or what a file has that Recorder::write() wrote.
struct RecorderStatistics {
  /// Frames that were written, or put into the ring.
  std::uint64_t frames = 0;
  /// Frames that are missing. They were dropped since the recorder could not follow, since there was no
  /// memory for them, or since its file could not be written. A replay knows where they are missing: the
  /// frame after them is marked, and so is the end of the file.
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
/// follow, frames are dropped and counted, or the step waits: see RecorderSettings::when_behind. A recorder
/// may be attached at any time between two steps: it begins with the whole scene.
///
/// A frame for which the step or the recorder's thread gets no memory is dropped and counted. The next one
/// begins with the whole scene. Where a file cannot be written any more, all later frames are dropped and
/// counted, and close() tells why.
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
  /// file, or the one of RingSettings::on_diagnostic, could not be written. Throws std::bad_alloc if there is
  /// no memory for the end of a file. Then it may be called again. Other later calls do nothing.
  void close();
  /// Waits for the frames of all steps that have returned, and writes the frames of the ring into a file.
  /// Returns what the file has. RecorderStatistics::dropped counts the frames that are missing in it, from
  /// its first frame to the last step. Throws Error if the file cannot be written, or if this recorder has no
  /// ring.
  RecorderStatistics write(const std::filesystem::path& file);
  /// Returns what was recorded so far.
  [[nodiscard]] RecorderStatistics statistics() const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// @}

}  // namespace graze
