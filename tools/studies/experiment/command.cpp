#include "experiment/command.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <graze/io/error.hpp>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "experiment/paper/paper_experiment.hpp"
#include "experiment/regions/subdivision_study.hpp"
#include "experiment/report/run_studies.hpp"
#include "experiment/speed/speed_against_error.hpp"
#include "option_checks.hpp"

namespace graze::tools {
namespace {

struct CommandOptions {
  std::string what;
  std::filesystem::path docs;
  bool no_times = false;
  ExperimentOptions experiment;
};

StudyMaker paper_maker(int number) {
  return {std::to_string(number),
          [number](const ExperimentOptions& options) { return paper_experiment(number, options); }};
}

std::vector<StudyMaker> all_makers() {
  return {paper_maker(1),
          paper_maker(2),
          paper_maker(3),
          {"subdivision", subdivision_study},
          {"speed", speed_against_error_study}};
}

std::vector<StudyMaker> makers_of(const std::string& what) {
  std::vector<StudyMaker> makers = all_makers();
  if (what != "all") std::erase_if(makers, [&](const StudyMaker& maker) { return maker.name != what; });
  return makers;
}

std::vector<std::string> words() {
  std::vector<std::string> words;
  for (const StudyMaker& maker : all_makers()) words.push_back(maker.name);
  words.emplace_back("all");
  return words;
}

void run(CommandOptions options) {
  if (!options.docs.empty() && options.what != "all")
    throw io::InputError("--docs: goes with `all`, for the document has every study in it");
  options.experiment.times = !options.no_times;
  if (options.no_times) options.experiment.runs = 1;
  run_studies(makers_of(options.what), options.experiment, options.docs);
  std::printf("experiment  all that has to hold does; %s\n",
              (options.experiment.out / "experiments.html").string().c_str());
}

}  // namespace

void add_experiment_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("experiment",
                                         "Plays the paper's experiments beside the truth, and compares "
                                         "subdivisions, and speed with error.");
  const auto options = std::make_shared<CommandOptions>();
  options->experiment.out = "out/experiments";
  options->experiment.data = GRAZE_SHARED_DATA;
  command->add_option("what", options->what, "Which study")->required()->check(CLI::IsMember(words()));
  command
      ->add_option("--out", options->experiment.out, "The folder for CSV files, figures and experiments.html")
      ->capture_default_str();
  command->add_option("--docs", options->docs,
                      "The folder where experiments.md is written, with images beside it");
  command->add_option("--frames", options->experiment.frames, "How many frames; else as many as the paper")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()));
  command->add_option("--runs", options->experiment.runs, "Times are the fastest of so many")
      ->check(whole_number(1, std::numeric_limits<std::uint32_t>::max()))
      ->capture_default_str();
  command->add_option("--seed", options->experiment.seed, "Other motions")
      ->check(whole_number(0))
      ->capture_default_str();
  command->add_option("--data", options->experiment.data, "The folder of real meshes")->capture_default_str();
  command->add_flag("--no-times", options->no_times,
                    "Leave out what depends on the machine: equal seeds, equal files");
  command->callback([options] { run(*options); });
}

}  // namespace graze::tools
