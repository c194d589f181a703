#include <graze/io/error.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "io/page/page_decoder.hpp"
#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/temporary_folder.hpp"
#include "viewer/viewer_page.hpp"

namespace {

using Catch::Matchers::Contains;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

/// A square of 12 × 12 quads, so that its regions have levels.
std::string plate_text() {
  std::ostringstream text;
  for (int y = 0; y <= 12; ++y)
    for (int x = 0; x <= 12; ++x) text << "v " << x << ' ' << y << " 0\n";
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      const int a = 13 * y + x + 1;
      text << "f " << a << ' ' << a + 1 << ' ' << a + 14 << ' ' << a + 13 << '\n';
    }
  return text.str();
}

/// A square plate that comes down on another one, in 9 frames.
struct PlateScene {
  TemporaryFolder folder;
  std::string scene;

  PlateScene() {
    folder.write("plate.obj", plate_text());
    scene = folder
                .write("plates.json", R"({"graze": 1, "contact_distance": 0.125, "range": 1, "objects": [
      {"name": "still", "mesh": "plate.obj", "motion": "fixed"},
      {"name": "moving", "mesh": "plate.obj", "poses": [{"frame": 0, "translate": [0, 0, 0.5]},
        {"frame": 8, "translate": [0, 0, 0]}]}]})")
                .string();
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (folder / name).string(); }
  [[nodiscard]] ProgramResult run(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"run", scene});
    return run_graze(arguments);
  }
};

/// The rows of each frame of a report, without its statistics.
std::vector<nlohmann::json> rows_of(const std::filesystem::path& report) {
  std::vector<nlohmann::json> rows;
  std::istringstream lines(read_file(report));
  for (std::string line; std::getline(lines, line);) {
    const nlohmann::json frame = nlohmann::json::parse(line);
    if (frame.contains("pairs")) rows.push_back(frame.at("pairs"));
  }
  return rows;
}

}  // namespace

TEST_CASE("run --html: writes a page, or says that this graze was built without the viewer") {
  const PlateScene plates;
  const std::string file = plates.file("view.html");
  const ProgramResult result = plates.run({"--html", file});
  if (!graze::tools::has_viewer()) {
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK_THAT(result.err, Contains("built without the viewer; install nodejs and npm and build again"));
    CHECK(!std::filesystem::exists(file));
    return;
  }
  REQUIRE(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK_THAT(result.out, Contains("page      " + file + ", 9 of 9 frames, "));
  CHECK(DecodedPage(file).head().at("title") == "plates");
  const std::string viewer = graze::tools::viewer_page();
  const std::string page = read_file(file);
  CHECK(page.starts_with(viewer.substr(0, viewer.find("<!-- graze-data -->"))));
  CHECK(page.ends_with(viewer.substr(viewer.find("<!-- graze-data -->") + 19)));
}

TEST_CASE("run --html: a program without the viewer says how to get one") {
  try {
    graze::tools::unpacked_viewer({});
    FAIL("no error");
  } catch (const graze::io::InputError& error) {
    CHECK_THAT(error.what(), Contains("install nodejs and npm and build again"));
    CHECK_THAT(error.what(), Contains(".grazeview"));
  }
}

TEST_CASE("run --html: the data alone, with every frame and the scene's objects") {
  const PlateScene plates;
  const std::string file = plates.file("view.grazeview");
  const ProgramResult result = plates.run({"--html", file});
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.out, Contains("page      " + file + ", 9 of 9 frames, "));
  const DecodedPage page(file);
  CHECK(page.frame_count() == 9);
  CHECK(page.head().at("source") == plates.scene);
  CHECK(page.head().at("objects").at(0).at("name") == "still");
  CHECK(page.head().at("objects").at(1).at("motion") == "rigid");
  for (std::uint64_t frame = 0; frame < 9; ++frame) {
    const auto shape = page.shape(1, frame);
    REQUIRE(shape);
    CHECK(shape->pose[11] == 0.5 - 0.0625 * static_cast<double>(frame));
  }
}

