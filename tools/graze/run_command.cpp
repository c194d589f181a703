#include "run_command.hpp"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <graze/io/error.hpp>
#include <graze/io/picture.hpp>
#include <graze/io/player.hpp>
#include <graze/io/report_json.hpp>
#include <graze/io/scene_file.hpp>
#include <graze/recorder.hpp>
#include <graze/scene_enumerators.hpp>
#include <graze/settings_fields.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "option_checks.hpp"
#include "output/terminal.hpp"
#include "output/text.hpp"
#include "output_files.hpp"
#include "page_output.hpp"
#include "progress.hpp"
#include "run_summary.hpp"
#include "viewer/viewer_page.hpp"

namespace graze::tools {
namespace {

using io::InputError;

struct RunOptions {
  std::vector<std::string> files;
  std::optional<std::uint32_t> frames;
  std::optional<unsigned> threads;
  std::optional<std::size_t> max_contacts;
  std::optional<std::size_t> max_contacts_per_pair;
  std::optional<double> contact_distance;
  std::optional<double> range;
  std::optional<std::string> detail;
  std::optional<std::string> accuracy;
  std::optional<double> frames_per_second;
  std::optional<std::string> report;
  std::optional<std::string> record;
  std::optional<std::uint32_t> report_every;
  bool report_pairs = false;
  bool no_times = false;
  bool outside_files = false;
  std::optional<std::string> picture;
  std::optional<std::uint32_t> picture_frame;
  std::optional<std::string> html;
  std::optional<std::uint32_t> html_every;
  std::optional<std::size_t> region_distances;
  bool ways_out = false;
  std::optional<std::size_t> carrying;
  std::optional<double> carrying_band;
  std::optional<double> sweep_tolerance;
  std::optional<double> swept_gap;
};

/// `exact`, `within:0.001`, `paper` or `paper:24,14,8`.
Accuracy parse_accuracy(const std::string& text) {
  const InputError refusal("--accuracy: expected exact, within:T or paper:E1,E2,..., got \"" + text +
                           "\"; write for example --accuracy within:0.001");
  const std::string word = text.substr(0, text.find(':'));
  std::vector<double> numbers;
  if (word.size() < text.size()) {
    std::istringstream list(text.substr(word.size() + 1));
    for (std::string part; std::getline(list, part, ',');) {
      double number = 0;
      if (!CLI::detail::lexical_cast(part, number) || !std::isfinite(number) || number < 0) throw refusal;
      numbers.push_back(number);
    }
  }
  if (word == "exact" && text == word) return Accuracy::exact();
  if (word == "within" && numbers.size() == 1) return Accuracy::within(numbers[0]);
  if (word == "paper") return Accuracy::paper(numbers);
  throw refusal;
}

ContactDetail parse_detail(const std::string& word) {
  if (const auto detail = enumerator_named<ContactDetail>(word)) return *detail;
  throw InputError("--detail: expected " + listed_names<ContactDetail>() + ", got \"" + word + "\"");
}

/// Puts what the command line says in place of what the scene says.
void replace_settings(SceneSettings& settings, const RunOptions& options) {
  static_assert(
      are_all_fields<SceneSettings, &SceneSettings::contact_distance, &SceneSettings::range,
                     &SceneSettings::detail, &SceneSettings::accuracy, &SceneSettings::threads,
                     &SceneSettings::max_contacts, &SceneSettings::max_contacts_per_pair,
                     &SceneSettings::region_distances, &SceneSettings::ways_out, &SceneSettings::carrying,
                     &SceneSettings::carrying_band, &SceneSettings::sweep_tolerance,
                     &SceneSettings::swept_gap,
                     // A run has no frame rate to keep, and its tasks are the only ones.
                     &SceneSettings::time_budget, &SceneSettings::work_budget, &SceneSettings::arena>(),
      "each setting has an option, or is named as one that has none");
  if (options.contact_distance) settings.contact_distance = *options.contact_distance;
  if (options.range) settings.range = *options.range;
  if (options.detail) settings.detail = parse_detail(*options.detail);
  if (options.accuracy) settings.accuracy = parse_accuracy(*options.accuracy);
  if (options.threads) settings.threads = *options.threads;
  if (options.max_contacts) settings.max_contacts = options.max_contacts;
  if (options.max_contacts_per_pair) settings.max_contacts_per_pair = options.max_contacts_per_pair;
  if (options.region_distances) settings.region_distances = *options.region_distances;
  if (options.ways_out) settings.ways_out = true;
  if (options.carrying) settings.carrying = *options.carrying;
  if (options.carrying_band) settings.carrying_band = options.carrying_band;
  if (options.sweep_tolerance) settings.sweep_tolerance = *options.sweep_tolerance;
  if (options.swept_gap) settings.swept_gap = *options.swept_gap;
}

/// The scene that the files name, with what the command line says in place of what the scene says.
io::SceneDescription describe(const RunOptions& options) {
  const bool is_scene = std::filesystem::path(options.files[0]).extension() == ".json";
  if (is_scene && options.files.size() > 1)
    throw InputError(options.files[1] +
                     ": stands beside a scene file; give one scene file, or mesh files only");
  io::SceneDescription scene = is_scene ? io::read_scene_file(options.files[0])
                                        : io::scene_of_meshes({options.files.begin(), options.files.end()});
  replace_settings(scene.settings, options);
  if (options.outside_files) scene.outside_files = true;
  if (options.frames) scene.frames = options.frames;
  if (options.frames_per_second) scene.frames_per_second = *options.frames_per_second;
  return scene;
}

/// Keeps the frame to be drawn: the one asked for, or the first with the most contacts.
class PictureChoice {
 public:
  explicit PictureChoice(std::optional<std::uint32_t> wanted) : wanted_(wanted) {}

