#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/mesh.hpp>
#include <graze/pair_filters.hpp>
#include <graze/scene.hpp>
#include <graze/settings.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace graze {

/// @cond internal
class RecordingReader;
/// @endcond

/// @addtogroup recording
/// @{

/// Describes one recorded frame, as far as that needs no replay.
struct RecordedFrame {
  /// FrameReport::frame() of the recorded scene.
  std::uint64_t frame = 0;
  /// FrameReport::tag().
  std::uint64_t tag = 0;
  /// The number of rows of the report.
  std::size_t pairs = 0;
  /// The number of rows whose pairs are in contact.
  std::size_t pairs_in_contact = 0;
  /// The number of contacts of all pairs.
  std::uint64_t contacts = 0;
  /// The number of diagnostics.
  std::uint64_t diagnostics = 0;
  /// How many frames were dropped between the recorded one before and this one, since the recorder could not
  /// follow or had no memory.
  std::uint64_t dropped_before = 0;
  /// Whether this frame, and those after it, can be reached without the frames before it.
  bool has_keyframe = false;
  /// FrameReport::complete().
  bool complete = true;
  /// The time of the recorded step, in milliseconds.
  double step_ms = 0;
};

/// A recording in a file, as Recorder wrote it. Chunks are read when they are asked for, and each is checked
/// before it is used. One thread at a time may use a recording.
class GRAZE_API Recording {
 public:
  /// Opens a file. One that was not finished, since its program died, is read up to its last whole frame.
  /// The head of every chunk is read and compared with the index.
  ///
  /// This and all members throw Error for a file that cannot be read, is no recording, is of another version,
  /// or is damaged. The message names the place.
  explicit Recording(const std::filesystem::path& file);
  /// Closes the file.
  ~Recording();
  /// Recordings are not copied.
  Recording(const Recording&) = delete;
  /// Recordings are not copied.
  Recording& operator=(const Recording&) = delete;

  /// Returns the settings of the recorded scene.
  [[nodiscard]] const SceneSettings& settings() const;
  /// Returns the version of graze that made the recording.
  [[nodiscard]] const std::string& made_by() const;
  /// Returns false if the program that recorded did not finish the file.
  [[nodiscard]] bool is_finished() const;
  /// Returns true if the recording was cut out of a longer one, or out of a run that went on for some time
  /// before it. Phases and ages depend on what was before, so a replay does not compare them.
  [[nodiscard]] bool is_cut() const;
  /// Returns the number of frames.
  [[nodiscard]] std::size_t frame_count() const;
  /// Returns what is known of a frame, by its index below frame_count().
  [[nodiscard]] RecordedFrame frame(std::size_t index) const;
  /// Returns how many frames were dropped after the last one. RecordedFrame::dropped_before counts the
  /// others. It is 0 for a file that was not finished.
  [[nodiscard]] std::uint64_t dropped_at_end() const;
  /// Returns the number of meshes.
  [[nodiscard]] std::size_t mesh_count() const;
  /// Returns the size of the file in bytes.
  [[nodiscard]] std::uint64_t byte_count() const;
  /// Reads every chunk, and checks every record against those before it.
  void check() const;

 private:
  friend class Replay;
  friend class RecordingCut;
  std::unique_ptr<RecordingReader> reader_;
};

/// Settings of a replay.
struct ReplaySettings {
  /// The number of threads, in place of the recorded one. Answers do not depend on it.
  std::optional<unsigned> threads = std::nullopt;
  /// The index of the first frame to answer. The replay begins at the keyframe before it and steps through
  /// the frames in between.
  std::size_t first_frame = 0;
};

/// How a replay's answer differs from the recorded one.
struct ReplayDifference {
  /// FrameReport::frame() of the recorded scene.
  std::uint64_t frame = 0;
  /// The pair, by the names of its objects, such as `"bowl" and "letter 3"`. Empty where no pair differs, but
  /// the diagnostics do.
  std::string pair;
  /// The recorded row, in a line.
  std::string recorded;
  /// The row of the replay, in a line.
  std::string replayed;
};

