#include "accuracy/command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <graze/io/error.hpp>
#include <memory>
#include <string>

#include "accuracy/page.hpp"
#include "accuracy/plot.hpp"
#include "check_failed.hpp"
#include "figures/figure_plot.hpp"
#include "option_checks.hpp"
#include "output/text_file.hpp"
#include "output_path.hpp"
#include "progress.hpp"

namespace graze::tools {
namespace {

struct AccuracyOptions {
  std::filesystem::path out = "docs/accuracy.md";
  std::uint64_t count = 20000;
  std::uint64_t seed = 1;
  bool quick = false;
  bool no_times = false;
};

/// How much is measured.
struct Extent {
  std::uint64_t scenes;
  std::uint32_t frames;
  std::uint32_t check_every;  ///< pairs of models, with the oracle
  std::uint32_t runs;         ///< of each setting
};

Extent extent_of(const AccuracyOptions& options) {
  if (options.quick) return {std::min<std::uint64_t>(options.count, 80), 3, 13, 1};
  return {options.count, 24, 3, options.no_times ? 1U : 5U};
}

void measure_kernels(const AccuracyOptions& options, const Extent& extent, AccuracyResults& results) {
  Progress progress("scene", all_input_kinds.size() * extent.scenes);
  std::uint64_t done = 0;
  for (const InputKind input : all_input_kinds)
    for (std::uint64_t index = 0; index < extent.scenes; ++index) {
      progress.at(done++);
      results.kernels[static_cast<std::size_t>(input)].add(kernel_scene(input, options.seed, index));
    }
}

std::vector<ModeResult> measure_all(const ModeStudy& study, const std::vector<ModeSetting>& settings,
                                    std::uint32_t runs) {
  std::vector<ModeResult> results;
  Progress progress("setting", settings.size());
  for (const ModeSetting& setting : settings) {
    progress.at(results.size());
    results.push_back(study.measure(setting, runs));
  }
  return results;
}

void measure_modes(const AccuracyOptions& options, const Extent& extent, AccuracyResults& results) {
  const MovingModels models(options.seed, extent.frames);
  const double distance = models.mean_edge_length();
  results.frames = extent.frames;
  results.runs = extent.runs;
  results.edge_length = models.mean_edge_length();
  results.contact_distance = distance;
  results.level_epsilon = models.level_epsilon();
  const ModeStudy study(models, distance);
  results.truth = check_truth(models, study, extent.check_every);
  for (const ContactDetail detail : {ContactDetail::none, ContactDetail::features}) {
    const ModeResult exact =
        study.measure({"exact", ModeFamily::exact, exact_settings(detail, distance)}, extent.runs);
    const std::uint64_t work = exact.region_pairs / extent.frames;
    ModeTable table{
        detail, measure_all(study, surface_settings(models, detail, distance, work), extent.runs), {}};
    if (!options.no_times)
      table.timed = measure_all(study, timed_settings(detail, distance, exact.step_ms), extent.runs);
    results.modes.push_back(std::move(table));
  }
  for (const ContactDetail detail : {ContactDetail::regions, ContactDetail::vertices})
    results.modes.push_back(
        {detail, measure_all(study, vertex_settings(models, detail, distance), extent.runs), {}});
}

void refuse_bad_output(const AccuracyOptions& options) {
  if (!options.no_times && !has_gnuplot())
    throw io::InputError(
        "gnuplot: not found, and the figure is drawn by it; install gnuplot-nox, or add --no-times");
  check_output_file("--out", options.out);
}

void write_page(const AccuracyOptions& options, const AccuracyResults& results) {
  std::filesystem::path figure;
  if (!options.no_times) {
    figure = options.out;
    figure.replace_extension(".png");
    plot_time_against_error(figure, results.modes);
  }
  write_text_file(options.out, page_of(results, figure.filename().string()));
}

void run(const AccuracyOptions& options) {
  refuse_bad_output(options);
  const Extent extent = extent_of(options);
  AccuracyResults results;
  results.seed = options.seed;
  measure_kernels(options, extent, results);
  measure_modes(options, extent, results);
  write_page(options, results);
  throw_violations(violations_of(results));
  std::printf("accuracy  nothing violated; %s\n", options.out.string().c_str());
}

}  // namespace

void add_accuracy_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "accuracy",
      "Measures every kernel and accuracy setting against exact arithmetic, and writes a page of tables.");
  const auto options = std::make_shared<AccuracyOptions>();
  command->add_option("--out", options->out, "The page, in Markdown; the figure is a PNG beside it")
      ->check(file_name())
      ->capture_default_str();
  command->add_option("--count", options->count, "How many scenes of each kind of input")
      ->check(whole_number(1))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Other scenes and motions")
      ->check(whole_number(0))
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "A small count and few frames");
  command->add_flag("--no-times", options->no_times,
                    "Leave out what depends on the machine, figure included: equal seeds, equal pages");
  command->callback([options] { run(*options); });
}

}  // namespace graze::tools
