#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <graze/error.hpp>
#include <string>

#include "inspect_command.hpp"
#include "run_command.hpp"

namespace {

constexpr int bad_input = 2;

int complain(std::string message) {
  for (char& letter : message)
    if (letter == '\n') letter = ' ';
  std::fprintf(stderr, "graze: %s\n", message.c_str());
  return bad_input;
}

int run_program(int argument_count, char** arguments) {
  CLI::App app("Proximity and contact between deformable and rigid surfaces, for scenes in files.", "graze");
  app.set_version_flag("--version", "graze " GRAZE_VERSION);
  app.require_subcommand(1);
  graze::tools::add_run_command(app);
  graze::tools::add_inspect_command(app);
  try {
    app.parse(argument_count, arguments);  // runs the subcommand
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return complain(std::string(error.what()) + "; graze --help says what can be asked for");
  }
  return 0;
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    return run_program(argument_count, arguments);
  } catch (const std::exception& error) {
    return complain(error.what());
  }
}
