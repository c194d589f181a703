#include <CLI/CLI.hpp>
#include <algorithm>
#include <graze/instruction_set.hpp>
#include <graze/io/error.hpp>
#include <graze/io/printable.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <optional>
#include <string>

#include "check_failed.hpp"
#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output/text.hpp"
#include "progress.hpp"
#include "recording/commands.hpp"
#include "recording/recording_notes.hpp"

namespace graze::tools {
namespace {

struct ReplayOptions {
  std::string file;
  std::optional<unsigned> threads;
  std::optional<std::string> instruction_set;
  std::size_t first_frame = 0;
  bool validate = false;
};

InstructionSet parse_instruction_set(const std::string& word) {
  std::string known;
  for (const InstructionSet set : available_instruction_sets()) {
    if (word == to_string(set)) return set;
    known += (known.empty() ? "" : ", ") + std::string(to_string(set));
  }
  throw io::InputError("--instruction-set: this processor has " + known + ", got \"" + word + "\"");
}

/// The structure validators are built in or not.
void check_validators() {
#ifndef GRAZE_VALIDATE
  throw io::InputError(
      "--validate: this graze is built without structure validators; build one with -DGRAZE_VALIDATE=ON, as "
      "the preset debug does");
#endif
}

void replay(const ReplayOptions& options) {
  if (options.validate) check_validators();
  if (options.instruction_set) use_instruction_set(parse_instruction_set(*options.instruction_set));
  const Recording recording(options.file);
  Replay replayed(recording, {.threads = options.threads, .first_frame = options.first_frame});
  std::size_t compared = 0;
  std::size_t differing = 0;
  RowsLeftOut left_out;
  std::optional<ReplayDifference> first;
  std::size_t first_index = 0;
  Progress progress("frame", recording.frame_count());
  while (replayed.step()) {
    progress.at(replayed.frame_index());
    ++compared;
    left_out.add(replayed);
    if (!replayed.difference()) continue;
    ++differing;
    if (first) continue;
    first = replayed.difference();
    first_index = replayed.frame_index();
  }
  say("%s: %zu frames, recorded by graze %s%s\n", options.file.c_str(), recording.frame_count(),
      io::printable(recording.made_by()).c_str(), unfinished_text(recording).c_str());
  left_out.print();
  if (!first) {
    say("%zu frames answered again, all the same%s\n", compared, left_out.reservation().c_str());
    return;
  }
  say("DIVERGED in %zu of %zu frames, first in frame %zu: %s\n  recorded  %s\n  replayed  %s\n", differing,
      compared, first_index, first->pair.empty() ? "diagnostics" : io::printable(first->pair).c_str(),
      io::printable(first->recorded).c_str(), io::printable(first->replayed).c_str());
  throw CheckFailed(format("%s: the replay differs from frame %zu on", options.file.c_str(), first_index));
}

}  // namespace

void add_replay_command(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("replay", "Does a recording again and compares every frame with what was recorded.");
  const auto options = std::make_shared<ReplayOptions>();
  command->add_option("file", options->file, "A recording, as graze run --record writes it")->required();
  command->add_option("--threads", options->threads, "How many threads, in place of the recorded number")
      ->check(whole_number(0, std::numeric_limits<unsigned>::max()));
  command->add_option("--instruction-set", options->instruction_set,
                      "scalar, baseline, avx2 or avx512, in place of the best one");
  command->add_option("--from", options->first_frame, "Compare from this frame on, counted from 0")
      ->check(whole_number(0));
  command->add_flag("--validate", options->validate, "Check all structures too, if graze is built for it");
  command->callback([options] { replay(*options); });
}

}  // namespace graze::tools
