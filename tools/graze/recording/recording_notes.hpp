#pragma once

#include <cstddef>
#include <graze/recording.hpp>
#include <string>

#include "recording/snapshot_reader.hpp"

namespace graze::tools {

/// Stands behind what is said of a recording whose program did not finish it. Empty for others.
[[nodiscard]] std::string unfinished_text(const Recording& recording);
/// Says on standard error, in a line, that a recording was not finished, where that is so.
void note_unfinished(const Recording& recording, const std::string& file);

/// Says on standard error, in a line, that a replay differs from its recording, where that is so.
void note_divergence(const SnapshotReader& reader, const std::string& file);

/// Counts the rows that a replay could not compare with the recording as a whole.
class RowsLeftOut {
 public:
  /// Adds those of the last step.
  void add(const Replay& replay);
  /// Prints what was not compared, if anything.
  void print() const;
  /// Stands behind "all the same".
  [[nodiscard]] std::string reservation() const;

 private:
  std::size_t not_compared_ = 0;
  std::size_t in_part_ = 0;
};

}  // namespace graze::tools
