#include <filesystem>
#include <graze/io/mesh_file.hpp>
#include <set>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/program.hpp"
#include "tools/program_report.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Eigen::Vector3d;
using graze::io::MeshFile;
using graze::oracle::Shape;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

bool is_missing(const std::filesystem::path& file) {
  if (std::filesystem::exists(file)) return false;
  WARN("skipped: " << file.filename().string() << " is not here");
  return true;
}

Shape shape_of(const graze::Mesh& mesh, std::vector<Vector3d> positions) {
  Shape shape{std::move(positions), {}};
  for (std::uint32_t face = 0; face < mesh.face_count(); ++face)
    shape.faces.emplace_back(mesh.face(face).begin(), mesh.face(face).end());
  return shape;
}

/// A box half the size of what an object passes through, at the end of it where `side` is 1 along an axis.
Shape obstacle_beside(const std::vector<Shape>& frames, const Vector3d& side) {
  Vector3d low = frames[0].positions[0];
  Vector3d high = low;
  for (const Shape& frame : frames)
    for (const Vector3d& point : frame.positions) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  const Vector3d size = 0.51 * (high - low) + Vector3d::Constant(0.0123 * (high - low).norm());
  return box(low + 0.247 * (high - low) + 0.74 * side.cwiseProduct(high - low), size);
}

/// Runs one object of a real animated file against a static box and compares with brute force over the
/// positions that the file's reader gives at each frame's time.
std::size_t check_character(const std::filesystem::path& file, std::uint32_t animation,
                            double frames_per_second, std::uint32_t frame_count, const Vector3d& side) {
  const TemporaryFolder folder;
  const MeshFile character = MeshFile::read(file);
  const graze::Mesh& mesh = *character.objects()[0].mesh;
  std::vector<Shape> moving;
  for (std::uint32_t frame = 0; frame < frame_count; ++frame) {
    std::vector<Vector3d> positions;
    character.animate(0, animation, frame / frames_per_second, positions);
    moving.push_back(shape_of(mesh, positions));
  }
  const Shape obstacle = obstacle_beside(moving, side);
  folder.write("obstacle.obj", obj_text(obstacle));
  const double threshold = 0.004 * (obstacle.positions[7] - obstacle.positions[0]).norm();
  const auto scene = folder.write(
      "scene.json", R"({"graze": 1, "contact_distance": )" + number_text(threshold) + R"(, "range": )" +
                        number_text(20 * threshold) + R"(, "frames": )" + std::to_string(frame_count) +
                        R"(, "frames_per_second": )" + number_text(frames_per_second) + R"(, "objects": [
      {"mesh": ")" + file.string() +
                        R"(", "node": 0, "animation": )" + std::to_string(animation) + R"(},
      {"name": "obstacle", "mesh": "obstacle.obj", "motion": "fixed"}]})");
  const auto report = folder / "report.jsonl";
  const auto result = run_graze({"run", scene.string(), "--report", report.string()});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  std::vector<ExpectedShapes> frames;
  for (const Shape& shape : moving) frames.push_back({shape, obstacle});
  return check_exactly(read_report(report), frames, {threshold, 20 * threshold});
}

/// How many vertices of the second object touch one of the first.
std::size_t vertices_touched(const graze::io::ReportedFrame& frame) {
  std::set<std::uint32_t> vertices;
  for (const auto& pair : frame.pairs)
    for (const auto& reported : pair.contacts) vertices.insert(reported.contact.feature_b.index);
  return vertices.size();
}

const std::filesystem::path assimp_models = GRAZE_ASSIMP_MODELS;
const std::filesystem::path shared_data = GRAZE_SHARED_DATA;

}  // namespace

TEST_CASE("an X file with a skeleton against a static box") {
  const auto file = assimp_models / "X" / "anim_test.x";
  if (is_missing(file)) return;
  CHECK(check_character(file, 0, 6, 4, {0, 1, 0}) > 0);
}

TEST_CASE("an FBX file with a skeleton against a static box") {
  const auto file = assimp_models / "FBX" / "huesitos.fbx";
  if (is_missing(file)) return;
  CHECK(check_character(file, 0, 5, 5, {0, 1, 0}) > 0);
}

TEST_CASE("a glTF file with morph targets against a static box") {
  const auto file = assimp_models / "glTF2/glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf";
  if (is_missing(file)) return;
  CHECK(check_character(file, 0, 2, 8, {0, 0, 1}) > 0);
}

TEST_CASE("a running fox, skinned, against a static box") {
  const auto file = shared_data / "characters" / "Fox.glb";
  if (is_missing(file)) return;
  CHECK(check_character(file, 2, 12, 5, {0, 0, 1}) > 0);
}

TEST_CASE("a real cache gives the frames that its makers exported") {
  const auto caches = shared_data / "caches";
  if (is_missing(caches / "max_cache_box.pc2")) return;
  const TemporaryFolder folder;
  // The cache starts at frame 40: its samples 4 and 8 are the OBJ files of frames 44 and 48. There, and only
  // there, every vertex of the cached object is where the exported one has it.
  for (const auto& [sample, number] : {std::pair{4U, "44"}, std::pair{8U, "48"}}) {
    const std::string exported = (caches / ("max_cache_box_" + std::string(number) + ".obj")).string();
    const auto scene = folder.write(
        "scene.json",
        R"({"graze": 1, "contact_distance": 0.004, "detail": "vertices", "frames": 10, "objects": [
        {"name": "cached", "mesh": ")" +
            exported + R"(", "positions": ")" + (caches / "max_cache_box.pc2").string() +
            R"(", "transform": {"translate": [0, 0, 10]}}, {"name": "exported", "mesh": ")" + exported +
            R"("}]})");
    const auto report = folder / "report.jsonl";
    const auto result = run_graze({"run", scene.string(), "--report", report.string()});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    for (const auto& frame : read_report(report)) {
      INFO("frame " << frame.frame);
      CHECK((vertices_touched(frame) == 770) == (frame.frame == sample));
    }
  }
}
