#include "bench/command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <graze/instruction_set.hpp>
#include <graze/io/error.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/aims.hpp"
#include "bench/comparisons.hpp"
#include "bench/growth_figures.hpp"
#include "bench/options.hpp"
#include "bench/peer_module.hpp"
#include "bench/run.hpp"
#include "bench/tables.hpp"
#include "check_failed.hpp"
#include "option_checks.hpp"
#include "output/text.hpp"
#include "output/text_file.hpp"
#include "output_files.hpp"

namespace graze::tools {
namespace {

std::vector<std::string_view> peers_of(const BenchOptions& options, const bench::PeerModule& module) {
  std::vector<std::string_view> names;
  if (options.peers == std::vector<std::string>{"none"}) return names;
  if (options.peers == std::vector<std::string>{"all"}) {
    for (const bench::PeerEntry& entry : module.entries())
      if (!bench::is_limit(entry.name)) names.push_back(entry.name);
    return names;
  }
  for (const std::string& name : options.peers) names.push_back(module.entry(name).name);
  return names;
}

InstructionSet instruction_set_of(const std::string& name) {
  std::string known;
  for (const InstructionSet set : available_instruction_sets()) {
    if (to_string(set) == name) return set;
    known += (known.empty() ? "" : ", ") + std::string(to_string(set));
  }
  throw io::InputError("no instruction set \"" + name + "\" here; there are " + known);
}

/// By default AVX2, which the peers are compiled for, and what is better.
std::vector<InstructionSet> instruction_sets_of(const std::vector<std::string>& names) {
  std::vector<InstructionSet> sets;
  sets.reserve(names.size());
  for (const std::string& name : names) sets.push_back(instruction_set_of(name));
  if (!sets.empty()) return sets;
  for (const InstructionSet set : available_instruction_sets())
    if (set >= InstructionSet::avx2) sets.push_back(set);
  if (sets.empty()) sets.push_back(available_instruction_sets().back());
  return sets;
}

void check_scenes(const std::vector<std::string>& wanted) {
  const auto names = bench::scene_names();
  for (const std::string& name : wanted)
    if (std::none_of(names.begin(), names.end(),
                     [&](std::string_view scene) { return is_asked_for(scene, {name}); }))
      throw io::InputError("no scene \"" + name +
                           "\"; there are S1 to S10, and G100 to G10000 and V1000 to V100000");
}

std::vector<bench::Run> run_all(const BenchOptions& options, const std::vector<InstructionSet>& sets,
                                const bench::PeerModule& module) {
  std::vector<bench::Run> runs;
  for_each_scene(options, [&](const bench::BenchScene& scene) {
    for (const std::string& task : options.tasks)
      for (const unsigned threads : options.threads) {
        bench::RunOptions run;
        run.task = static_cast<bench::Task>(task.front());
        run.threads = threads;
        run.frames = options.frames;
        run.evict = options.evict;
        run.is_recorded = options.is_recorded;
        run.slow = options.slow;
        run.peers = peers_of(options, module);
        run.instruction_sets = sets;
        runs.push_back(bench::run_scene(scene, run, module));
        print(bench::table_of(runs.back()));
      }
  });
  return runs;
}

void check_answers(const std::vector<bench::Run>& runs) {
  for (const bench::Run& run : runs)
    for (const bench::Timing& timing : run.timings)
      if (timing.name.starts_with(bench::graze_name) && !timing.complaint.empty())
        throw CheckFailed(run.scene + ", task " + static_cast<char>(run.task) + ": " + timing.complaint);
}

/// Any file in the folder of real meshes may be read.
void check_outputs(const BenchOptions& options) {
  OutputFiles outputs;
  if (options.csv) outputs.add("--csv", *options.csv);
  if (options.json) outputs.add("--json", *options.json);
  std::vector<std::filesystem::path> inputs;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(options.data, ignored))
    inputs.push_back(entry.path());
  outputs.check_inputs(inputs);
}

void run(const BenchOptions& options) {
  check_scenes(options.scenes);
  check_outputs(options);
  if (compare_instead(options)) return;
  const std::vector<InstructionSet> sets = instruction_sets_of(options.instruction_sets);
  const bench::PeerModule module;
  const bench::Surroundings surroundings = bench::surroundings(module, sets);
  print(bench::heading(surroundings));
  const std::vector<bench::Run> runs = run_all(options, sets, module);
  const std::vector<bench::Aim> aims = bench::aims_of(runs);
  if (options.aims) print(bench::table_of(aims));
  if (options.csv) write_text_file(*options.csv, bench::csv_of(runs));
  nlohmann::ordered_json figures = bench::figures_of(surroundings);
  figures["runs"] = nlohmann::ordered_json::array();
  for (const bench::Run& run : runs) figures["runs"].push_back(bench::figures_of(run));
  figures["aims"] = bench::figures_of(aims);
  if (options.json) write_text_file(*options.json, figures.dump(2) + "\n");
  if (!options.figures.empty()) bench::draw_growth(options.figures, runs);
  check_answers(runs);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "bench", "Measures graze, what it competes with and the limits on the same positions in one run.");
  const auto options = std::make_shared<BenchOptions>();
  command
      ->add_option("--scenes", options->scenes,
                   "Which of S1 to S10, all by default; or of G100 to G10000 and V1000 to V100000")
      ->delimiter(',');
  command->add_option("--tasks", options->tasks, "A: vertex pairs, B: contacts, D: distances of objects")
      ->delimiter(',')
      ->check(CLI::IsMember({"A", "B", "D"}))
      ->capture_default_str();
  command->add_option("--threads", options->threads, "One run for each number of threads")
      ->delimiter(',')
      ->check(thread_number())
      ->capture_default_str();
  command->add_option("--frames", options->frames, "How many are timed; by default each scene's own number")
      ->check(whole_number(1));
  command->add_option("--peers", options->peers, "all, none, or some by name")
      ->delimiter(',')
      ->capture_default_str();
  command->add_flag("--aims", options->aims,
                    "End with a table of graze's own aims beside what was measured (docs/performance.md)");
  command->add_flag("--details", options->details,
                    "Instead compare the details features and nearest, with and without solids");
  command->add_flag("--rays", options->rays, "Instead cast rays at the scenes with graze and with Embree");
#if GRAZE_BENCH_KERNELS
  command->add_flag(
      "--scaling", options->scaling,
      "Instead say how steps scale: stages, a model of more processors, and this machine's threads");
#endif
  command->add_flag("--self", options->self,
                    "Instead compare graze and Bullet on a cloth that folds into a heap, near itself");
  command->add_flag(
      "--soft-bodies", options->soft_bodies,
      "Instead compare graze and Bullet as the source of contacts of one solver of soft bodies");
  CLI::Option* const rigid_bodies = command->add_flag("--rigid-bodies", options->rigid_bodies,
                                                      "Instead compare graze, clipped faces and Bullet as "
                                                      "the source of contacts of one solver of rigid bodies");
  command->add_flag("--quick", options->is_quick, "With --rigid-bodies: few bodies and few steps")
      ->needs(rigid_bodies);
  command->add_flag("--recorded", options->is_recorded, "Measure graze once more, with a recorder attached");
  command->add_flag("--evict", options->evict, "Touch 64 MB of other memory before each turn");
  command->add_option("--slow", options->slow, "Play scenes so many times slower")
      ->check(whole_number(1, 4096))
      ->capture_default_str();
  command
      ->add_option("--instruction-set", options->instruction_sets,
                   "What graze's kernels use; of several, the first is compared with --aims. By default avx2 "
                   "and what is better")
      ->delimiter(',');
  command->add_option("--data", options->data, "The folder of real meshes, for S7")->capture_default_str();
  command->add_option("--csv", options->csv, "Write a line for each contender of each run into this file")
      ->check(file_name());
  command->add_option("--json", options->json, "Write all figures into this file")->check(file_name());
  command
      ->add_option(
          "--figures", options->figures,
          "Draw times against the number of objects and vertices into this folder, from the scenes G "
          "and V")
      ->check(CLI::ExistingDirectory);
  command->callback([options] { run(*options); });
}

}  // namespace graze::tools
