// graze run --record and the commands about recordings, as a user runs them.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <graze/recorder.hpp>
#include <graze/recording.hpp>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/shapes.hpp"
#include "tools/slow_pipe.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Catch::Matchers::Contains;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

/// A sheet under a spike that comes down, and a third object far away: 40 frames, in a recording.
struct Recorded {
  TemporaryFolder folder;
  std::string file = (folder.path() / "run.graze").string();
  std::string out;

  Recorded() {
    folder.write("sheet.obj", obj_text(sheet(4, 0.25, {0, 0, 0})));
    folder.write("spike.ply", ply_text(spike({0, 0, 0}, 0.5)));
    const std::string scene = folder
                                  .write("scene.json", R"({"graze": 1, "contact_distance": 0.01, "range": 2,
      "frames": 40, "objects": [{"name": "sheet", "mesh": "sheet.obj", "motion": "fixed"},
      {"name": "spike", "mesh": "spike.ply", "poses": [
        {"frame": 0, "translate": [0.4375, 0.5625, 1]}, {"frame": 20, "translate": [0.4375, 0.5625, 0]},
        {"frame": 39, "translate": [0.4375, 0.5625, 0.0625]}]},
      {"name": "far", "mesh": "sheet.obj", "transform": {"translate": [0, 0, 1.5]}}]})")
                                  .string();
    const ProgramResult result = run_graze({"run", scene, "--record", file});
    REQUIRE(result.exit_code == 0);
    out = result.out;
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (folder.path() / name).string(); }
};

}  // namespace

TEST_CASE("recording: a run is recorded, replayed and described") {
  const Recorded recorded;
  CHECK_THAT(recorded.out, Contains("recording " + recorded.file + ", 40 frames, "));
  for (const std::string threads : {"1", "2", "8"}) {
    const ProgramResult again = run_graze({"replay", recorded.file, "--threads", threads});
    CHECK(again.exit_code == 0);
    CHECK_THAT(again.out, Contains("40 frames answered again, all the same"));
  }
  CHECK(run_graze({"replay", recorded.file, "--instruction-set", "scalar", "--from", "13"}).exit_code == 0);
  const ProgramResult info = run_graze({"info", recorded.file});
  CHECK(info.exit_code == 0);
  CHECK_THAT(info.out,
             Contains("40 frames") &&
                 Contains("frames     0 to 39, steps 1 to 40 of the scene, 1 keyframes, 0 dropped"));
  CHECK_THAT(info.out, Contains("1 \"spike\", ") && Contains("objects    3 in the last frame"));
}

TEST_CASE("recording: a run waits for a disk that is slow, and loses no frame") {
  const TemporaryFolder folder;
  folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::filesystem::path scene = folder.write("scene.json", R"({"graze": 1, "contact_distance": 0.05,
      "range": 1, "frames": 1000, "objects": [{"mesh": "t.obj", "name": "a", "motion": "fixed"}, {"mesh": "t.obj",
      "name": "b", "poses": [{"frame": 0, "translate": [0, 0, 1]}, {"frame": 999, "translate": [0, 0, 0.01]}]}]})");
  SlowPipe pipe(folder / "pipe");
  const ProgramResult run = run_graze({"run", scene.string(), "--record", (folder / "pipe").string()});
  CHECK(run.exit_code == 0);
  CHECK(run.err == "");
  CHECK_THAT(run.out, Contains("pipe, 1000 frames, ") && !Contains("dropped"));
  const std::string file = folder.write("run.graze", pipe.bytes()).string();
  CHECK_THAT(run_graze({"info", file}).out, Contains("frames     0 to 999, ") && Contains(", 0 dropped"));
}

TEST_CASE("recording: info says which frames are missing, and a page of them is written") {
  const TemporaryFolder folder;
  SlowPipe pipe(folder / "pipe");
  graze::Scene scene;
  graze::Recorder recorder(scene, folder / "pipe", {.waiting_frames = 1});
  for (int frame = 0; frame < 400; ++frame) (void)scene.step();
  recorder.close();
  const graze::RecorderStatistics counted = recorder.statistics();
  REQUIRE(counted.dropped > 0);
  const std::filesystem::path file = folder.write("run.graze", pipe.bytes());
  std::string first_gap = "after the last";
  const graze::Recording recording(file);
  std::uint64_t missing = recording.dropped_at_end();
  for (std::size_t index = recording.frame_count(); index-- > 0;) {
    if (recording.frame(index).dropped_before == 0) continue;
    missing = recording.frame(index).dropped_before;
    first_gap = "before frame " + std::to_string(index);
  }
  const ProgramResult info = run_graze({"info", file.string()});
  CHECK_THAT(info.out, Contains(", " + std::to_string(counted.dropped) + " dropped\n") &&
                           Contains("  dropped    " + std::to_string(missing) + " " + first_gap));
  CHECK(run_graze({"view", file.string(), "-o", (folder / "page.grazeview").string()}).exit_code == 0);
}

