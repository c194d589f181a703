// What a stranger's file may do to whoever reads what graze prints: escape sequences of terminals, formulas
// of spreadsheets. And what graze does where standard output takes no more.

#include <algorithm>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Catch::Matchers::Contains;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

/// A scene of two objects that touch. Their names clear the screen, begin a line, and are a formula.
struct HostileScene {
  TemporaryFolder folder;
  std::string recording = in("run.graze");

  HostileScene() {
    folder.write("sheet.obj", obj_text(sheet(4, 0.25, {0, 0, 0})));
    folder.write("spike.ply", ply_text(spike({0, 0, 0}, 0.5)));
    folder.write("scene.json", R"({"graze": 1, "contact_distance": 0.01, "range": 2, "frames": 3, "objects": [
      {"name": "=cmd|' /C calc'!A0", "mesh": "sheet.obj", "motion": "fixed"
  },
      {"name": "\u001b[2J\u009b1m\nforged", "mesh": "spike.ply", "transform": {"translate": [0.4375, 0.5625, 0]}}]})");
    folder.write("named.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 1 0\nv -1 0 0\ng \x1b]0;owned\x07\nf 1 2 3 4 5\n");
    REQUIRE(run_graze({"run", in("scene.json"), "--record", recording}).exit_code == 0);
  }
  [[nodiscard]] std::string in(const std::string& name) const { return (folder.path() / name).string(); }

  /// Commands that name the objects, or print at least.
  [[nodiscard]] std::vector<std::vector<std::string>> commands() const {
    return {{"run", in("scene.json")},
            {"run", in("named.obj"), in("named.obj")},
            {"inspect", in("scene.json")},
            {"inspect", in("named.obj")},
            {"info", recording},
            {"worst", recording},
            {"replay", recording},
            {"cut", recording, "-o", in("part.graze")},
            {"view", recording, "-o", in("view.grazeview")},
            {"picture", recording, "-o", in("frame.png")},
            {"export", recording, "--csv", in("c.csv"), "--distances", in("d.csv"), "--gltf", in("f.gltf")}};
  }
};

bool is_harmless(const std::string& text) {
  return std::ranges::none_of(text,
                              [](char letter) {
                                const auto byte = static_cast<unsigned char>(letter);
                                return (byte < 0x20 && letter != '\n') || byte == 0x7F;
                              }) &&
         text.find("\xC2\x9B") == std::string::npos && text.find("\nforged") == std::string::npos;
}

}  // namespace

TEST_CASE("names of a stranger's file reach the terminal without escape sequences or lines of their own") {
  const HostileScene scene;
  std::string all;
  for (const auto& command : scene.commands()) {
    const ProgramResult result = run_graze(command);
    INFO(command[0] << ": " << result.out << result.err);
    CHECK(result.exit_code == 0);
    CHECK(is_harmless(result.out));
    CHECK(is_harmless(result.err));
    all += result.out + result.err;
  }
  CHECK_THAT(all, Contains("\\x1b[2J\\x9b1m forged"));
  const ProgramResult refused = run_graze({"run", "\x1b[2Jnone.obj", "--report", "\x1b[2J\nx"});
  CHECK(refused.exit_code == 2);
  CHECK(is_harmless(refused.err));
  CHECK(is_one_line(refused.err));
}

TEST_CASE("tables keep spreadsheets from taking a name for a formula") {
  const HostileScene scene;
  REQUIRE(run_graze({"export", scene.recording, "--csv", scene.in("c.csv")}).exit_code == 0);
  CHECK_THAT(read_file(scene.in("c.csv")), Contains(",'=cmd|' /C calc'!A0,"));
}

TEST_CASE("every command says that standard output took no more, with exit code 2") {
  const HostileScene scene;
  auto commands = scene.commands();
  for (const std::string option : {"--help", "--version"}) commands.push_back({option});
  commands.push_back({"run", "--help"});
  for (const auto& command : commands)
    for (const std::string redirection : {">/dev/full", ">&-"}) {
      const ProgramResult result = run_graze_redirected(command, redirection);
      INFO(command[0] << " " << redirection);
      CHECK(result.exit_code == 2);
      CHECK_THAT(result.err,
                 Contains("graze: standard output: not all of it could be written; free some space"));
    }
}

TEST_CASE("where standard streams are closed, nothing that is printed goes into a file that is written") {
  const HostileScene scene;
  const auto record = [&](const std::string& name, const std::string& redirection) {
    return run_graze_redirected({"run", scene.in("scene.json"), "--no-times", "--report", scene.in(name)},
                                redirection);
  };
  REQUIRE(record("whole", ">/dev/null").exit_code == 0);
  CHECK(record("closed", "<&- >&-").exit_code == 2);
  CHECK(read_file(scene.in("closed")) == read_file(scene.in("whole")));
}
