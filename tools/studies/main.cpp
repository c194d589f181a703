#include "program.hpp"
#include "stress/command.hpp"
#if GRAZE_HAS_BENCH
#include "bench/command.hpp"
#endif
#if GRAZE_HAS_ORACLES
#include "accuracy/command.hpp"
#include "experiment/command.hpp"
#endif

namespace {

void add_commands(CLI::App& app) {
  graze::tools::add_stress_command(app);
#if GRAZE_HAS_BENCH
  graze::tools::add_bench_command(app);
#endif
#if GRAZE_HAS_ORACLES
  graze::tools::add_accuracy_command(app);
  graze::tools::add_experiment_command(app);
#elif GRAZE_HAS_BENCH
  app.footer("Built without accuracy and experiment, which need GMP.");
#else
  app.footer(
      "Built without bench, accuracy and experiment: configure graze with -DGRAZE_STUDIES=ON for them.");
#endif
}

}  // namespace

int main(int argument_count, char** arguments) {
  return graze::tools::run_program({.name = "graze_studies",
                                    .description = "Measures graze: its speed, its errors, and how it does "
                                                   "under load.",
                                    .add_commands = add_commands},
                                   argument_count, arguments);
}
