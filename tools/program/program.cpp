#include "program.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

#include "check_failed.hpp"
#include "command_mistake.hpp"
#include "output/terminal.hpp"

namespace graze::tools {
namespace {

constexpr int check_failed = 1;
constexpr int bad_input = 2;

int complain(const Program& program, const std::string& message, int exit_code) {
  say_aside(program.name.c_str(), message);
  return exit_code;
}

int run_command_line(const Program& program, int argument_count, char** arguments) {
  CLI::App app(program.description, program.name);
  app.set_version_flag("--version", program.name + " " + GRAZE_VERSION);
  app.require_subcommand(1);
  program.add_commands(app);
  try {
    app.parse(argument_count, arguments);  // runs the subcommand
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    return complain(program, mistake_of(app, error, program.moved), bad_input);
  }
  return 0;
}

/// Errors become a line and an exit code.
int run_guarded(const Program& program, int argument_count, char** arguments) {
  try {
    return run_command_line(program, argument_count, arguments);
  } catch (const CheckFailed& error) {
    return complain(program, error.what(), check_failed);
  } catch (const std::bad_alloc&) {
    return complain(program,
                    "there is not enough memory; take smaller meshes, fewer objects or fewer outputs",
                    bad_input);
  } catch (const std::exception& error) {
    return complain(program, error.what(), bad_input);
  }
}

}  // namespace

int run_program(const Program& program, int argument_count, char** arguments) {
  keep_standard_streams();
  const int exit_code = run_guarded(program, argument_count, arguments);
  if (is_standard_output_whole()) return exit_code;
  return complain(program,
                  "standard output: not all of it could be written; free some space, or send it elsewhere",
                  bad_input);
}

}  // namespace graze::tools
