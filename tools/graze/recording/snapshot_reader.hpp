#pragma once

#include <graze/io/scene_snapshot.hpp>
#include <graze/recording.hpp>
#include <vector>

namespace graze::tools {

/// Replays a recording from frame to frame, and gives each frame as the exports take it. Frames are counted
/// from 0, as the options of all commands count them.
class SnapshotReader {
 public:
  /// Begins at a frame. Phases, and when contacts began, are those of the recorded scene only if that is
  /// frame 0. The recording must outlive the reader.
  SnapshotReader(const Recording& recording, std::size_t first_frame);

  /// Runs the next frame. Returns false if there is none.
  bool step();
  /// Everything but positions.
  [[nodiscard]] const io::SceneSnapshot& snapshot() const { return snapshot_; }
  /// Reads the positions of all objects into the snapshot.
  void read_positions();
  /// Returns whether every frame so far answered as it was recorded.
  [[nodiscard]] bool is_as_recorded() const { return is_as_recorded_; }

 private:
  void list_objects();

  const Recording& recording_;
  Replay replay_;
  io::SceneSnapshot snapshot_;
  bool is_as_recorded_ = true;
};

}  // namespace graze::tools
