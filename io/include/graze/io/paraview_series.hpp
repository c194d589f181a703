#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <graze/export.hpp>
#include <graze/io/scene_snapshot.hpp>
#include <vector>

namespace graze::io {

/// @addtogroup io_exports
/// @{

/// Writes frames as a time series for ParaView: a `.pvd` file, and three `.vtp` files for each frame in a
/// folder beside it. They hold the surfaces, the contacts, and lines for distances. docs/formats.md lists
/// their data. Positions are doubles. One thread at a time may use a series.
class GRAZE_API ParaviewSeries {
 public:
  /// Makes the folder, which has the name of the `.pvd` file without its ending. Throws InputError if the
  /// folder cannot be made.
  explicit ParaviewSeries(const std::filesystem::path& pvd);

  /// Writes the files of a frame, over those that are there. Throws InputError if a file cannot be written,
  /// or if the frame has 2^31 vertices or corners, or more.
  void write(const SceneSnapshot& snapshot);
  /// Writes the `.pvd` file, which names the files of all frames so far. Throws InputError if it cannot be
  /// written.
  void close() const;
  /// Returns the number of frames so far.
  [[nodiscard]] std::size_t frame_count() const;

 private:
  std::filesystem::path pvd_;
  std::filesystem::path folder_;
  std::vector<std::uint64_t> frames_;
};

/// @}

}  // namespace graze::io