TEST_CASE("recording: worst names the deepest contact, the largest jump and the longest steps") {
  const TemporaryFolder folder;
  // A tetrahedron with its tip down, and one below with its tip up: solid, so that depths have a sign.
  folder.write("down.obj", "v 0 0 0\nv 1 0 1\nv -1 1 1\nv -1 -1 1\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n");
  folder.write("up.obj", "v 0 0 0\nv 3 0 -1\nv -2 3 -1\nv -2 -3 -1\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
  const std::string scene = folder
                                .write("scene.json", R"({"graze": 1, "contact_distance": 0.05, "range": 10,
      "detail": "nearest", "frames": 30, "objects": [
      {"name": "below\u001b", "mesh": "up.obj", "motion": "fixed", "solid": true},
      {"name": "above", "mesh": "down.obj", "solid": true, "poses": [{"frame": 0, "translate": [0.1, 0, 1]},
       {"frame": 10, "translate": [0.1, 0, 0.02]}, {"frame": 11, "translate": [0.1, 0, -0.3]},
       {"frame": 29, "translate": [0.1, 0, 1]}]}]})")
                                .string();
  const std::string file = (folder / "run.graze").string();
  const ProgramResult run = run_graze({"run", scene, "--record", file});
  REQUIRE(run.exit_code == 0);

  std::vector<double> separations;
  std::vector<bool> touches;
  const graze::Recording recording(file);
  for (graze::Replay replay(recording); replay.step();) {
    const graze::PairReport& row = replay.report()->pairs()[0];
    double smallest = row.contact_count == 0 ? row.distance.upper : 1e300;
    for (const graze::Contact& contact : replay.report()->contacts())
      smallest = std::min(smallest, contact.separation());
    separations.push_back(smallest);
    touches.push_back(row.contact_count > 0);
  }
  REQUIRE(separations.size() == 30);
  std::size_t deepest = 0;
  std::size_t jump = 0;
  double largest = 0;
  for (std::size_t i = 1; i < separations.size(); ++i) {
    if (touches[i] && (!touches[deepest] || separations[i] < separations[deepest])) deepest = i;
    const double change = std::abs(separations[i] - separations[i - 1]);
    if ((touches[i] || touches[i - 1]) && change > largest) {
      largest = change;
      jump = i;
    }
  }
  REQUIRE(separations[deepest] < -0.1);
  REQUIRE(jump == 11);

  const ProgramResult worst = run_graze({"worst", file});
  CHECK(worst.exit_code == 0);
  CHECK(worst.err == "");
  char line[200];
  (void)std::snprintf(line, sizeof(line), "  %-14.6g frame %zu, \"below\\x1b\" and \"above\" at (",
                      separations[deepest], deepest);
  CHECK_THAT(worst.out, Contains(line));
  (void)std::snprintf(line, sizeof(line),
                      "  %-14.6g frame 11, \"below\\x1b\" and \"above\": from %.6g to %.6g\n",
                      separations[11] - separations[10], separations[10], separations[11]);
  CHECK_THAT(worst.out, Contains(line));
  CHECK_THAT(worst.out, Contains("longest steps, as they were recorded\n"));
  std::size_t steps = 0;
  for (std::size_t at = 0; (at = worst.out.find(" ms", at)) != std::string::npos; ++at) ++steps;
  CHECK(steps == 5);
  CHECK_THAT(run.out,
             Contains("; deepest separation -0.") && Contains(" in frame " + std::to_string(deepest)));

  const ProgramResult before = run_graze({"worst", file, "--frames", "..3", "--count", "2"});
  CHECK_THAT(before.out, Contains("frames 0 to 3\n") && Contains("by separation: none\n") &&
                             Contains("to the next: none\n"));
}

TEST_CASE("recording: a part is cut out, and answers as the whole does") {
  const Recorded recorded;
  const std::string part = recorded.path("part.graze");
  const ProgramResult cut =
      run_graze({"cut", recorded.file, "--frames", "19..21", "--pair", "sheet,spike", "-o", part});
  CHECK(cut.exit_code == 0);
  CHECK_THAT(cut.out, Contains("3 of 40 frames") && Contains("a replay answers as it was recorded"));
  CHECK(std::filesystem::file_size(part) < std::filesystem::file_size(recorded.file));
  const ProgramResult info = run_graze({"info", part});
  CHECK_THAT(info.out, Contains("begins amid a run") && Contains("objects    2 in the last frame"));
  CHECK(run_graze({"replay", part}).exit_code == 0);
}

