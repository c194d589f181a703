#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <graze/io/error.hpp>
#include <graze/io/printable.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output/text.hpp"
#include "output_files.hpp"
#include "recording/commands.hpp"
#include "recording/frame_range.hpp"
#include "recording/named_object.hpp"
#include "recording/recording_notes.hpp"

namespace graze::tools {
namespace {

struct CutOptions {
  std::string file;
  std::string frames = "0..";
  std::vector<std::string> pair;
  std::string output;
};

/// The serial of the object that a word names: by its name, or by its serial.
std::uint64_t find_object(const std::string& word, std::span<const ReplayObject> objects) {
  std::optional<std::uint64_t> found;
  for (const ReplayObject& object : objects) {
    if (!is_named(object, word)) continue;
    if (found && *found != object.serial)
      throw io::InputError("--pair: several objects are called \"" + word +
                           "\"; name one by its number, which graze info lists");
    found = object.serial;
  }
  if (!found)
    throw io::InputError("--pair: no object of the first frame is called \"" + word +
                         "\"; graze info lists names and numbers");
  return *found;
}

RecordingPart part_of(const Recording& recording, const CutOptions& options) {
  const FrameRange frames = parse_frame_range("--frames", options.frames, recording.frame_count());
  RecordingPart part{.first_frame = frames.first, .last_frame = frames.last};
  if (options.pair.empty()) return part;
  Replay replay(recording, {.threads = 1, .first_frame = frames.first});
  (void)replay.step();
  for (const std::string& word : options.pair) part.objects.push_back(find_object(word, replay.objects()));
  return part;
}

/// Says whether a replay of the part answers as the whole recording does, and as this build does.
void print_answer(const std::string& file) {
  const Recording recording(file);
  Replay replay(recording);
  RowsLeftOut left_out;
  while (replay.step()) {
    left_out.add(replay);
    if (const auto& difference = replay.difference()) {
      say("a replay differs in frame %zu: %s\n  recorded  %s\n  replayed  %s\n", replay.frame_index(),
          io::printable(difference->pair).c_str(), io::printable(difference->recorded).c_str(),
          io::printable(difference->replayed).c_str());
      return;
    }
  }
  left_out.print();
  say("a replay answers as it was recorded%s\n", left_out.reservation().c_str());
}

void cut(const CutOptions& options) {
  OutputFiles outputs;
  outputs.add("-o", options.output);
  outputs.check_inputs(std::vector<std::filesystem::path>{options.file});
  const Recording recording(options.file);
  note_unfinished(recording, options.file);
  cut_recording(recording, part_of(recording, options), options.output);
  const Recording part(options.output);
  say("%s: %zu of %zu frames, %llu of %llu bytes\n", options.output.c_str(), part.frame_count(),
      recording.frame_count(), number(part.byte_count()), number(recording.byte_count()));
  print_answer(options.output);
}

}  // namespace

void add_cut_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand(
      "cut",
      "Writes a part of a recording: some frames, and two objects if asked. It begins where they are.");
  const auto options = std::make_shared<CutOptions>();
  command->add_option("file", options->file, "A recording, as graze run --record writes it")->required();
  command->add_option("--frames", options->frames, "Frames counted from 0, such as 10..20, 10.. or ..20");
  command->add_option("--pair", options->pair, "Two objects, by name or by number, such as bowl,letter")
      ->delimiter(',')
      ->expected(2);
  command->add_option("-o,--output", options->output, "The file to write")->required()->check(file_name());
  command->callback([options] { cut(*options); });
}

}  // namespace graze::tools
