#pragma once

#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"

namespace graze::tests {

struct BadCall {
  std::vector<std::string> arguments;
  std::string complaint;
};

/// Each call of a program, which `run` runs, ends with exit code 2 and one line on standard error that has
/// the program's name and the complaint.
inline void check_refused(ProgramResult (*run)(const std::vector<std::string>&), const std::string& program,
                          const std::vector<BadCall>& calls) {
  for (const BadCall& call : calls) {
    const ProgramResult result = run(call.arguments);
    INFO("wanted: " << call.complaint << "\ngot: " << result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Catch::Matchers::Contains(program + ": " + call.complaint));
  }
}

}  // namespace graze::tests
