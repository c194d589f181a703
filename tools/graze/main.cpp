#include "inspect_command.hpp"
#include "program.hpp"
#include "recording/commands.hpp"
#include "run_command.hpp"

namespace {

void add_commands(CLI::App& app) {
  graze::tools::add_run_command(app);
  graze::tools::add_inspect_command(app);
  graze::tools::add_replay_command(app);
  graze::tools::add_info_command(app);
  graze::tools::add_worst_command(app);
  graze::tools::add_cut_command(app);
  graze::tools::add_view_command(app);
  graze::tools::add_picture_command(app);
  graze::tools::add_export_command(app);
}

}  // namespace

int main(int argument_count, char** arguments) {
  const std::string studies = "graze_studies";
  return graze::tools::run_program(
      {.name = "graze",
       .description = "Proximity and contact between deformable and rigid surfaces, for scenes in files.",
       .add_commands = add_commands,
       .moved = {{"stress", studies}, {"bench", studies}, {"accuracy", studies}, {"experiment", studies}}},
      argument_count, arguments);
}
