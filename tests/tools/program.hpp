#pragma once

#include <string>
#include <vector>

namespace graze::tests {

struct ProgramResult {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// Runs the built `graze` with these arguments, its output piped.
ProgramResult run_graze(const std::vector<std::string>& arguments);

/// Runs the built `graze` with standard output redirected by the shell, such as by `>/dev/full`. `out` is
/// empty.
ProgramResult run_graze_redirected(const std::vector<std::string>& arguments, const std::string& redirection);

/// Runs the built `graze_studies` with these arguments, its output piped.
ProgramResult run_studies(const std::vector<std::string>& arguments);

/// Whether a text is exactly one line.
bool is_one_line(const std::string& text);

}  // namespace graze::tests
