#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/program_report.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Catch::Matchers::Contains;
using Eigen::Vector3d;
using graze::oracle::Shape;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

/// A sheet, and a spike that comes down on it, rests, and goes: 9 frames by poses, one unit of 1/64 apart.
struct SpikeScene {
  TemporaryFolder folder;
  Shape sheet_shape = sheet(4, 0.25, {0, 0, 0});
  Shape spike_shape = spike({0, 0, 0}, 0.5);
  std::string objects;

  SpikeScene() {
    folder.write("sheet.obj", obj_text(sheet_shape));
    folder.write("spike.ply", ply_text(spike_shape));
    objects = R"("objects": [{"name": "sheet", "mesh": "sheet.obj", "motion": "fixed"},
      {"name": "spike", "mesh": "spike.ply", "poses": [
        {"frame": 0, "translate": [0.4375, 0.5625, 0.0625]}, {"frame": 4, "translate": [0.4375, 0.5625, 0]},
        {"frame": 8, "translate": [0.4375, 0.5625, 0.0625]}]}])";
  }
  static Vector3d tip(int frame) { return {0.4375, 0.5625, std::abs(frame - 4) / 64.0}; }

  [[nodiscard]] std::string write(const std::string& settings) const {
    return folder.write("scene.json", R"({"graze": 1, )" + settings + ", " + objects + "}").string();
  }
  [[nodiscard]] std::vector<ExpectedShapes> frames() const {
    std::vector<ExpectedShapes> frames;
    for (int frame = 0; frame < 9; ++frame) frames.push_back({sheet_shape, moved(spike_shape, tip(frame))});
    return frames;
  }
};

struct BadCall {
  std::vector<std::string> arguments;
  std::string complaint;
};

}  // namespace

TEST_CASE("two OBJ files given directly make a scene of one frame") {
  const TemporaryFolder folder;
  folder.write("sheet.obj", obj_text(sheet(4, 0.25, {0, 0, 0})));
  folder.write("spike.obj", obj_text(spike({0.4375, 0.5625, 0.03125}, 0.5)));
  const auto report = folder / "report.jsonl";
  const auto result = run_graze({"run", (folder / "sheet.obj").string(), (folder / "spike.obj").string(),
                                 "--contact-distance", "0.0625", "--report", report.string()});
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK_THAT(result.out, Contains("1 frame, 2 objects, 1 pair\n"));
  CHECK_THAT(result.out,
             Contains("sheet and spike: first in frame 0 at (0.4375, 0.5625, 0.01562), last in frame 0"));

  const auto frames = read_report(report);
  REQUIRE((frames.size() == 1 && frames[0].pairs.size() == 1 && frames[0].pairs[0].contacts.size() == 1));
  const graze::Contact& contact = frames[0].pairs[0].contacts[0].contact;
  CHECK(contact.kind == graze::ContactKind::VF);
  CHECK((contact.feature_a.kind == graze::FeatureKind::face && contact.feature_a.index == 9));
  CHECK((contact.feature_b.kind == graze::FeatureKind::vertex && contact.feature_b.index == 0));
  CHECK(contact.distance == 0.03125);
  CHECK(contact.point_a == Vector3d(0.4375, 0.5625, 0));
  CHECK(contact.point_b == Vector3d(0.4375, 0.5625, 0.03125));
  CHECK(contact.normal == Vector3d(0, 0, 1));
  CHECK(contact.side_a == graze::Side::front);
}

TEST_CASE("a scene of quads and a posed spike gives what brute force finds, frame by frame") {
  const SpikeScene scene;
  const auto report = scene.folder / "report.jsonl";
  const auto path = scene.write(R"("contact_distance": 0.02, "range": 0.05)");
  const auto result = run_graze({"run", path, "--report", report.string()});
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK_THAT(result.out, Contains("9 frames, 2 objects, 1 pair\n"));
  CHECK_THAT(result.out, Contains("sheet and spike: first in frame 3 at"));
  CHECK_THAT(result.out, Contains("last in frame 5; 3 frames in 1 spell"));
  CHECK(check_exactly(read_report(report), scene.frames(), {0.02, 0.05}) == 3);
}

