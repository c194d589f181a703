// graze export, as a user runs it.

#include <algorithm>
#include <filesystem>
#include <graze/recording.hpp>
#include <string>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Catch::Matchers::Contains;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

/// A recording of 20 frames in which a spike comes down on a sheet, touches it in frame 9, and stays.
struct ExportedRun {
  TemporaryFolder folder;
  std::string file = in("run.graze");

  ExportedRun() {
    folder.write("sheet.obj", obj_text(sheet(4, 0.25, {0, 0, 0})));
    folder.write("spike.ply", ply_text(spike({0, 0, 0}, 0.5)));
    const auto scene = folder.write("scene.json", R"({"graze": 1, "contact_distance": 0.01, "range": 2,
      "frames": 20, "objects": [{"name": "sheet", "mesh": "sheet.obj", "motion": "fixed"},
      {"name": "spike", "mesh": "spike.ply", "poses": [
        {"frame": 0, "translate": [0.4375, 0.5625, 1]}, {"frame": 9, "translate": [0.4375, 0.5625, 0]}]}]})");
    REQUIRE(run_graze({"run", scene.string(), "--record", file}).exit_code == 0);
  }
  [[nodiscard]] std::string in(const std::string& name) const { return (folder.path() / name).string(); }
  [[nodiscard]] ProgramResult run(std::vector<std::string> options) const {
    options.insert(options.begin(), {"export", file});
    return run_graze(options);
  }
  /// The number of contacts of some frames of a replay.
  [[nodiscard]] std::ptrdiff_t contacts(std::size_t first, std::size_t last) const {
    const graze::Recording recording(file);
    graze::Replay replay(recording, {.first_frame = first});
    std::ptrdiff_t count = 0;
    while (replay.step() && replay.frame_index() <= last)
      count += static_cast<std::ptrdiff_t>(replay.report()->contacts().size());
    return count;
  }
};

std::ptrdiff_t lines_of(const std::string& file) {
  return std::ranges::count(read_file(file), '\n');
}

}  // namespace

TEST_CASE("graze export writes all files of the wanted frames") {
  const ExportedRun run;
  const ProgramResult result =
      run.run({"--frames", "11..14", "--csv", run.in("c.csv"), "--distances", run.in("d.csv"), "--paraview",
               run.in("p.pvd"), "--gltf", run.in("f.glb"), "--frame", "12"});
  CHECK(result.err == "");
  REQUIRE(result.exit_code == 0);
  REQUIRE(run.contacts(11, 14) > 0);
  CHECK(lines_of(run.in("c.csv")) == 1 + run.contacts(11, 14));
  CHECK(lines_of(run.in("d.csv")) == 1 + 4);
  const std::string contacts = read_file(run.in("c.csv"));
  CHECK_THAT(contacts, Contains("\n11,12,0,1,sheet,spike,VF,"));
  // The contact began in frame 9, before the wanted ones.
  CHECK_THAT(contacts, Contains(",9,0,0,0,1,false\n14,15,0,1,sheet,spike,"));
  for (const int frame : {11, 12, 13, 14})
    for (const std::string part : {"surfaces", "contacts", "lines"})
      CHECK(std::filesystem::exists(run.in("p/" + part + "_0000" + std::to_string(frame) + ".vtp")));
  CHECK(lines_of(run.in("p.pvd")) == 5 + 4 * 3);
  CHECK(read_file(run.in("f.glb")).starts_with("glTF"));
  CHECK_THAT(result.out,
             Contains("c.csv: " + std::to_string(run.contacts(11, 14)) + " contacts of 4 frames") &&
                 Contains("d.csv: 4 rows of 4 frames") && Contains("f.glb: frame 12"));
  CHECK(run_graze({"inspect", run.in("f.glb")}).exit_code == 0);
}

TEST_CASE("graze export refuses what it cannot write before it reads anything") {
  const ExportedRun run;
  run.folder.write("p", "a file where a folder must be");
  const auto check_refused = [&](const std::vector<std::string>& options, const std::string& message) {
    const ProgramResult result = run.run(options);
    CAPTURE(options);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK_THAT(result.err, Contains(message));
  };
  check_refused({}, "name a file to write");
  check_refused({"--csv", run.in("none/c.csv")}, "--csv: " + run.in("none/c.csv") + " cannot be written");
  check_refused({"--csv", run.file}, "it is what the run reads");
  check_refused({"--csv", run.in("t"), "--distances", run.in("t")}, "it is the file of --csv too");
  check_refused({"--csv", "/dev/full"}, "/dev/full: cannot be written");
  check_refused({"--paraview", run.in("p.pvd")}, "it is a file, and the frames need a folder");
  check_refused({"--paraview", run.in("q.vtp")}, "end it in .pvd");
  check_refused({"--gltf", run.in("f.obj")}, "end it in .gltf or .glb");
  check_refused({"--frame", "3", "--csv", run.in("c.csv")}, "--frame: goes with --gltf only");
  check_refused({"--gltf", run.in("f.glb"), "--frame", "20"},
                "--frame: expected a frame from 0 to 19, got 20");
  check_refused({"--frames", "20..", "--csv", run.in("c.csv")}, "--frames: the recording has 20 frames");
  CHECK(!std::filesystem::exists(run.in("c.csv")));
}
