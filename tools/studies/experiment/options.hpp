#pragma once

#include <cstdint>
#include <filesystem>

namespace graze::tools {

/// The options of every study of `graze_studies experiment`. Steps run on one thread.
struct ExperimentOptions {
  std::uint64_t seed = 1;
  std::uint32_t frames = 0;  ///< 0: as many as the paper, or as the study says
  std::uint32_t runs = 3;    ///< each time is the fastest of so many
  bool times = true;  ///< false: nothing that hangs on times may be in texts, claims or tables not `timed`
  std::filesystem::path out;   ///< an existing folder. Studies may write files of their own into it
  std::filesystem::path data;  ///< real meshes. What needs them is skipped with one line where it is missing

  /// How many frames a study plays that has `usual` of them.
  [[nodiscard]] std::uint32_t frames_of(std::uint32_t usual) const { return frames == 0 ? usual : frames; }
};

}  // namespace graze::tools
