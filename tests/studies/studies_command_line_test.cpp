// `graze_studies` refuses command lines that cannot be meant, in the words of `graze`. It lists its commands.

#include <graze/settings.hpp>
#include <graze/version.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/bad_calls.hpp"
#include "tools/program.hpp"
#include "tools/temporary_folder.hpp"

namespace graze::tests {
namespace {

using Catch::Matchers::Contains;

void check_studies_refuse(const std::vector<BadCall>& calls) {
  check_refused(run_studies, "graze_studies", calls);
}

/// The names in the list of commands of a program's help.
std::vector<std::string> listed_commands(const std::string& help) {
  std::vector<std::string> names;
  const std::string heading = "Subcommands:\n";
  std::size_t line = help.find(heading);
  if (line == std::string::npos) return names;
  for (line += heading.size(); help.compare(line, 2, "  ") == 0; line = help.find('\n', line) + 1)
    if (help[line + 2] != ' ') names.push_back(help.substr(line + 2, help.find(' ', line + 2) - line - 2));
  return names;
}

#if GRAZE_HAS_STUDIES
const std::vector<std::string> all_commands = {"stress", "bench", "accuracy", "experiment"};
#else
const std::vector<std::string> all_commands = {"stress"};
#endif

}  // namespace

TEST_CASE("graze_studies lists its commands, and says its version") {
  const ProgramResult help = run_studies({"--help"});
  CHECK(help.exit_code == 0);
  CHECK(listed_commands(help.out) == all_commands);
  const ProgramResult version = run_studies({"--version"});
  CHECK(version.exit_code == 0);
  CHECK(version.out == "graze_studies " + std::to_string(GRAZE_VERSION_MAJOR) + "." +
                           std::to_string(GRAZE_VERSION_MINOR) + "." + std::to_string(GRAZE_VERSION_PATCH) +
                           "\n");
}

TEST_CASE("what is wrong with the command line of graze_studies stress is said in a line") {
  const TemporaryFolder folder;
  const std::string threads =
      "expected a whole number from 1 to " + std::to_string(max_threads()) + " (8 for each processor), got ";
  const std::string none = (folder / "none").string();
  check_studies_refuse({
      {{}, "expected a command; the commands are stress"},
      {{"run", "scene.json"}, "there is no command \"run\"; the commands are stress"},
      {{"stres", "--soak"}, "there is no command \"stres\"; did you mean stress? the commands are stress"},
      {{"--versoin"}, "graze_studies has no option --versoin; did you mean --version? graze_studies --help"},
      {{"stress", "--sock"}, "graze_studies stress has no option --sock; did you mean --soak?"},
      {{"stress", "--soak", "now"}, "\"now\" is one argument too many; graze_studies stress --help says"},
      {{"stress", "--budgets", "--threads", "100000"}, "--threads: " + threads + "\"100000\""},
      {{"stress", "--objects", "10,1"}, "--objects: expected a whole number from 2 to 1000000, got \"1\""},
      {{"stress", "--reader", "--seconds", "0"}, "--seconds: expected a number above 0, got \"0\""},
      {{"stress", "--soak", "--minutes", "inf"}, "--minutes: expected a number above 0, got \"inf\""},
      {{"stress", "--soak", "--seed", "x"}, "--seed: expected a whole number of at least 0, got \"x\""},
      {{"stress", "--soak", "--out", none + "/x.json"}, "--out: " + none + "/x.json cannot be written"},
  });
}

#if GRAZE_HAS_STUDIES

TEST_CASE("what is wrong with the command line of graze_studies bench is said in a line") {
  const TemporaryFolder folder;
  const std::string none = (folder / "none").string();
  check_studies_refuse({
      {{"bench", "--frames", "0"}, "--frames: expected a whole number of at least 1, got \"0\""},
      {{"bench", "--threads", "1,100000"}, "--threads: expected a whole number"},
      {{"bench", "--slow", "5000"}, "--slow: expected a whole number from 1 to 4096, got \"5000\""},
      {{"bench", "--task", "A"}, "graze_studies bench has no option --task; did you mean --tasks?"},
      {{"bench", "--scenes", "S1", "--csv", none + "/x.csv"}, "--csv: " + none + "/x.csv cannot be written"},
      {{"bench", "--scenes", "S1", "--json", folder.path().string()},
       "--json: " + folder.path().string() + " cannot be written: it is a folder"},
  });
}

TEST_CASE("graze_studies bench writes over no mesh that it may read") {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("a.obj", "mine").string();
  const std::string other = (folder / "x").string();
  check_studies_refuse({
      {{"bench", "--data", folder.path().string(), "--csv", mesh},
       "--csv: " + mesh + " cannot be written: it is what the run reads"},
      {{"bench", "--csv", other, "--json", other},
       "--json: " + other + " cannot be written: it is the file of --csv too"},
  });
  CHECK(read_file(mesh) == "mine");
}

TEST_CASE("bench compares with its aims only where that is asked for, and says what they are") {
  const std::vector<std::string> short_run = {"bench",    "--scenes", "S1",      "--tasks", "A",
                                              "--frames", "2",        "--peers", "none"};
  const ProgramResult plain = run_studies(short_run);
  CHECK(plain.exit_code == 0);
  CHECK(plain.out.find("aim") == std::string::npos);
  std::vector<std::string> with_aims = short_run;
  with_aims.emplace_back("--aims");
  const ProgramResult asked = run_studies(with_aims);
  CHECK(asked.exit_code == 0);
  CHECK_THAT(asked.out, Contains("Aims: what graze's developers want of it (docs/performance.md).") &&
                            Contains("An aim that is not reached is no error.") &&
                            Contains("| memory, bytes a vertex"));
}

#endif

}  // namespace graze::tests
