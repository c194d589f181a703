#pragma once

#include <CLI/App.hpp>
#include <map>
#include <string>

namespace graze::tools {

/// A program of several commands, as a user calls it.
struct Program {
  std::string name;
  std::string description;                     ///< a sentence, for `--help`
  void (*add_commands)(CLI::App& app);         ///< also a footer, where one is needed
  std::map<std::string, std::string> moved{};  ///< commands that other programs have: their programs
};

/// Parses the command line, runs the command that it asks for, and returns the exit code: 0, 1 where a check
/// failed, 2 for bad input. An error is one line on standard error that begins with the program's name.
int run_program(const Program& program, int argument_count, char** arguments);

}  // namespace graze::tools
