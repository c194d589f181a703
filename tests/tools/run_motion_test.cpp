#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/gltf_file.hpp"
#include "tools/program.hpp"
#include "tools/program_report.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Eigen::Vector3d;
using graze::oracle::Shape;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

/// A sheet that dips by steps of 1/256, so that every coordinate is exact in text and in float.
Shape dipping_sheet(int frame) {
  Shape shape = sheet(4, 0.25, {0, 0, 0});
  for (std::size_t v = 0; v < shape.positions.size(); ++v)
    shape.positions[v].z() =
        -static_cast<double>((static_cast<int>(v % 5) * frame + static_cast<int>(v / 5)) % 7) / 256;
  return shape;
}

constexpr int dip_frames = 6;
constexpr Thresholds dip_thresholds{0.035, 0.05};

Shape below_sheet() {
  return spike({0.4375, 0.5625, 0.015625}, 0.5);
}

/// Runs a scene of the moving sheet, from `positions`, and the spike. Returns how many contacts were right.
std::size_t check_dipping_sheet(const TemporaryFolder& folder, const std::string& positions) {
  folder.write("spike.obj", obj_text(below_sheet()));
  const auto scene =
      folder.write("scene.json", R"({"graze": 1, "contact_distance": 0.035, "range": 0.05, "objects": [
      {"name": "sheet", "mesh": "sheet.obj", "positions": ")" +
                                     positions + R"("}, {"mesh": "spike.obj"}]})");
  const auto report = folder / "report.jsonl";
  const auto result = run_graze({"run", scene.string(), "--report", report.string()});
  INFO(result.err);
  CHECK(result.exit_code == 0);
  std::vector<ExpectedShapes> frames;
  for (int frame = 0; frame < dip_frames; ++frame) frames.push_back({dipping_sheet(frame), below_sheet()});
  return check_exactly(read_report(report), frames, dip_thresholds);
}

/// A flat strip along y in the plane z = 0, of triangles, two vertices a row.
struct Strip {
  static constexpr int rows = 9;
  std::vector<Vector3d> positions;
  std::vector<std::uint16_t> corners;

  Strip() {
    for (int row = 0; row < rows; ++row)
      for (const double x : {0.0, 0.25}) positions.emplace_back(x, 0.25 * row, 0);
    for (int row = 0; row + 1 < rows; ++row) {
      const auto first = static_cast<std::uint16_t>(2 * row);
      for (const int corner : {0, 1, 2, 1, 3, 2})
        corners.push_back(static_cast<std::uint16_t>(first + corner));
    }
  }
  /// How much the upper joint, at y = 1, has of a row: none below 0.75, all above 1.25.
  static double upper_part(int row) { return row <= 3 ? 0 : row >= 5 ? 1 : 0.5; }

  [[nodiscard]] std::vector<float> floats() const {
    std::vector<float> numbers;
    for (const Vector3d& point : positions)
      for (int axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<float>(point[axis]));
    return numbers;
  }
  [[nodiscard]] Shape shape(const std::function<Vector3d(std::size_t)>& position) const {
    Shape shape;
    for (std::size_t v = 0; v < positions.size(); ++v) shape.positions.push_back(position(v));
    for (std::size_t i = 0; i < corners.size(); i += 3)
      shape.faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return shape;
  }
};