  void offer(std::uint32_t frame, const io::Player& player, const ReportHandle& report) {
    const bool is_better = wanted_ ? frame == *wanted_ : !report_ || score(*report) > score(*report_);
    if (!is_better) return;
    frame_ = frame;
    report_ = report;
    scene_.objects.resize(player.objects().size());
    for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
      scene_.objects[i].mesh = player.objects()[i].mesh;
      player.read_positions(i, scene_.objects[i].positions);
    }
  }

  std::uint32_t draw(const std::filesystem::path& path) {
    scene_.contacts.assign(report_->contacts().begin(), report_->contacts().end());
    for (const PairReport& pair : report_->pairs()) {
      if (pair.phase == PairPhase::near || pair.phase == PairPhase::ended)
        scene_.distances.push_back({pair.witness.point_a, pair.witness.point_b});
      scene_.ways_out.push_back(pair.way_out);
    }
    io::write_picture(path, scene_);
    return frame_;
  }

 private:
  static std::size_t score(const FrameReport& report) { return report.contacts().size(); }

  std::optional<std::uint32_t> wanted_;
  std::uint32_t frame_ = 0;
  ReportHandle report_;
  io::PictureScene scene_;
};

/// The files that a run writes.
struct RunOutputs {
  std::optional<io::ReportWriter> report;
  std::optional<PictureChoice> picture;
  std::optional<PlayedPage> page;
  std::optional<Recorder> recorder;
};

/// Steps through all frames.
RunSummary play(io::Player& player, RunOutputs& outputs) {
  RunSummary summary(player.objects());
  Progress progress("frame", player.frame_count());
  for (std::uint32_t frame = 0; frame < player.frame_count(); ++frame) {
    progress.at(frame);
    player.advance(frame);
    const auto start = std::chrono::steady_clock::now();
    const ReportHandle report = player.scene().step();
    const std::chrono::duration<double, std::milli> elapsed = std::chrono::steady_clock::now() - start;
    summary.add(frame, *report, elapsed.count());
    if (outputs.report) outputs.report->write(frame, *report);
    if (outputs.picture) outputs.picture->offer(frame, player, report);
    if (outputs.page) outputs.page->add(frame, player, *report);
  }
  return summary;
}

/// Before anything is read, so that no run ends in vain.
OutputFiles check_outputs(const RunOptions& options) {
  if (options.picture_frame && !options.picture)
    throw InputError("--picture-frame: says which frame --picture draws; add --picture FILE");
  if ((options.report_every || options.report_pairs) && !options.report)
    throw InputError("--report-every, --report-pairs: say what --report writes; add --report FILE");
  if (options.html_every && !options.html)
    throw InputError("--html-every: says which frames --html writes; add --html FILE");
  OutputFiles files;
  if (options.report) files.add("--report", *options.report);
  if (options.record) files.add("--record", *options.record);
  if (options.picture) files.add_picture("--picture", *options.picture);
  if (options.html) add_page(files, "--html", *options.html);
  files.check_inputs(std::vector<std::filesystem::path>(options.files.begin(), options.files.end()));
  return files;
}

void warn_of_threads(unsigned threads) {
  if (threads > max_threads())
    say_aside("warning",
              format("%u threads are more than 8 for each processor; %u are used", threads, max_threads()));
}

/// A run has no frame rate to keep, so it waits for its recorder.
constexpr RecorderSettings recorder_settings{.waiting_frames = 64, .when_behind = WhenBehind::wait};

/// Only a recorder without memory loses frames of a run.
void print_recording(const std::string& file, const RecorderStatistics& statistics) {
  say("recording %s, %llu frames, %llu bytes", file.c_str(), number(statistics.frames),
      number(statistics.bytes));
  if (statistics.dropped > 0) say(", %llu frames dropped", number(statistics.dropped));
  say("\n");
  if (statistics.dropped == 0) return;
  say_aside("warning", format("%s lacks %llu frames, since there was no memory to record them; record fewer "
                              "frames, or with more memory",
                              file.c_str(), number(statistics.dropped)));
}

std::string page_title(const RunOptions& options) {
  std::vector<std::string> names;
  for (const std::string& file : options.files) names.push_back(std::filesystem::path(file).stem().string());
  return joined(names);
}

void open_outputs(RunOutputs& outputs, const RunOptions& options, io::Player& player,
                  const SceneSettings& settings) {
  if (options.report)
    outputs.report.emplace(*options.report, player.objects(), settings,
                           io::ReportWriter::Options{.include_times = !options.no_times,
                                                     .include_contacts = !options.report_pairs,
                                                     .every = options.report_every.value_or(1)});
  if (options.picture) outputs.picture.emplace(options.picture_frame);
  if (options.record) outputs.recorder.emplace(player.scene(), *options.record, recorder_settings);
  if (options.html)
    outputs.page.emplace(*options.html, player, settings,
                         PageOutput::Options{"--html", page_title(options), joined(options.files),
                                             options.html_every, !options.no_times});
}

/// Ends the outputs, with a line for each.
void close_outputs(RunOutputs& outputs, const RunOptions& options) {
  if (outputs.report) say("report    %s\n", options.report->c_str());
  if (outputs.picture) {
    const std::uint32_t frame = outputs.picture->draw(*options.picture);
    say("picture   %s, frame %u\n", options.picture->c_str(), frame);
  }
  if (outputs.recorder) print_recording(*options.record, outputs.recorder->statistics());
  if (outputs.page) say("page      %s\n", outputs.page->close().c_str());
}

/// Prints the player's warnings from the one of that number on, and returns how many there are.
std::size_t print_notes(const io::Player& player, std::size_t first) {
  for (const std::string& warning : player.warnings().subspan(first)) say_aside("note", warning);
  return player.warnings().size();
}

void run(const RunOptions& options) {
  const OutputFiles files = check_outputs(options);
  const io::SceneDescription description = describe(options);
  warn_of_threads(description.settings.threads);
  io::Player player(description);
  files.check_inputs(player.files());
  const std::size_t said = print_notes(player, 0);
  if (options.picture_frame && *options.picture_frame >= player.frame_count())
    throw InputError("--picture-frame: the run ends before frame " + std::to_string(*options.picture_frame) +
                     "; frames are 0 to " + std::to_string(player.frame_count() - 1));
  RunOutputs outputs;
  open_outputs(outputs, options, player, description.settings);
  const RunSummary summary = play(player, outputs);
  print_notes(player, said);
  if (outputs.report) outputs.report->close();
  if (outputs.recorder) outputs.recorder->close();
  say("%s", summary.text().c_str());
  close_outputs(outputs, options);
}

}  // namespace

