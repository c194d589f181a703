#include <CLI/CLI.hpp>
#include <exception>
#include <graze/error.hpp>
#include <new>
#include <string>

#if GRAZE_HAS_ORACLES
#include "accuracy/command.hpp"
#include "experiment/command.hpp"
#endif
#if GRAZE_HAS_BENCH
#include "bench/command.hpp"
#endif
#include "check_failed.hpp"
#include "command_mistake.hpp"
#include "inspect_command.hpp"
#include "output/terminal.hpp"
#include "recording/commands.hpp"
#include "run_command.hpp"
#if GRAZE_HAS_STRESS
#include "stress/command.hpp"
#endif

namespace {

constexpr int check_failed = 1;
constexpr int bad_input = 2;

int complain(const std::string& message, int exit_code) {
  graze::tools::say_aside("graze", message);
  return exit_code;
}

int run_program(int argument_count, char** arguments) {
  CLI::App app("Proximity and contact between deformable and rigid surfaces, for scenes in files.", "graze");
  app.set_version_flag("--version", "graze " GRAZE_VERSION);
  app.require_subcommand(1);
  graze::tools::add_run_command(app);
  graze::tools::add_inspect_command(app);
  graze::tools::add_replay_command(app);
  graze::tools::add_info_command(app);
  graze::tools::add_cut_command(app);
  graze::tools::add_view_command(app);
  graze::tools::add_picture_command(app);
  graze::tools::add_export_command(app);
#if GRAZE_HAS_STRESS
  graze::tools::add_stress_command(app);
#endif
#if GRAZE_HAS_BENCH
  graze::tools::add_bench_command(app);
#elif GRAZE_HAS_STRESS
  app.footer(
      "Built without bench, accuracy and experiment: configure graze with -DGRAZE_STUDIES=ON for them.");
#else
  app.footer(
      "Built without stress, bench, accuracy and experiment: cmake --preset release builds a graze with "
      "them.");
#endif
#if GRAZE_HAS_ORACLES
  graze::tools::add_accuracy_command(app);
  graze::tools::add_experiment_command(app);
#endif
  try {
    app.parse(argument_count, arguments);  // runs the subcommand
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return complain(graze::tools::mistake_of(app, error), bad_input);
  }
  return 0;
}

/// Runs the program. Errors become a line and an exit code.
int run_guarded(int argument_count, char** arguments) {
  try {
    return run_program(argument_count, arguments);
  } catch (const graze::tools::CheckFailed& error) {
    return complain(error.what(), check_failed);
  } catch (const std::bad_alloc&) {
    return complain("there is not enough memory; take smaller meshes, fewer objects or fewer outputs",
                    bad_input);
  } catch (const std::exception& error) {
    return complain(error.what(), bad_input);
  }
}

}  // namespace

int main(int argument_count, char** arguments) {
  graze::tools::keep_standard_streams();
  const int exit_code = run_guarded(argument_count, arguments);
  if (graze::tools::is_standard_output_whole()) return exit_code;
  return complain("standard output: not all of it could be written; free some space, or send it elsewhere",
                  bad_input);
}
