#include <CLI/CLI.hpp>
#include <cstdio>
#include <graze/io/error.hpp>
#include <graze/io/picture.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <optional>
#include <string>

#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output_files.hpp"
#include "recording/best_frame.hpp"
#include "recording/commands.hpp"
#include "recording/named_object.hpp"
#include "recording/recording_notes.hpp"

namespace graze::tools {
namespace {

struct PictureOptions {
  std::string file;
  std::optional<std::size_t> frame;
  std::string output;
  bool lines = false;
  std::vector<std::string> select;
};

bool is_selected(const ReplayObject& object, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (is_named(object, word)) return true;
  return false;
}

/// Draws the frame's report and the objects. With a selection only these objects and what is
/// between them are drawn.
io::PictureScene scene_of(const Replay& replay, const PictureOptions& options) {
  io::PictureScene scene;
  std::vector<ObjectId> shown;
  for (std::size_t i = 0; i < replay.objects().size(); ++i) {
    const ReplayObject& object = replay.objects()[i];
    if (!options.select.empty() && !is_selected(object, options.select)) continue;
    shown.push_back(object.id);
    scene.objects.push_back({object.mesh, {}});
    replay.read_positions(i, scene.objects.back().positions);
  }
  if (shown.empty()) throw io::InputError("--select: no object of the frame is called so");
  const auto is_shown = [&](ObjectId id) { return std::find(shown.begin(), shown.end(), id) != shown.end(); };
  const FrameReport& report = *replay.report();
  for (const PairReport& pair : report.pairs()) {
    if (!is_shown(pair.a) || !is_shown(pair.b)) continue;
    const auto contacts = report.contacts(pair);
    scene.contacts.insert(scene.contacts.end(), contacts.begin(), contacts.end());
    if (contacts.empty()) scene.distances.push_back({pair.witness.point_a, pair.witness.point_b});
    scene.ways_out.push_back(pair.way_out);
    if (!options.lines) continue;
    for (const RegionDistance& region : report.region_distances(pair))
      scene.region_distances.push_back(region);
  }
  return scene;
}

void draw(const PictureOptions& options) {
  OutputFiles outputs;
  outputs.add_picture("-o", options.output);
  outputs.check_inputs(std::vector<std::filesystem::path>{options.file});
  const Recording recording(options.file);
  note_unfinished(recording, options.file);
  const std::size_t frame = options.frame ? *options.frame : best_frame(recording);
  if (options.lines && recording.settings().region_distances == 0)
    throw io::InputError("--lines: the recorded scene has no region_distances, so it has no lines to draw");
  Replay replay(recording, {.first_frame = frame});
  (void)replay.step();
  io::write_picture(options.output, scene_of(replay, options));
  say("%s: frame %zu, %zu contacts\n", options.output.c_str(), frame, replay.report()->contacts().size());
}

}  // namespace

void add_picture_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand("picture", "Draws a frame of a recording into a PNG.");
  const auto options = std::make_shared<PictureOptions>();
  command->add_option("file", options->file, "A recording, as graze run --record writes it")->required();
  command->add_option("--frame", options->frame, "Counted from 0; else the first with most contacts")
      ->check(whole_number(0));
  command->add_flag(
      "--lines", options->lines,
      "Draw the lines between middle vertices of regions that are near, in a colour for each level");
  command->add_option("--select", options->select, "Draw only these objects, by name or by number")
      ->delimiter(',');
  command->add_option("-o,--output", options->output, "The PNG to write")->required()->check(file_name());
  command->callback([options] { draw(*options); });
}

}  // namespace graze::tools
