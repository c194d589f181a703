#include "tools/program.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>

#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

std::string quoted(const std::string& argument) {
  std::string text = "'";
  for (const char letter : argument) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return text + "'";
}

ProgramResult run_redirected(const std::string& program, const std::vector<std::string>& arguments,
                             const std::string& redirection) {
  const TemporaryFolder folder;
  std::string command = quoted(program);
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  command += " " + redirection + " 2>" + quoted((folder / "err").string());
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", read_file(folder / "err")};
}

ProgramResult run_piped(const std::string& program, const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  ProgramResult result = run_redirected(program, arguments, ">" + quoted((folder / "out").string()));
  result.out = read_file(folder / "out");
  return result;
}

}  // namespace

ProgramResult run_graze(const std::vector<std::string>& arguments) {
  return run_piped(GRAZE_PROGRAM, arguments);
}

ProgramResult run_graze_redirected(const std::vector<std::string>& arguments,
                                   const std::string& redirection) {
  return run_redirected(GRAZE_PROGRAM, arguments, redirection);
}

ProgramResult run_studies(const std::vector<std::string>& arguments) {
  return run_piped(GRAZE_STUDIES_PROGRAM, arguments);
}

bool is_one_line(const std::string& text) {
  return !text.empty() && text.back() == '\n' && std::ranges::count(text, '\n') == 1;
}

}  // namespace graze::tests
