#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/program_report.hpp"
#include "tools/temporary_folder.hpp"

using namespace graze::tests;  // NOLINT: the vocabulary of these tests

TEST_CASE("the demonstration plays: seven objects, contacts that begin and end, one answer for any threads") {
  if (!std::filesystem::exists(std::filesystem::path(GRAZE_ASSIMP_MODELS) / "X" / "Testwuson.X")) {
    WARN("skipped: the animated character of assimp-testmodels is not here");
    return;
  }
  const TemporaryFolder folder;
  const std::string command = std::string("'") + GRAZE_DEMO_SCENE + "' '" + folder.path().string() + "' >'" +
                              (folder / "out").string() + "'";
  REQUIRE(std::system(command.c_str()) == 0);
  const auto scene = (folder / "scene.json").string();
  CHECK(read_file(folder / "out") == scene + "\n");
  const auto first = folder / "first.jsonl";
  const auto second = folder / "second.jsonl";
  CHECK(run_graze({"run", scene, "--no-times", "--threads", "1", "--report", first.string()}).exit_code == 0);
  CHECK(run_graze({"run", scene, "--no-times", "--threads", "2", "--report", second.string()}).exit_code ==
        0);
  CHECK(read_file(first) == read_file(second));

  graze::io::ReportReader header(first);
  std::map<std::uint32_t, std::string> names;
  for (const auto& object : header.objects()) names[object.id] = object.name;
  CHECK(names.size() == 7);
  std::set<std::string> began, ended;
  for (const auto& frame : read_report(first)) {
    CHECK(frame.diagnostics.empty());
    for (const auto& pair : frame.pairs) {
      const std::string name = names[pair.a] + "-" + names[pair.b];
      if (pair.phase == graze::PairPhase::began) began.insert(name);
      if (pair.phase == graze::PairPhase::ended) ended.insert(name);
    }
  }
  for (const std::string name :
       {"bull-ring", "bull-jelly", "bull-pawn", "bull-cylinder", "bull-human", "bull-ground"}) {
    INFO(name);
    CHECK(began.contains(name));
    CHECK(ended.contains(name));
  }
}
