#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <graze/recording.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output_files.hpp"
#include "page_output.hpp"
#include "progress.hpp"
#include "recording/commands.hpp"
#include "recording/recording_notes.hpp"

namespace graze::tools {
namespace {

struct ViewOptions {
  std::string file;
  std::string output;
  std::optional<std::uint32_t> every;
};

/// Tells a page which objects a replay has, and where they are.
class ReplayedPage {
 public:
  ReplayedPage(const Recording& recording, const ViewOptions& options)
      : page_(
            options.output, recording.settings(), recording.frame_count(),
            {"-o", std::filesystem::path(options.file).stem().string(), options.file, options.every, true}) {}

  void add(const Recording& recording, const Replay& replay) {
    change_objects(replay);
    change_filters(replay);
    if (page_.writer().takes_next_frame()) place_objects(replay);
    if (replay.difference()) page_.writer().mark_diverged();
    const RecordedFrame frame = recording.frame(replay.frame_index());
    page_.writer().mark_dropped(frame.dropped_before);
    page_.frame(frame.frame, *replay.report());
  }
  /// Marks frames that are missing after the last one.
  void mark_dropped(std::uint64_t frames) { page_.writer().mark_dropped(frames); }
  std::string close() { return page_.close(); }

 private:
  void change_objects(const Replay& replay) {
    std::map<ObjectId, std::shared_ptr<const Mesh>> now;
    for (const ReplayObject& object : replay.objects()) now[object.id] = object.mesh;
    // An object with another mesh is another one for the page.
    bool has_changed = now.size() != known_.size();
    std::erase_if(known_, [&](const auto& known) {
      const auto found = now.find(known.first);
      const bool is_same = found != now.end() && found->second == known.second;
      if (!is_same) page_.writer().remove_object(known.first);
      has_changed = has_changed || !is_same;
      return !is_same;
    });
    for (const ReplayObject& object : replay.objects()) {
      if (known_.contains(object.id)) continue;
      const ObjectSettings& settings = object.settings;
      const std::string name =
          settings.name.empty() ? "object " + std::to_string(object.serial) : settings.name;
      page_.writer().add_object(object.id, page_object(name, object.mesh, settings));
    }
    known_ = std::move(now);
    if (has_changed) known_filters_.reset();
  }
  /// The page has other numbers of the objects after each change of them.
  void change_filters(const Replay& replay) {
    if (known_filters_ == replay.pair_filters()) return;
    known_filters_ = replay.pair_filters();
    page_.writer().set_pair_filters(*known_filters_);
  }
  void place_objects(const Replay& replay) {
    for (std::size_t i = 0; i < replay.objects().size(); ++i) {
      const ReplayObject& object = replay.objects()[i];
      if (object.settings.motion == Motion::deformable) {
        replay.read_positions(i, positions_);
        page_.writer().set_positions(object.id, positions_);
      } else {
        page_.writer().set_pose(object.id, replay.pose(i));
      }
    }
  }

  PageOutput page_;
  std::map<ObjectId, std::shared_ptr<const Mesh>> known_;  ///< the objects of the page
  std::shared_ptr<const PairFilters> known_filters_;       ///< what the page knows of pairs
  std::vector<Eigen::Vector3d> positions_;
};

void view(const ViewOptions& options) {
  OutputFiles outputs;
  add_page(outputs, "-o", options.output);
  outputs.check_inputs(std::vector<std::filesystem::path>{options.file});
  const Recording recording(options.file);
  Replay replay(recording);
  ReplayedPage page(recording, options);
  Progress progress("frame", recording.frame_count());
  std::size_t differing = 0;
  while (replay.step()) {
    progress.at(replay.frame_index());
    page.add(recording, replay);
    if (replay.difference()) ++differing;
  }
  page.mark_dropped(recording.dropped_at_end());
  say("page      %s\n", page.close().c_str());
  note_unfinished(recording, options.file);
  if (differing > 0)
    say("DIVERGED in %zu of %zu frames; the page marks them, and graze replay names the first\n", differing,
        recording.frame_count());
}

}  // namespace

void add_view_command(CLI::App& app) {
  CLI::App* const command =
      app.add_subcommand("view", "Writes a page that shows a recording in a browser, frame by frame.");
  const auto options = std::make_shared<ViewOptions>();
  command->add_option("file", options->file, "A recording, as graze run --record writes it")->required();
  command
      ->add_option("-o,--output", options->output,
                   "The page to write (.html), or its data (.grazeview), which a page opens")
      ->required()
      ->check(file_name());
  command->add_option("--every", options->every, "Write each K-th frame")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()));
  command->callback([options] { view(*options); });
}

}  // namespace graze::tools
