#include "stress/command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include "check_failed.hpp"
#include "option_checks.hpp"
#include "output/text_file.hpp"
#include "output_path.hpp"
#include "stress/budgets.hpp"
#include "stress/determinism.hpp"
#include "stress/neighbours/coinciding.hpp"
#include "stress/neighbours/costly.hpp"
#include "stress/neighbours/inside.hpp"
#include "stress/neighbours/never_touching.hpp"
#include "stress/objects.hpp"
#include "stress/reader.hpp"
#include "stress/reading.hpp"
#include "stress/soak/soak.hpp"
#include "stress/together.hpp"

namespace graze::tools {
namespace {

struct StressOptions {
  bool reader = false, soak = false, determinism = false, budgets = false, coinciding = false, costly = false;
  bool never_touching = false, inside = false, together = false;
  double seconds = 60;
  ObjectsOptions objects;
  ReadingOptions reading;
  SoakOptions soaking;
  DeterminismOptions playing;
  BudgetsOptions budgeted;
  std::size_t frames = 0;
  std::optional<std::filesystem::path> out;
};

void run(StressOptions options) {
  if (options.out) check_output_file("--out", *options.out);
  StressResult result;
  if (options.reader) {
    result = run_reader_study(options.seconds);
  } else if (options.soak) {
    options.soaking.frames = options.frames;
    result = run_soak_study(options.soaking);
  } else if (options.determinism) {
    if (options.frames > 0) options.playing.frames = options.frames;
    result = run_determinism_study(options.playing);
  } else if (options.coinciding) {
    result = run_coinciding_study(options.frames > 0 ? options.frames : 9);
  } else if (options.costly) {
    result = run_costly_study(options.frames > 0 ? options.frames : 9);
  } else if (options.never_touching) {
    result = run_never_touching_study(options.frames > 0 ? options.frames : 50);
  } else if (options.inside) {
    result = run_inside_study(options.frames > 0 ? options.frames : 5);
  } else if (options.reading.objects > 0) {
    if (options.frames > 0) options.reading.frames = options.frames;
    result = run_reading_study(options.reading);
  } else if (options.together) {
    result = run_together_study(options.frames > 0 ? TogetherOptions{options.frames} : TogetherOptions{});
  } else if (options.budgets) {
    if (options.frames > 0) options.budgeted.frames = options.frames;
    result = run_budgets_study(options.budgeted);
  } else {
    options.objects.frames = options.frames;
    result = run_objects_study(options.objects);
  }
  result.figures["cores"] = std::thread::hardware_concurrency();
  if (options.out) write_text_file(*options.out, result.figures.dump(2) + "\n");
  throw_violations(result.violations);
}

}  // namespace

void add_stress_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("stress",
                                         "Puts graze under load: one of --reader, --objects, --soak, "
                                         "--determinism, --budgets, --coinciding, --costly, "
                                         "--never-touching, --inside, --reading and --together.");
  const auto options = std::make_shared<StressOptions>();
  auto* const studies = command->add_option_group("studies")->require_option(1);
  studies->add_flag("--reader", options->reader,
                    "A reader at 1 kHz beside a loop that steps without a pause");
  studies
      ->add_option("--objects", options->objects.counts,
                   "Scenes of so many objects: time, memory and what threads bring")
      ->delimiter(',')
      ->check(whole_number(2, 1'000'000));
  studies->add_flag("--soak", options->soak, "A long run of everything, bad input included");
  studies->add_flag("--determinism", options->determinism,
                    "The same bits from 1 to 16 threads, again and again");
  studies->add_flag("--coinciding", options->coinciding,
                    "Surfaces that coincide exactly beside neighbours in which they do not");
  studies->add_flag("--costly", options->costly,
                    "Long faces across the axes, and small bodies nearly in one place, beside neighbours");
  studies->add_flag(
      "--never-touching", options->never_touching,
      "Objects that lie in each other but can never touch, beside one that moves far from them");
  studies->add_flag("--inside", options->inside, "A body wholly inside a solid, beside a plain tree");
  studies
      ->add_option("--reading", options->reading.objects,
                   "How long a step takes to read so many objects, beside a plain loop")
      ->check(whole_number(2, 1'000'000));
  studies->add_flag("--together", options->together, "A small scene that steps beside a large one");
  studies->add_flag("--budgets", options->budgets, "Time budgets where everything is in contact");
  command->add_option("--threads", options->budgeted.threads, "With how many threads --budgets steps")
      ->check(thread_number())
      ->capture_default_str();
  command->add_option("--seconds", options->seconds, "How long --reader reads")
      ->check(real_number(NumberRange::above_0))
      ->capture_default_str();
  command->add_option("--minutes", options->soaking.minutes, "How long --soak takes")
      ->check(real_number(NumberRange::above_0))
      ->capture_default_str();
  command->add_option("--seed", options->soaking.seed, "Another soak")
      ->check(whole_number(0))
      ->capture_default_str();
  command
      ->add_option(
          "--frames", options->frames,
          "How many frames --objects times, --determinism, --coinciding, --costly, --never-touching, "
          "--inside, --reading and --together play and --budgets steps each scene; by default 20, 9, "
          "9, 50, 5, 9, 400 and 100 of the latter eight, and more of smaller scenes. --soak takes as "
          "many in place of --minutes")
      ->check(whole_number(1));
  command->add_option("--repeats", options->playing.repeats, "How often --determinism plays each scene")
      ->check(whole_number(1))
      ->capture_default_str();
  command->add_flag("--large", options->playing.large,
                    "In --determinism the large pair has 100,000 vertices each, else 10,000");
  command->add_option("--out", options->out, "Write the figures into this file, as JSON")->check(file_name());
  command->callback([options] { run(*options); });
}

}  // namespace graze::tools