/// The strip on two joints. The upper one turns about z by 90 degrees in one second.
void write_skinned_strip(const TemporaryFolder& folder) {
  const Strip strip;
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (int v = 0; v < 2 * Strip::rows; ++v) {
    joints.insert(joints.end(), {0, 1, 0, 0});
    const auto upper = static_cast<float>(Strip::upper_part(v / 2));
    weights.insert(weights.end(), {1 - upper, upper, 0, 0});
  }
  const std::vector<float> inverse_binds = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                                            1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
  const auto half = static_cast<float>(std::sqrt(0.5));
  GltfFile file;
  file.add(strip.floats(), 5126, "VEC3", R"(,"min":[0,0,0],"max":[0.25,2,0])");
  file.add(strip.corners, 5123, "SCALAR");
  file.add(joints, 5121, "VEC4");
  file.add(weights, 5126, "VEC4");
  file.add(inverse_binds, 5126, "MAT4");
  file.add(std::vector<float>{0, 1}, 5126, "SCALAR", R"(,"min":[0],"max":[1])");
  file.add(std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, 5126, "VEC4");
  file.write(folder.path().string(), "strip", R"("scene":0,"scenes":[{"nodes":[0,1]}],
    "nodes":[{"name":"strip","mesh":0,"skin":0},{"name":"lower","children":[2]},
             {"name":"upper","translation":[0,1,0]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}],
    "skins":[{"joints":[1,2],"inverseBindMatrices":4}],
    "animations":[{"name":"bend","samplers":[{"input":5,"output":6,"interpolation":"LINEAR"}],
                   "channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}}]}])");
}

/// The strip bent by hand: each vertex a mix of where it was and where it turns to about (0, 1, 0).
Shape bent_strip(double degrees) {
  const Strip strip;
  const double angle = degrees * std::numbers::pi / 180;
  return strip.shape([&](std::size_t v) {
    const Vector3d rest = strip.positions[v];
    const Vector3d arm = rest - Vector3d(0, 1, 0);
    const Vector3d turned(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                          1 + std::sin(angle) * arm.x() + std::cos(angle) * arm.y(), 0);
    const double upper = Strip::upper_part(static_cast<int>(v / 2));
    return Vector3d((1 - upper) * rest + upper * turned);
  });
}

/// The strip with one morph target that lifts row r by r²/64. Its weight goes from 0 to 1 in one second.
void write_morphing_strip(const TemporaryFolder& folder) {
  const Strip strip;
  std::vector<float> offsets;
  for (int v = 0; v < 2 * Strip::rows; ++v)
    offsets.insert(offsets.end(), {0, 0, static_cast<float>((v / 2) * (v / 2)) / 64});
  GltfFile file;
  file.add(strip.floats(), 5126, "VEC3", R"(,"min":[0,0,0],"max":[0.25,2,0])");
  file.add(strip.corners, 5123, "SCALAR");
  file.add(offsets, 5126, "VEC3", R"(,"min":[0,0,0],"max":[0,0,1])");
  file.add(std::vector<float>{0, 1}, 5126, "SCALAR", R"(,"min":[0],"max":[1])");
  file.add(std::vector<float>{0, 1}, 5126, "SCALAR");
  file.write(folder.path().string(), "strip", R"("scene":0,"scenes":[{"nodes":[0]}],
    "nodes":[{"name":"strip","mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":2}]}],"weights":[0]}],
    "animations":[{"name":"lift","samplers":[{"input":3,"output":4,"interpolation":"LINEAR"}],
                   "channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}]}])");
}

/// Runs the animated strip at 8 frames per second against a static box.
std::vector<graze::io::ReportedFrame> run_strip(const TemporaryFolder& folder, const Shape& obstacle,
                                                const std::string& animation) {
  folder.write("obstacle.obj", obj_text(obstacle));
  const auto scene = folder.write("scene.json", R"({"graze": 1, "contact_distance": 0.05, "range": 0.5,
      "frames_per_second": 8, "objects": [{"mesh": "strip.gltf", "animation": )" +
                                                    animation + R"(},
      {"name": "obstacle", "mesh": "obstacle.obj", "motion": "fixed"}]})");
  const auto report = folder / "report.jsonl";
  const auto result = run_graze({"run", scene.string(), "--report", report.string()});
  INFO(result.err);
  CHECK(result.exit_code == 0);
  return read_report(report);
}

}  // namespace

TEST_CASE("a numbered OBJ sequence, also with gaps in its numbers, is played frame by frame") {
  const TemporaryFolder folder;
  folder.write("sheet.obj", obj_text(dipping_sheet(0)));
  for (int frame = 0; frame < dip_frames; ++frame)
    folder.write("sheet_" + std::to_string(8 + 2 * frame) + ".obj",
                 obj_text(dipping_sheet(frame)));  // 8, 10, … 18
  CHECK(check_dipping_sheet(folder, "sheet_#.obj") > 4);
}

TEST_CASE("a numbered PLY sequence is played frame by frame") {
  const TemporaryFolder folder;
  folder.write("sheet.obj", obj_text(dipping_sheet(0)));
  for (int frame = 0; frame < dip_frames; ++frame)
    folder.write("sheet_000" + std::to_string(frame) + ".ply", ply_text(dipping_sheet(frame)));
  CHECK(check_dipping_sheet(folder, "sheet_####.ply") > 4);
}