TEST_CASE("the summary says which solid is inside another, and that they cross") {
  const TemporaryFolder folder;
  folder.write("crate.obj", obj_text(box({-1, -1, -1}, {2, 2, 2})));
  folder.write("pebble.obj", obj_text(box({-0.25, -0.25, -0.25}, {0.5, 0.5, 0.5})));
  const auto scene = folder.write("solids.json", R"({"graze": 1, "contact_distance": 0.125, "objects": [
    {"name": "pebble", "mesh": "pebble.obj", "solid": true, "poses": [{"frame": 0, "translate": [1.5, 0, 0]},
      {"frame": 4, "translate": [0, 0.03125, 0]}]},
    {"name": "crate", "mesh": "crate.obj", "solid": true, "motion": "fixed"},
    {"name": "marble", "mesh": "pebble.obj", "solid": true, "poses": [{"frame": 0, "translate": [0, 0, 4]},
      {"frame": 4, "translate": [0, 0, 0.625]}]}]})");
  const auto result = run_graze({"run", scene.string()});
  CHECK(result.exit_code == 0);
  // The pebble crosses the wall in the frames 1 and 2, at 1.125 and 0.75. The marble is inside in frame 4.
  CHECK_THAT(result.out, Contains("pebble and crate: ") &&
                             Contains("; they cross in 2 frames; pebble is inside crate in 2 frames\n"));
  CHECK_THAT(result.out, Contains("crate and marble: ") && Contains("; marble is inside crate in 1 frame\n"));
}

TEST_CASE("two boxes of quads have the contacts that brute force finds") {
  const TemporaryFolder folder;
  const Shape below = box({0, 0, 0}, {1, 1, 0.5});
  const Shape above = box({0.25, 0.375, 0.5078125}, {1, 0.25, 0.5});
  folder.write("below.obj", obj_text(below));
  folder.write("above.obj", obj_text(above));
  const auto report = folder / "report.jsonl";
  const auto result = run_graze({"run", (folder / "below.obj").string(), (folder / "above.obj").string(),
                                 "--contact-distance", "0.01", "--report", report.string()});
  CHECK(result.exit_code == 0);
  CHECK(check_exactly(read_report(report), {{below, above}}, {0.01, 0}) > 2);
}

TEST_CASE("the command line comes before the scene file") {
  const SpikeScene scene;
  const auto report = scene.folder / "report.jsonl";
  const auto path = scene.write(R"("contact_distance": 0.02, "range": 0.05, "detail": "none", "frames": 2)");
  const auto result =
      run_graze({"run", path, "--report", report.string(), "--frames", "9", "--contact-distance", "0.035",
                 "--range", "0.04", "--detail", "features", "--threads", "2"});
  CHECK(result.exit_code == 0);
  CHECK(check_exactly(read_report(report), scene.frames(), {0.035, 0.04}) == 5);
}

TEST_CASE("runs without times are one file, byte for byte, for any number of threads") {
  const SpikeScene scene;
  const auto path = scene.write(R"("contact_distance": 0.02, "range": 0.05)");
  std::vector<std::string> reports;
  for (const std::string threads : {"1", "1", "2"}) {
    const auto report = scene.folder / ("report-" + std::to_string(reports.size()) + ".jsonl");
    CHECK(
        run_graze({"run", path, "--no-times", "--threads", threads, "--report", report.string()}).exit_code ==
        0);
    reports.push_back(read_file(report));
  }
  CHECK(reports[0].size() > 1000);
  CHECK(reports[0].find("_ms") == std::string::npos);
  CHECK(reports[0] == reports[1]);
  CHECK(reports[0] == reports[2]);
}

TEST_CASE("options make the report smaller: each k-th frame, pairs alone, compressed") {
  const SpikeScene scene;
  const auto path = scene.write(R"("contact_distance": 0.02, "range": 1)");
  const auto write = [&](const std::string& name, std::vector<std::string> options) {
    const auto report = scene.folder / name;
    options.insert(options.begin(), {"run", path, "--no-times", "--report", report.string()});
    const auto result = run_graze(options);
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    return report;
  };
  const auto whole = write("whole.jsonl", {});
  const auto frames = read_report(whole);
  REQUIRE(frames.size() == 9);
  const auto every = read_report(write("every.jsonl", {"--report-every", "4"}));
  REQUIRE(every.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(every[i].frame == 4 * i);
    REQUIRE(every[i].pairs.size() == 1);
    REQUIRE(frames[4 * i].pairs.size() == 1);
    CHECK(every[i].pairs[0].contacts.size() == frames[4 * i].pairs[0].contacts.size());
  }
  const auto pairs = read_report(write("pairs.jsonl.gz", {"--report-pairs"}));
  REQUIRE(pairs.size() == 9);
  CHECK(pairs[4].pairs[0].contacts.empty());
  CHECK(pairs[4].pairs[0].contact_count == frames[4].pairs[0].contacts.size());
  CHECK(pairs[4].pairs[0].contact_count > 0);
  const auto packed = write("whole.jsonl.gz", {});
  CHECK(std::filesystem::file_size(packed) < std::filesystem::file_size(whole) / 2);
  CHECK(read_report(packed).size() == 9);
  for (const std::vector<std::string>& lone :
       {std::vector<std::string>{"--report-pairs"}, {"--report-every", "2"}}) {
    std::vector<std::string> arguments = {"run", path};
    arguments.insert(arguments.end(), lone.begin(), lone.end());
    const auto result = run_graze(arguments);
    CHECK(result.exit_code == 2);
    CHECK_THAT(result.err, Contains("add --report FILE"));
  }
}