void add_run_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "run", "Steps through a scene, prints what touched, where and when, and writes what is asked for.");
  const auto options = std::make_shared<RunOptions>();
  command->add_option("files", options->files, "A scene file (.json), or mesh files that make a scene")
      ->required();
  command
      ->add_option("--frames", options->frames, "How many frames; else the scene's, else the longest motion")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()));
  command
      ->add_option("--threads", options->threads,
                   "How many threads; 0, the default: one for each processor. At most 8 for each are used")
      ->check(whole_number(0, std::numeric_limits<unsigned>::max()));
  command
      ->add_option("--contact-distance", options->contact_distance, "Strictly closer than this is a contact")
      ->check(real_number(NumberRange::at_least_0));
  command->add_option("--range", options->range, "Pairs closer than this are listed with their distance")
      ->check(real_number(NumberRange::at_least_0_or_infinite));
  command->add_option("--detail", options->detail, listed_names<ContactDetail>());
  command->add_option("--accuracy", options->accuracy, "exact, within:T, paper or paper:E1,E2,...");
  command
      ->add_option("--max-contacts", options->max_contacts,
                   "List at most so many contacts a frame, the nearest")
      ->check(whole_number(1));
  command
      ->add_option("--max-contacts-per-pair", options->max_contacts_per_pair,
                   "List at most so many contacts of each pair, the nearest")
      ->check(whole_number(1));
  command
      ->add_option("--frames-per-second", options->frames_per_second, "At which rate animations are sampled")
      ->check(real_number(NumberRange::above_0));
  command
      ->add_option("--report", options->report,
                   "Write a report, JSON Lines, a line a frame; compressed if the name ends in .gz")
      ->check(file_name());
  command->add_option("--report-every", options->report_every, "Write each K-th frame into the report")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()));
  command->add_flag("--report-pairs", options->report_pairs,
                    "Leave contacts out of the report: pairs alone, with their number of contacts");
  command->add_option("--record", options->record, "Record the run, for graze replay, view and picture")
      ->check(file_name());
  command->add_flag("--outside-files", options->outside_files,
                    "Let mesh files name files outside their own folders, such as buffers of glTF");
  command->add_flag("--no-times", options->no_times,
                    "Leave timings out of the report and the page: equal runs, equal files");
  command->add_option("--picture", options->picture, "Draw one frame into a PNG")->check(file_name());
  command
      ->add_option("--picture-frame", options->picture_frame, "Which one; else the first with most contacts")
      ->check(whole_number(0, std::numeric_limits<std::uint32_t>::max()));
  command
      ->add_option("--html", options->html,
                   std::string("Write a page that plays all frames in a browser, or its data (.grazeview)") +
                       (has_viewer() ? "" : "; this graze was built without the viewer: data only"))
      ->check(file_name());
  command->add_option("--html-every", options->html_every, "Write each K-th frame into the page")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()));
  command
      ->add_option(
          "--region-distances", options->region_distances,
          "List at most so many distances between regions a frame, for the page; 0, the default: none")
      ->check(whole_number(0));
  command->add_flag("--ways-out", options->ways_out,
                    "Say how objects leave each other whose surfaces pass through each other");
  command
      ->add_option("--carrying", options->carrying,
                   "With nearest, list at most so many contacts of each pair, chosen to carry it; 0: all")
      ->check(whole_number(0));
  command
      ->add_option("--carrying-band", options->carrying_band,
                   "How much less deep than the deepest they may be; else the threshold of the pair")
      ->check(real_number(NumberRange::at_least_0));
  command
      ->add_option("--sweep-tolerance", options->sweep_tolerance,
                   "How far apart the bounds of an impact's time are at most, of a step that takes time 1")
      ->check(real_number(NumberRange::at_least_0));
  command
      ->add_option("--swept-gap", options->swept_gap,
                   "Say when swept objects come that near on the way; 0: do not")
      ->check(real_number(NumberRange::at_least_0));
  command->callback([options] { run(*options); });
}

}  // namespace graze::tools