TEST_CASE("a PC2 cache is played sample by sample") {
  const TemporaryFolder folder;
  folder.write("sheet.obj", obj_text(dipping_sheet(0)));
  std::vector<std::vector<Vector3d>> frames;
  for (int frame = 0; frame < dip_frames; ++frame) frames.push_back(dipping_sheet(frame).positions);
  folder.write("sheet.pc2", pc2_bytes(frames));
  CHECK(check_dipping_sheet(folder, "sheet.pc2") > 4);
}

TEST_CASE("NaN in one frame is a diagnostic in the report, and the program goes on to exit code 0") {
  const TemporaryFolder folder;
  folder.write("sheet.obj", obj_text(dipping_sheet(0)));
  folder.write("spike.obj", obj_text(below_sheet()));
  std::vector<std::vector<Vector3d>> frames;
  for (int frame = 0; frame < 3; ++frame) frames.push_back(dipping_sheet(frame).positions);
  frames[1][7].y() = std::nan("");
  folder.write("sheet.pc2", pc2_bytes(frames));
  const auto scene = folder.write("scene.json", R"({"graze": 1, "contact_distance": 0.035, "objects": [
      {"mesh": "spike.obj"}, {"name": "sheet", "mesh": "sheet.obj", "positions": "sheet.pc2"}]})");
  const auto report = folder / "report.jsonl";
  const auto result = run_graze({"run", scene.string(), "--report", report.string()});
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK_THAT(result.out, Catch::Matchers::Contains("1 diagnostic, the first: frame 1, sheet: "));
  const auto read = read_report(report);
  REQUIRE(read.size() == 3);
  REQUIRE((read[0].diagnostics.empty() && read[1].diagnostics.size() == 1 && read[2].diagnostics.empty()));
  CHECK(read[1].diagnostics[0].object == 1U);
  CHECK(read[1].diagnostics[0].kind == graze::DiagnosticKind::not_finite);
  REQUIRE((read[0].pairs.size() == 1 && read[1].pairs.size() == 1));
  CHECK(read[1].pairs[0].stale);
  CHECK(read[1].pairs[0].distance.upper == read[0].pairs[0].distance.upper);
}

TEST_CASE("a glTF skin bends into a static box as by hand") {
  const TemporaryFolder folder;
  write_skinned_strip(folder);
  const Shape obstacle = box({-0.9, 1.1, -0.3}, {0.5, 0.37, 0.71});
  std::vector<ExpectedShapes> frames;
  for (int frame = 0; frame <= 8; ++frame) frames.push_back({bent_strip(90.0 * frame / 8), obstacle});
  CHECK(check_nearly(run_strip(folder, obstacle, "\"bend\""), frames, {0.05, 0.5}, 2e-6) > 0);
}

TEST_CASE("a glTF morph target lifts into a static box as by hand") {
  const TemporaryFolder folder;
  write_morphing_strip(folder);
  const Strip strip;
  const Shape obstacle = box({-0.3, 1.6, 0.4}, {1.1, 0.83, 0.29});
  std::vector<ExpectedShapes> frames;
  for (int frame = 0; frame <= 8; ++frame)
    frames.push_back({strip.shape([&](std::size_t v) {
                        const double row = static_cast<double>(v / 2);
                        return Vector3d(strip.positions[v] + Vector3d(0, 0, row * row / 64 * frame / 8));
                      }),
                      obstacle});
  CHECK(check_nearly(run_strip(folder, obstacle, "0"), frames, {0.05, 0.5}, 2e-6) > 0);
}

TEST_CASE("mesh files given directly play their first animation") {
  const TemporaryFolder folder;
  write_skinned_strip(folder);
  const Shape obstacle = box({-0.9, 1.1, -0.3}, {0.5, 0.37, 0.71});
  folder.write("obstacle.obj", obj_text(obstacle));
  const auto report = folder / "report.jsonl";
  CHECK(run_graze({"run", (folder / "strip.gltf").string(), (folder / "obstacle.obj").string(),
                   "--frames-per-second", "4", "--contact-distance", "0.05", "--range", "0.5", "--report",
                   report.string()})
            .exit_code == 0);
  std::vector<ExpectedShapes> frames;
  for (int frame = 0; frame <= 4; ++frame) frames.push_back({bent_strip(90.0 * frame / 4), obstacle});
  CHECK(check_nearly(read_report(report), frames, {0.05, 0.5}, 2e-6) > 0);
}