TEST_CASE("layers, ignored pairs, margins and rules reach the scene") {
  const SpikeScene scene;
  const auto contacts_with = [&](const std::string& more_settings, const std::string& spike_keys) {
    std::string objects = scene.objects;
    objects.insert(objects.find(R"("mesh": "spike.ply")"), spike_keys);
    const auto path = scene.folder.write(
        "scene.json", R"({"graze": 1, "contact_distance": 0.02, )" + more_settings + objects + "}");
    const auto report = scene.folder / "report.jsonl";
    CHECK(run_graze({"run", path.string(), "--report", report.string()}).exit_code == 0);
    std::size_t frames_in_contact = 0;
    for (const auto& frame : read_report(report))
      frames_in_contact += !frame.pairs.empty() && !frame.pairs[0].contacts.empty() ? 1U : 0U;
    return frames_in_contact;
  };
  CHECK(contacts_with("", "") == 3);
  CHECK(contacts_with("", R"("layer": 2, "collides_with": 1, )") == 3);  // the sheet looks at every layer
  CHECK(contacts_with("", R"("collides_with": 2, )") == 0);
  CHECK(contacts_with(R"("ignore": [["spike", "sheet"]], )", "") == 0);
  CHECK(contacts_with("", R"("margin": 0.02, )") == 5);
  CHECK(contacts_with(R"("rules": [{"kinds": [7, 0], "contact_distance": 0.05}], )", R"("kind": 7, )") == 7);
  CHECK(contacts_with(R"("rules": [{"kinds": [7, 7], "contact_distance": 0.05}], )", R"("kind": 7, )") == 3);
}

TEST_CASE("a picture is drawn of the frame with most contacts, or of the one asked for") {
  const SpikeScene scene;
  const auto path = scene.write(R"("contact_distance": 0.02)");
  const auto picture = (scene.folder / "frame.png").string();
  const auto busiest = run_graze({"run", path, "--picture", picture});
  CHECK(busiest.exit_code == 0);
  CHECK_THAT(busiest.out, Contains("picture   " + picture + ", frame 3\n"));
  const std::string first = read_file(picture);
  CHECK(first.substr(1, 3) == "PNG");
  CHECK_THAT(run_graze({"run", path, "--picture", picture, "--picture-frame", "0"}).out,
             Contains(", frame 0\n"));
  CHECK(read_file(picture) != first);
}

TEST_CASE("help and version go to standard output with exit code 0") {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"--help"}, {"run", "--help"}, {"inspect", "--help"}, {"--version"}}) {
    const auto result = run_graze(arguments);
    CHECK(result.exit_code == 0);
    CHECK(result.err.empty());
    CHECK_FALSE(result.out.empty());
  }
  CHECK_THAT(run_graze({"run", "--help"}).out, Contains("--picture-frame") && Contains("--no-times"));
}

TEST_CASE("bad input ends with exit code 2 and one line that says what and where") {
  const SpikeScene scene;
  const auto good = scene.write(R"("contact_distance": 0.02)");
  const auto bad =
      scene.folder.write("bad.json", R"({"graze": 1, "objects": [{"mesh": "sheet.obj", "margin": "x"}]})");
  const auto paper = scene.folder.write(
      "paper.json", R"({"graze": 1, "accuracy": {"paper": []}, "objects": [{"mesh": "sheet.obj"}]})");
  const auto sheet_file = (scene.folder / "sheet.obj").string();
  const std::vector<BadCall> calls = {
      {{}, "graze: "},
      {{"run"}, "files"},
      {{"run", good, "--detail", "all"}, "--detail: expected none, closest"},
      {{"run", good, "--accuracy", "within"}, "--accuracy: expected exact, within:T"},
      {{"run", good, "--accuracy", "paper:1,x"}, "--accuracy: expected exact, within:T"},
      {{"run", good, "--accuracy", "exact:1"}, "--accuracy: expected exact, within:T"},
      {{"run", good, "--picture-frame", "1"}, "--picture-frame: "},
      {{"run", good, "--picture", (scene.folder / "p.png").string(), "--picture-frame", "9"},
       "frames are 0 to 8"},
      {{"run", good, sheet_file}, "sheet.obj: stands beside a scene file"},
      {{"run", "none.json"}, "none.json: cannot be opened"},
      {{"run", "none.obj"}, "none.obj"},
      {{"run", bad.string()},
       "bad.json: objects[0].margin: expected a number that is not negative, got \"x\"; "},
      {{"run", paper.string()}, "paper.json: "},
      {{"inspect"}, "files"},
      {{"inspect", "none.obj"}, "none.obj"},
  };
  for (const BadCall& call : calls) {
    const auto result = run_graze(call.arguments);
    INFO("wanted: " << call.complaint << "\ngot: " << result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Contains(call.complaint));
  }
}
