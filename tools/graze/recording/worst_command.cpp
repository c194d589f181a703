#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <graze/io/printable.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <string>
#include <vector>

#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output/text.hpp"
#include "progress.hpp"
#include "recording/commands.hpp"
#include "recording/frame_range.hpp"
#include "recording/recording_notes.hpp"
#include "recording/snapshot_reader.hpp"
#include "recording/worst_of_pairs.hpp"

namespace graze::tools {
namespace {

struct WorstOptions {
  std::string file;
  std::string frames = "0..";
  std::size_t count = 5;
};

/// The first of a list, and how many more there are.
template <typename Value, typename Print>
void print_list(const std::string& title, const std::vector<Value>& values, std::size_t most,
                const Print& print) {
  say("%s%s\n", title.c_str(), values.empty() ? ": none" : "");
  for (std::size_t i = 0; i < std::min(most, values.size()); ++i) print(values[i]);
  if (values.size() > most) say("  and %zu more pairs\n", values.size() - most);
}

void print_deepest(const DeepestPlace& place) {
  say("  %-14.6g frame %llu, %s at (%.4g, %.4g, %.4g)\n", place.separation, number(place.frame),
      io::printable(place.names).c_str(), place.point.x(), place.point.y(), place.point.z());
}

void print_jump(const SeparationJump& jump) {
  say("  %-14.6g frame %llu, %s: from %.6g to %.6g\n", jump.after - jump.before, number(jump.frame),
      io::printable(jump.names).c_str(), jump.before, jump.after);
}

/// The steps that took longest when they were recorded.
void print_longest_steps(const Recording& recording, const FrameRange& frames, std::size_t most) {
  std::vector<std::size_t> longest;
  for (std::size_t index = frames.first; index <= frames.last; ++index) longest.push_back(index);
  const auto milliseconds = [&](std::size_t index) { return recording.frame(index).step_ms; };
  most = std::min(most, longest.size());
  std::ranges::partial_sort(longest, longest.begin() + static_cast<std::ptrdiff_t>(most),
                            std::ranges::greater(), milliseconds);
  say("longest steps, as they were recorded\n");
  for (std::size_t i = 0; i < most; ++i) {
    const RecordedFrame frame = recording.frame(longest[i]);
    say("  %-14s frame %zu, %s, %s\n", format("%.3f ms", frame.step_ms).c_str(), longest[i],
        counted(frame.pairs, "row").c_str(), counted(frame.contacts, "contact").c_str());
  }
}

void find_worst(const WorstOptions& options) {
  const Recording recording(options.file);
  const FrameRange frames = parse_frame_range("--frames", options.frames, recording.frame_count());
  SnapshotReader reader(recording, frames.first);
  WorstOfPairs worst;
  {
    Progress progress("frame", frames.last + 1);
    while (reader.step()) {
      const std::size_t frame = reader.snapshot().frame;
      progress.at(frame);
      if (recording.frame(frame).dropped_before > 0) worst.forget_last_frame();
      worst.add(reader.snapshot());
      if (frame == frames.last) break;
    }
  }
  say("%s: frames %zu to %zu%s\n", options.file.c_str(), frames.first, frames.last,
      unfinished_text(recording).c_str());
  print_list("deepest contact of a pair, by separation", worst.deepest(), options.count, print_deepest);
  print_list("largest jump of a pair's separation from one frame to the next", worst.jumps(), options.count,
             print_jump);
  print_longest_steps(recording, frames, options.count);
  note_unfinished(recording, options.file);
  note_divergence(reader, options.file);
}

}  // namespace

void add_worst_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand(
      "worst",
      "Finds what may be wrong in a recording: the deepest contacts, the largest jumps, the longest steps.");
  const auto options = std::make_shared<WorstOptions>();
  command->add_option("file", options->file, "A recording, as graze run --record writes it")->required();
  command->add_option("--frames", options->frames, "Frames counted from 0, such as 10..20, 10.. or ..20");
  command->add_option("--count", options->count, "How many of each to list; 5 by default")
      ->check(whole_number(1));
  command->callback([options] { find_worst(*options); });
}

}  // namespace graze::tools