TEST_CASE("run --html, view: the page has rules and ignored pairs, also by way of a recording") {
  TemporaryFolder folder;
  folder.write("plate.obj", plate_text());
  const std::string scene = folder
                                .write("rules.json", R"({"graze": 1, "contact_distance": 0.125, "range": 1,
      "rules": [{"kinds": [2, 1], "contact_distance": 0.5}], "ignore": [["a", "c"], ["b", 1, "c", 2]], "objects": [
      {"name": "a", "mesh": "plate.obj", "motion": "fixed", "kind": 1}, {"name": "b", "mesh": "plate.obj"},
      {"name": "c", "mesh": "plate.obj", "kind": 2}]})")
                                .string();
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const ProgramResult run = run_graze(
      {"run", scene, "--frames", "3", "--html", path("run.grazeview"), "--record", path("run.graze")});
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  REQUIRE(run_graze({"view", path("run.graze"), "-o", path("view.grazeview")}).exit_code == 0);
  for (const char* const name : {"run.grazeview", "view.grazeview"}) {
    const nlohmann::json head = DecodedPage(path(name)).head();
    CHECK(head.at("ignored") == nlohmann::json::array({{0, 2, 0, 2}}));
    CHECK(head.at("ignored_groups") == nlohmann::json::array({{1, 1, 2, 2, 0, 2}}));
    const nlohmann::json rule = head.at("rules").at(0);
    CHECK(rule.at("contact_distance") == 0.5);
    CHECK((rule.at("kinds") == nlohmann::json{1, 2} || rule.at("kinds") == nlohmann::json{2, 1}));
  }
}

TEST_CASE("run --html-every: writes each K-th frame and says so") {
  const PlateScene plates;
  const std::string file = plates.file("view.grazeview");
  const ProgramResult result = plates.run({"--html", file, "--html-every", "3"});
  REQUIRE(result.exit_code == 0);
  CHECK_THAT(result.out, Contains("every 3rd frame, 3 of 9 frames"));
  CHECK(DecodedPage(file).head().at("frame_numbers") == std::vector<int>{0, 3, 6});
}

TEST_CASE("run --region-distances: lists lines for the page and changes no row") {
  const PlateScene plates;
  const std::string file = plates.file("view.grazeview");
  const auto with = plates.folder / "with.jsonl";
  const auto without = plates.folder / "without.jsonl";
  REQUIRE(plates.run({"--region-distances", "100", "--html", file, "--report", with.string()}).exit_code ==
          0);
  REQUIRE(plates.run({"--report", without.string()}).exit_code == 0);
  CHECK(rows_of(with).size() == 9);
  CHECK(rows_of(with) == rows_of(without));
  const DecodedPage page(file);
  CHECK(!page.report(0).first->numbers<std::uint32_t>("region_levels").empty());
}

TEST_CASE("run --no-times: two runs write the same page") {
  const PlateScene plates;
  for (const char* const name : {"a.grazeview", "b.grazeview"})
    REQUIRE(plates.run({"--no-times", "--html", plates.file(name)}).exit_code == 0);
  CHECK(read_file(plates.folder / "a.grazeview") == read_file(plates.folder / "b.grazeview"));
}

TEST_CASE("run --html: mistakes are one line and write nothing") {
  const PlateScene plates;
  const std::vector<std::pair<std::vector<std::string>, std::string>> calls = {
      {{"--html", plates.file("view.txt")}, "end it in .html for a page, or in .grazeview for its data"},
      {{"--html", plates.file("none/view.grazeview")}, "there is no folder"},
      {{"--html-every", "2"}, "--html-every: says which frames --html writes; add --html FILE"},
      {{"--html", plates.file("v.grazeview"), "--html-every", "0"}, "expected a whole number of at least 1"}};
  for (const auto& [arguments, complaint] : calls) {
    const ProgramResult result = plates.run(arguments);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK_THAT(result.err, Contains(complaint));
  }
  CHECK(!std::filesystem::exists(plates.folder / "v.grazeview"));
}
