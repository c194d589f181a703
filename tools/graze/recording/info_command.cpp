#include <CLI/CLI.hpp>
#include <algorithm>
#include <graze/io/printable.hpp>
#include <graze/recording.hpp>
#include <graze/scene_enumerators.hpp>
#include <memory>
#include <string>
#include <vector>

#include "output/terminal.hpp"
#include "output/text.hpp"
#include "recording/commands.hpp"
#include "recording/recording_notes.hpp"

namespace graze::tools {
namespace {

/// Sums over all frames of a recording.
struct FrameSums {
  std::size_t keyframes = 0;
  std::uint64_t dropped = 0;
  std::size_t incomplete = 0;
  std::uint64_t diagnostics = 0;
  std::uint64_t most_contacts = 0;
  std::size_t frame_of_most_contacts = 0;
  std::vector<double> step_ms;
  std::vector<std::string> gaps;  ///< where frames were dropped

  void add(const RecordedFrame& frame, std::size_t index) {
    if (frame.has_keyframe) ++keyframes;
    add_gap(frame.dropped_before, "before frame " + std::to_string(index));
    if (!frame.complete) ++incomplete;
    diagnostics += frame.diagnostics;
    step_ms.push_back(frame.step_ms);
    if (frame.contacts <= most_contacts) return;
    most_contacts = frame.contacts;
    frame_of_most_contacts = index;
  }
  void add_gap(std::uint64_t frames, const std::string& place) {
    dropped += frames;
    if (frames > 0) gaps.push_back(std::to_string(frames) + " " + place);
  }
};

void print_gaps(const std::vector<std::string>& gaps) {
  constexpr std::size_t most_listed = 8;
  const std::size_t listed = std::min(most_listed, gaps.size());
  say("  dropped    %s", joined({gaps.begin(), gaps.begin() + static_cast<std::ptrdiff_t>(listed)}).c_str());
  if (listed < gaps.size()) say(", and at %zu more places", gaps.size() - listed);
  say("\n");
}

void print_settings(const SceneSettings& settings) {
  say("  settings   contact distance %.9g, range %.9g, detail %s, %u threads", settings.contact_distance,
      settings.range, std::string(to_string(settings.detail)).c_str(), settings.threads);
  if (settings.carrying > 0) say(", at most %zu contacts of a pair carry it", settings.carrying);
  say("%s\n", settings.ways_out ? ", ways out" : "");
}

void print_frames(const Recording& recording) {
  FrameSums sums;
  for (std::size_t index = 0; index < recording.frame_count(); ++index)
    sums.add(recording.frame(index), index);
  sums.add_gap(recording.dropped_at_end(), "after the last");
  if (sums.step_ms.empty()) return;
  std::sort(sums.step_ms.begin(), sums.step_ms.end());
  say("  frames     0 to %zu, steps %llu to %llu of the scene, %zu keyframes, %llu dropped\n",
      recording.frame_count() - 1, number(recording.frame(0).frame),
      number(recording.frame(recording.frame_count() - 1).frame), sums.keyframes, number(sums.dropped));
  if (!sums.gaps.empty()) print_gaps(sums.gaps);
  say("  contacts   at most %llu, in frame %zu\n", number(sums.most_contacts), sums.frame_of_most_contacts);
  say("  steps      median %.3f ms, worst %.3f ms, %zu incomplete\n", sums.step_ms[sums.step_ms.size() / 2],
      sums.step_ms.back(), sums.incomplete);
  say("  problems   %llu diagnostics\n", number(sums.diagnostics));
}

void print_objects(const Recording& recording) {
  if (recording.frame_count() == 0) return;
  Replay replay(recording, {.threads = 1, .first_frame = recording.frame_count() - 1});
  (void)replay.step();
  say("  objects    %zu in the last frame, of %zu meshes\n", replay.objects().size(), recording.mesh_count());
  constexpr std::size_t most_listed = 40;
  for (const ReplayObject& object : replay.objects().first(std::min(most_listed, replay.objects().size())))
    say("    %llu \"%s\", %u vertices%s\n", number(object.serial),
        io::printable(object.settings.name).c_str(), object.mesh->vertex_count(),
        object.settings.solid ? ", solid" : "");
  if (replay.objects().size() > most_listed) say("    and %zu more\n", replay.objects().size() - most_listed);
}

void inform(const std::string& file) {
  const Recording recording(file);
  recording.check();
  say("%s: %zu frames, %llu bytes, recorded by graze %s%s%s\n", file.c_str(), recording.frame_count(),
      number(recording.byte_count()), io::printable(recording.made_by()).c_str(),
      unfinished_text(recording).c_str(), recording.is_cut() ? ", begins amid a run" : "");
  print_settings(recording.settings());
  print_frames(recording);
  print_objects(recording);
}

}  // namespace

void add_info_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand(
      "info", "Checks a recording and says what it holds: frames, objects, contacts, times.");
  const auto file = std::make_shared<std::string>();
  command->add_option("file", *file, "A recording, as graze run --record writes it")->required();
  command->callback([file] { inform(*file); });
}

}  // namespace graze::tools
