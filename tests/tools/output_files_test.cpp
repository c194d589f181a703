// No command writes over a file that it reads, or two outputs into one file. It says so before it writes
// anything.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/gltf_file.hpp"
#include "tools/program.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests
using Words = std::vector<std::string>;

/// The bytes of all files of a folder and of those below, by name.
std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[entry.path().string()] = read_file(entry.path());
  return files;
}

/// A folder of which no file may change, and none be added, while commands are refused.
class GuardedFolder {
 public:
  void check_refused(const Words& arguments, const std::string& complaint) const {
    const auto before = files_in(folder_.path());
    const ProgramResult result = run_graze(arguments);
    INFO("wanted: " << complaint << "\ngot: " << result.err << result.out);
    CHECK(result.exit_code == 2);
    CHECK(is_one_line(result.err));
    CHECK(result.out.empty());
    CHECK_THAT(result.err, Contains("graze: " + complaint));
    CHECK(files_in(folder_.path()) == before);
  }
  [[nodiscard]] std::string in(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
};

/// A scene that reads files of each sort.
struct ReadingScene : GuardedFolder {
  std::string scene;

  ReadingScene() {
    const auto shape = spike({0, 0, 0}, 0.5);
    folder().write("a.obj", obj_text(shape));
    folder().write("cache.pc2", pc2_bytes({shape.positions, shape.positions}));
    for (const std::string frame : {"1", "2", "3"}) folder().write("seq_" + frame + ".ply", ply_text(shape));
    GltfFile file;
    file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3");
    file.write(
        folder().path().string(), "mesh",
        R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])");
    scene = folder()
                .write("scene.json", R"({"graze": 1, "objects": [{"mesh": "a.obj"}, {"mesh": "mesh.gltf"},
      {"mesh": "a.obj", "positions": "cache.pc2"}, {"mesh": "a.obj", "positions": "seq_#.ply"}]})")
                .string();
  }
};

/// A recording of two frames.
struct RecordedFile : GuardedFolder {
  std::string file = in("run.graze");

  RecordedFile() {
    folder().write("a.obj", obj_text(spike({0, 0, 0}, 0.5)));
    REQUIRE(run_graze({"run", in("a.obj"), in("a.obj"), "--frames", "2", "--record", file}).exit_code == 0);
  }
};

const std::string is_read = " cannot be written: it is what the run reads; name another file";

}  // namespace

TEST_CASE("graze run writes over none of the files that its scene reads") {
  const ReadingScene files;
  for (const std::string option : {"--report", "--record"})
    for (const std::string name :
         {"scene.json", "a.obj", "mesh.gltf", "mesh.bin", "cache.pc2", "seq_1.ply", "seq_3.ply"})
      files.check_refused({"run", files.scene, option, files.in(name)},
                          option + ": " + files.in(name) + is_read);
  files.check_refused({"run", files.in("mesh.gltf"), "--report", files.in("mesh.bin")}, "--report: ");
  files.check_refused({"run", files.in("a.obj"), "--record", files.in("a.obj")}, "--record: ");
}

TEST_CASE("a file that is read is known by every name that it has") {
  const ReadingScene files;
  fs::create_symlink("mesh.bin", files.in("link.bin"));
  fs::create_hard_link(files.in("a.obj"), files.in("hard.obj"));
  fs::create_symlink(".", files.in("here"));
  fs::create_symlink("a.obj", files.in("picture.png"));
  fs::create_symlink("seq_2.ply", files.in("page.grazeview"));
  for (const std::string name : {"link.bin", "hard.obj", "here/a.obj", "./here/./mesh.bin"})
    files.check_refused({"run", files.scene, "--report", files.in(name)},
                        "--report: " + files.in(name) + is_read);
  files.check_refused({"run", files.scene, "--picture", files.in("picture.png")}, "--picture: ");
  files.check_refused({"run", files.scene, "--html", files.in("page.grazeview")}, "--html: ");
}

TEST_CASE("a page's file until it is whole is none that is read") {
  const ReadingScene files;
  fs::copy(files.in("a.obj"), files.in("view.grazeview.part"));
  fs::create_hard_link(files.in("view.grazeview.part"), files.in("b.obj"));
  files.check_refused({"run", files.in("b.obj"), "--html", files.in("view.grazeview")},
                      "--html: " + files.in("view.grazeview.part") + is_read);
}