/// An object of a replay.
struct ReplayObject {
  /// The id in the replay's scene.
  ObjectId id;
  /// How many objects were added to the recorded scene before this one. It stays the same from frame to
  /// frame, and from one replay to the next.
  std::uint64_t serial = 0;
  /// The mesh of the object.
  std::shared_ptr<const Mesh> mesh;
  /// The settings that the object was added with. The groups of its faces are those of its mesh now.
  ObjectSettings settings;
};

/// Does again what a recording tells, and compares the answers. A time budget of the recorded scene is not
/// used, and what it cut short is not compared. Every chunk that the replay passes is checked, also those
/// that it does not need.
///
///     const Recording recording("bug.graze");
///     Replay replay(recording);
///     while (replay.step())
///       if (const auto difference = replay.difference()) ...;
///
/// One thread at a time may use a replay.
class GRAZE_API Replay {
 public:
  /// Makes the scene as it was before the first frame. The recording must outlive the replay. Throws Error as
  /// Recording does, if a first frame is beyond the last one, and if the recording asks for what no scene can
  /// do.
  explicit Replay(const Recording& recording, const ReplaySettings& settings = {});
  /// Frees the scene.
  ~Replay();
  /// Replays are not copied.
  Replay(const Replay&) = delete;
  /// Replays are not copied.
  Replay& operator=(const Replay&) = delete;

  /// Runs the next frame. Returns false if there is none. Throws Error if the recording is damaged there. The
  /// replay is of no use after that.
  bool step();
  /// Returns the index of the frame of the last step.
  [[nodiscard]] std::size_t frame_index() const;
  /// Returns the report of the last step. Its frames count from the frame at which the replay began.
  [[nodiscard]] const ReportHandle& report() const;
  /// Returns how the last step differs from the recording, or no value.
  [[nodiscard]] const std::optional<ReplayDifference>& difference() const;
  /// Returns how many rows of the last step were not compared, since they follow from what the replay does
  /// not know. See docs/recording.md, "What is not compared".
  [[nodiscard]] std::size_t rows_not_compared() const;
  /// Returns how many rows of the last step were compared only by what must hold whatever was before: bounds
  /// that overlap or are equal, whether the pair is in contact, and the number of contacts.
  [[nodiscard]] std::size_t rows_compared_in_part() const;

  /// Returns the objects of the scene in the order of addition, after the last step.
  [[nodiscard]] std::span<const ReplayObject> objects() const;
  /// Returns what had been said of pairs of objects until the last step. It is another pointer after a step
  /// that took up such a call, and none before the first step.
  [[nodiscard]] const std::shared_ptr<const PairFilters>& pair_filters() const;
  /// Gives the positions of the vertices of object `index` after the last step. `index` is one into
  /// objects(), and is not checked.
  void read_positions(std::size_t index, std::vector<Eigen::Vector3d>& positions) const;
  /// Returns the pose of a rigid or fixed object: the upper three rows of its 4 x 4 matrix. `index` is one
  /// into objects(), and is not checked.
  [[nodiscard]] std::array<double, 12> pose(std::size_t index) const;

 private:
  class State;
  std::unique_ptr<State> state_;
};

/// Says which part of a recording is wanted.
struct RecordingPart {
  /// The index of the first frame.
  std::size_t first_frame = 0;
  /// The index of the last frame. Frames beyond the end are left out.
  std::size_t last_frame = static_cast<std::size_t>(-1);
  /// The serials of the objects to keep, see ReplayObject::serial. Empty means all.
  std::vector<std::uint64_t> objects = {};
};

/// Writes a part of a recording into a file of its own. The part begins with where its objects are, and not
/// with how they came there. It tells only of pairs of the objects that are kept.
///
/// Throws Error as Recording does, if the part has no frame, and if the file cannot be written.
GRAZE_API void cut_recording(const Recording& recording, const RecordingPart& part,
                             const std::filesystem::path& file);

/// @}

}  // namespace graze
