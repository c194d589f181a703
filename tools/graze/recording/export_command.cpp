#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <graze/io/error.hpp>
#include <graze/io/gltf_writer.hpp>
#include <graze/io/paraview_series.hpp>
#include <graze/io/table_writers.hpp>
#include <graze/recording.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output/text.hpp"
#include "output_files.hpp"
#include "output_path.hpp"
#include "progress.hpp"
#include "recording/best_frame.hpp"
#include "recording/commands.hpp"
#include "recording/frame_range.hpp"
#include "recording/recording_notes.hpp"
#include "recording/snapshot_reader.hpp"

namespace graze::tools {
namespace {

struct ExportOptions {
  std::string file;
  std::string frames = "0..";
  std::optional<std::string> contacts;
  std::optional<std::string> distances;
  std::optional<std::string> paraview;
  std::optional<std::string> gltf;
  std::optional<std::size_t> frame;
};

std::filesystem::path paraview_folder(const std::filesystem::path& pvd) {
  return pvd.parent_path() / pvd.stem();
}

void check_ending(const std::string& option, const std::string& file,
                  const std::vector<std::string>& endings) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (std::find(endings.begin(), endings.end(), ending) != endings.end()) return;
  throw io::InputError(option + ": " + file + " cannot be written: end it in " + joined(endings, " or "));
}

/// Refuses what cannot be written before anything is read.
void check_export_outputs(const ExportOptions& options) {
  OutputFiles outputs;
  if (options.contacts) outputs.add("--csv", *options.contacts);
  if (options.distances) outputs.add("--distances", *options.distances);
  if (options.paraview) outputs.add("--paraview", *options.paraview);
  if (options.gltf) outputs.add("--gltf", *options.gltf);
  if (options.paraview) outputs.add_series("--paraview", paraview_folder(*options.paraview));
  outputs.check_inputs(std::vector<std::filesystem::path>{options.file});
  if (!options.contacts && !options.distances && !options.paraview && !options.gltf)
    throw io::InputError("graze export: name a file to write: --csv, --distances, --paraview or --gltf");
  if (options.frame && !options.gltf) throw io::InputError("--frame: goes with --gltf only");
  if (options.gltf) check_ending("--gltf", *options.gltf, {".gltf", ".glb"});
  if (!options.paraview) return;
  check_ending("--paraview", *options.paraview, {".pvd"});
  const std::filesystem::path folder = paraview_folder(*options.paraview);
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored)) return;
  if (!std::filesystem::is_directory(folder, ignored))
    throw io::InputError("--paraview: " + folder.string() +
                         " cannot be written: it is a file, and the frames need a folder of that name");
  check_output_file("--paraview", folder / "surfaces_000000.vtp");
}

/// The frame that becomes glTF.
std::size_t gltf_frame(const Recording& recording, const ExportOptions& options, const FrameRange& frames) {
  if (!options.frame) return best_frame(recording, frames);
  if (*options.frame < frames.first || *options.frame > frames.last)
    throw io::InputError("--frame: expected a frame from " + std::to_string(frames.first) + " to " +
                         std::to_string(frames.last) + ", got " + std::to_string(*options.frame));
  return *options.frame;
}

/// The files of an export, all open.
class Exports {
 public:
  Exports(const ExportOptions& options, const Recording& recording)
      : options_(options), frames_(parse_frame_range("--frames", options.frames, recording.frame_count())) {
    if (options.gltf) gltf_frame_ = gltf_frame(recording, options, frames_);
    if (options.contacts) contacts_.emplace(*options.contacts);
    if (options.distances) distances_.emplace(*options.distances);
    if (options.paraview) series_.emplace(*options.paraview);
  }

  /// The frame at which a replay begins. Phases, and when contacts began, need all frames before.
  [[nodiscard]] std::size_t first_frame() const {
    return contacts_ || distances_ || series_ ? 0 : *gltf_frame_;
  }
  [[nodiscard]] std::size_t last_frame() const {
    return contacts_ || distances_ || series_ ? frames_.last : *gltf_frame_;
  }

  void write(SnapshotReader& reader) {
    const std::size_t frame = reader.snapshot().frame;
    if (frame < frames_.first) return;
    if (series_ || gltf_frame_ == frame) reader.read_positions();
    if (contacts_) contacts_->write(reader.snapshot());
    if (distances_) distances_->write(reader.snapshot());
    if (series_) series_->write(reader.snapshot());
    if (gltf_frame_ == frame) io::write_gltf(*options_.gltf, reader.snapshot());
  }

  /// Ends the files and says what they hold.
  void close() {
    const std::size_t count = frames_.last - frames_.first + 1;
    if (contacts_) {
      contacts_->close();
      say("%s: %llu contacts of %zu frames\n", options_.contacts->c_str(), number(contacts_->row_count()),
          count);
    }
    if (distances_) {
      distances_->close();
      say("%s: %llu rows of %zu frames\n", options_.distances->c_str(), number(distances_->row_count()),
          count);
    }
    if (series_) {
      series_->close();
      say("%s: %zu frames, in the folder %s\n", options_.paraview->c_str(), series_->frame_count(),
          paraview_folder(*options_.paraview).c_str());
    }
    if (gltf_frame_) say("%s: frame %zu\n", options_.gltf->c_str(), *gltf_frame_);
  }

 private:
  const ExportOptions& options_;
  FrameRange frames_;
  std::optional<std::size_t> gltf_frame_;
  std::optional<io::ContactTable> contacts_;
  std::optional<io::DistanceTable> distances_;
  std::optional<io::ParaviewSeries> series_;
};

void export_recording(const ExportOptions& options) {
  check_export_outputs(options);
  const Recording recording(options.file);
  Exports exports(options, recording);
  SnapshotReader reader(recording, exports.first_frame());
  {
    Progress progress("frame", exports.last_frame() + 1);
    while (reader.step()) {
      progress.at(reader.snapshot().frame);
      exports.write(reader);
      if (reader.snapshot().frame == exports.last_frame()) break;
    }
  }
  exports.close();
  note_unfinished(recording, options.file);
  note_divergence(reader, options.file);
}

}  // namespace

void add_export_command(CLI::App& app) {
  CLI::App* const command = app.add_subcommand(
      "export",
      "Writes a recording for other programs: tables, a time series for ParaView, a frame as glTF.");
  const auto options = std::make_shared<ExportOptions>();
  command->add_option("file", options->file, "A recording, as graze run --record writes it")->required();
  command->add_option("--frames", options->frames, "Frames counted from 0, such as 10..20, 10.. or ..20");
  command->add_option("--csv", options->contacts, "Write a table of all contacts as CSV")->check(file_name());
  command->add_option("--distances", options->distances, "Write a table of the rows of all reports as CSV")
      ->check(file_name());
  command
      ->add_option("--paraview", options->paraview,
                   "Write a time series: this .pvd, and .vtp files in a folder beside it")
      ->check(file_name());
  command->add_option("--gltf", options->gltf, "Write a frame as glTF 2, into a .gltf or a .glb")
      ->check(file_name());
  command->add_option("--frame", options->frame, "Which frame; else the first with most contacts")
      ->check(whole_number(0));
  command->callback([options] { export_recording(*options); });
}

}  // namespace graze::tools
