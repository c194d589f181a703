#pragma once

#include <cstdint>
#include <graze/instruction_set.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench/contender.hpp"
#include "bench/peer_module.hpp"
#include "bench/scenes/scenes.hpp"

namespace graze::bench {

inline constexpr std::string_view graze_name = "graze";
inline constexpr std::string_view recorded_name = "graze, recorded";
inline constexpr std::string_view told_name = "graze, told of motion";
/// Graze's kernels on what clipping finds near, in task B with one thread, where clipping takes part.
inline constexpr std::string_view kernels_name = "graze's kernels, clipping's candidates";

struct RunOptions {
  Task task = Task::A;
  unsigned threads = 1;
  std::size_t frames = 0;               ///< that are timed, 0 for as many as the scene says
  bool evict = false;                   ///< 64 MB of other memory are touched before each contender's turn
  std::size_t slow = 1;                 ///< how many times slower than its own motion the scene is
  bool is_recorded = false;             ///< graze takes part once more, with a recorder
  std::vector<std::string_view> peers;  ///< those that cannot do the task are left out
  /// Graze takes part with each. The name alone stands for the first, which is what the aims are about.
  std::vector<InstructionSet> instruction_sets;  ///< at least one
};

/// The times that one contender needed for the frames of a run, in ms.
struct Timing {
  std::string name;
  double first = 0;  ///< it is made and answers for the first time
  double median = 0, p99 = 0, worst = 0;
  std::string complaint;  ///< why its times mean nothing, empty where all its answers were right
  std::size_t found = 0;  ///< in the last frame that was verified
};

/// Results of graze's steps other than their times.
struct GrazeFigures {
  std::uint64_t hash = 0;         ///< of all reports
  double contacts_per_frame = 0;  ///< mean of the timed frames
  double object_bytes = 0;
};

/// A scene with one task, frame by frame, all contenders in turn.
struct Run {
  std::string scene, what;
  Task task = Task::A;
  unsigned threads = 1;
  bool evict = false;
  std::size_t slow = 1;
  std::size_t frames = 0, objects = 0, vertices = 0, frames_verified = 0;
  double distance = 0;
  std::size_t near_pairs = 0;  ///< of task B with one thread: count_near_pairs in the last frame
  std::vector<Timing> timings;
  GrazeFigures graze;

  /// The timing of a name, null where it took no part.
  [[nodiscard]] const Timing* timing(std::string_view name) const;
  /// Its median, NaN where it took no part or was wrong.
  [[nodiscard]] double median(std::string_view name) const;
};

Run run_scene(const BenchScene& scene, const RunOptions& options, const PeerModule& module);

}  // namespace graze::bench