TEST_CASE("another letter case is another file, and a file of another scene is written over") {
  const ReadingScene files;
  files.folder().write("other.obj", obj_text(spike({0, 0, 0}, 0.5)));
  for (const std::string name : {"A.obj", "other.obj"})
    CHECK(run_graze({"run", files.scene, "--report", files.in(name)}).exit_code == 0);
  CHECK(read_file(files.in("other.obj")).starts_with("{\"graze\":1"));
}

TEST_CASE("two outputs are never one file, there or not") {
  const ReadingScene files;
  const auto run = [&](const std::string& first, const std::string& second) {
    files.check_refused(
        {"run", files.scene, "--report", files.in(first), "--record", files.in(second)},
        "--record: " + files.in(second) + " cannot be written: it is the file of --report too");
  };
  run("x", "x");
  run("x", "./x");
  fs::create_symlink(".", files.in("here"));
  run("x", "here/x");
  files.folder().write("old", "old");
  fs::create_hard_link(files.in("old"), files.in("hard"));
  run("old", "hard");
  files.check_refused(
      {"run", files.scene, "--report", files.in("v.grazeview.part"), "--html", files.in("v.grazeview")},
      "--html: " + files.in("v.grazeview.part") + " cannot be written: it is the file of --report too");
  CHECK(run_graze({"run", files.scene, "--report", "/dev/null", "--record", "/dev/null"}).exit_code == 0);
}

TEST_CASE("an output is not the file of standard output") {
  const ReadingScene files;
  const ProgramResult result =
      run_graze_redirected({"run", files.scene, "--report", files.in("out")}, "> '" + files.in("out") + "'");
  CHECK(result.exit_code == 2);
  CHECK_THAT(result.err,
             Contains("--report: " + files.in("out") + " cannot be written: standard output goes into it"));
}

TEST_CASE("commands about recordings write over no recording") {
  const RecordedFile files;
  fs::create_hard_link(files.file, files.in("hard.graze"));
  for (const std::string ending : {".png", ".grazeview", ".csv", ".pvd", ".glb"})
    fs::create_symlink("run.graze", files.in("link" + ending));
  files.check_refused({"cut", files.file, "-o", files.file}, "-o: " + files.file + is_read);
  files.check_refused({"cut", files.file, "-o", files.in("hard.graze")}, "-o: ");
  files.check_refused({"view", files.file, "-o", files.in("link.grazeview")}, "-o: ");
  files.check_refused({"picture", files.file, "-o", files.in("link.png")},
                      "-o: " + files.in("link.png") + is_read);
  files.check_refused({"export", files.file, "--csv", files.in("link.csv")}, "--csv: ");
  files.check_refused({"export", files.file, "--distances", files.in("hard.graze")}, "--distances: ");
  files.check_refused({"export", files.file, "--paraview", files.in("link.pvd")}, "--paraview: ");
  files.check_refused({"export", files.file, "--gltf", files.in("link.glb")}, "--gltf: ");
}

TEST_CASE("a time series writes over no recording and no other output in its folder") {
  const RecordedFile files;
  files.check_refused({"export", files.file, "--csv", files.in("p"), "--paraview", files.in("p.pvd")},
                      "--paraview: " + files.in("p") + " cannot be written: it is the file of --csv too");
  fs::create_directory(files.in("p"));
  fs::create_hard_link(files.file, files.in("p/lines_000001.vtp"));
  files.check_refused({"export", files.file, "--paraview", files.in("p.pvd")},
                      "--paraview: " + files.in("p") + is_read);
  fs::remove(files.in("p/lines_000001.vtp"));
  files.check_refused(
      {"export", files.file, "--csv", files.in("p/lines_000000.vtp"), "--paraview", files.in("p.pvd")},
      "--paraview: " + files.in("p") + " cannot be written: it is the file of --csv too");
  CHECK(run_graze({"export", files.file, "--csv", files.in("p/c.csv"), "--paraview", files.in("p.pvd")})
            .exit_code == 0);
}
