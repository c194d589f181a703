#pragma once

#include <filesystem>
#include <graze/io/scene_snapshot.hpp>
#include <vector>

#include "tools/temporary_folder.hpp"

namespace graze::tests {

/// A recording of a sheet of quads and triangles, a spike that comes down on it, and a block that is removed
/// while it touches. The names have commas, quotes and a line end. mark_report() has marked all reports.
class ExportScene {
 public:
  static constexpr std::size_t frame_count = 12;

  ExportScene();

  /// The frames as a replay of the recording tells them.
  [[nodiscard]] const std::vector<io::SceneSnapshot>& frames() const { return frames_; }
  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_ / name; }

 private:
  void record();
  void replay();

  TemporaryFolder folder_;
  std::vector<io::SceneSnapshot> frames_;
};

}  // namespace graze::tests