TEST_CASE("recording: a frame is drawn") {
  const Recorded recorded;
  const std::string picture = recorded.path("frame.png");
  const ProgramResult drawn = run_graze({"picture", recorded.file, "--frame", "20", "-o", picture});
  CHECK(drawn.exit_code == 0);
  CHECK_THAT(drawn.out, Contains("frame 20, 1 contacts"));
  CHECK(std::filesystem::file_size(picture) > 10'000);
  CHECK(run_graze({"picture", recorded.file, "--select", "spike", "-o", picture}).exit_code == 0);
}

TEST_CASE("recording: one that was cut off is read up to its last whole frame, and said to be not finished") {
  const Recorded recorded;
  const std::string bytes = read_file(recorded.file);
  const std::string file = recorded.folder.write("off.graze", bytes.substr(0, bytes.size() * 3 / 4)).string();
  const ProgramResult replayed = run_graze({"replay", file});
  CHECK(replayed.exit_code == 0);
  CHECK_THAT(replayed.out, Contains(", not finished\n") && Contains("all the same"));
  CHECK_THAT(run_graze({"info", file}).out, Contains(", not finished"));
  const std::string page = recorded.path("page.grazeview");
  const std::string table = recorded.path("table.csv");
  const std::string part = recorded.path("part.graze");
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"export", file, "--csv", table},
                                                    {"view", file, "-o", page},
                                                    {"cut", file, "--frames", "3..5", "-o", part}}) {
    const ProgramResult result = run_graze(arguments);
    CHECK(result.exit_code == 0);
    CHECK_THAT(result.err, Contains("off.graze is not finished: the program that recorded it ended before"));
  }
  CHECK_THAT(run_graze({"replay", part}).out, !Contains("not finished"));
}

TEST_CASE("recording: what a replay of a part cannot compare is said") {
  const Recorded recorded;
  const ProgramResult whole = run_graze({"replay", recorded.file});
  CHECK_THAT(whole.out, Contains("40 frames answered again, all the same\n"));
  // The pair ends its contact in the part, which a replay cannot know of a part.
  const std::string part = recorded.path("part.graze");
  const ProgramResult cut = run_graze({"cut", recorded.file, "--frames", "13..30", "-o", part});
  const ProgramResult replayed = run_graze({"replay", part});
  CHECK(replayed.exit_code == 0);
  for (const std::string& out : {cut.out, replayed.out}) {
    CHECK_THAT(
        out, Contains("not compared: 1 rows that depend on earlier frames, on other pairs or on the clock"));
    CHECK_THAT(out, Contains(" as far as they can be compared\n"));
  }
}

TEST_CASE("recording: what is wrong is said in a line") {
  const Recorded recorded;
  std::string bytes;
  {
    std::ifstream in(recorded.file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 4);
  const std::string damaged = recorded.folder.write("damaged.graze", bytes).string();
  const std::string part = recorded.path("part.graze");
  const struct {
    std::vector<std::string> arguments;
    std::string complaint;
  } bad_calls[] = {
      {{"replay", damaged}, "damaged.graze: byte "},
      {{"info", damaged}, "damaged.graze: byte "},
      {{"info", recorded.path("scene.json")}, "this is no recording of graze"},
      {{"replay", recorded.file, "--from", "40"}, "the recording has 40 frames"},
      {{"replay", recorded.file, "--instruction-set", "mmx"}, "--instruction-set: this processor has scalar"},
      {{"cut", recorded.file, "--frames", "9..3", "-o", part}, "--frames: expected frames as 10..20"},
      {{"cut", recorded.file, "--frames", "40..", "-o", part}, "--frames: the recording has 40 frames"},
      {{"cut", recorded.file, "--pair", "sheet,nobody", "-o", part}, "--pair: no object of the first frame"},
      {{"cut", recorded.file, "-o", recorded.file}, "-o"},
      {{"picture", recorded.file, "--lines", "-o", recorded.path("a.png")},
       "--lines: the recorded scene has no"},
      {{"picture", recorded.file, "--select", "nobody", "-o", recorded.path("a.png")}, "--select: no object"},
  };
  for (const auto& [arguments, complaint] : bad_calls) {
    const ProgramResult result = run_graze(arguments);
    INFO(result.err);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK_THAT(result.err, Contains(complaint));
  }
}
