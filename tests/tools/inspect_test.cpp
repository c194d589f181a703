#include <filesystem>
#include <string>
#include <vector>

#include "support/catch.hpp"
#include "tools/gltf_file.hpp"
#include "tools/program.hpp"
#include "tools/shapes.hpp"
#include "tools/temporary_folder.hpp"

namespace {

using Catch::Matchers::Contains;
using graze::oracle::Shape;
using namespace graze::tests;  // NOLINT: the vocabulary of these tests

std::string inspect(const Shape& shape) {
  const TemporaryFolder folder;
  const auto result = run_graze({"inspect", folder.write("thing.obj", obj_text(shape)).string()});
  CHECK(result.exit_code == 0);
  CHECK(result.err.empty());
  CHECK_THAT(result.out, Contains("thing.obj: 1 object\n"));
  return result.out;
}

}  // namespace

TEST_CASE("inspect counts vertices, faces and edges, and says that a box is closed") {
  const std::string text = inspect(box({0, 0, 0}, {1, 1, 1}));
  CHECK_THAT(text, Contains("8 vertices, 6 faces (0 triangles, 6 quads), 12 edges"));
  CHECK_THAT(text, Contains("surface    closed\n"));
  CHECK_THAT(text, Contains("regions    1 by level; leaves: 1, of 8 to 8 vertices, 8.0 on average"));
  CHECK_THAT(text, Contains("bytes"));
}

TEST_CASE("inspect names what is odd, with how many and the first") {
  Shape shape = sheet(2, 1, {0, 0, 0});
  shape.positions.push_back({9, 9, 9});  // vertex 9: no face
  shape.faces.push_back({0, 1, 4, 3});   // face 4: as face 0
  shape.faces.push_back({0, 1, 1});      // face 5: repeats a corner
  const std::string text = inspect(shape);
  CHECK_THAT(text, Contains("10 vertices, 6 faces (1 triangles, 5 quads), 12 edges"));
  CHECK_THAT(text, Contains("open or non-manifold"));
  CHECK_THAT(text, Contains("1 degenerate faces (first: 5)"));
  CHECK_THAT(text, Contains("1 duplicate faces (first: 4)"));
  CHECK_THAT(text, Contains("1 vertices without a face (first: 9)"));
}

TEST_CASE("inspect's levels and epsilon are those of the method") {
  const Shape shape = sheet(9, 0.1, {3, 4, 5});
  const std::string text = inspect(shape);
  const auto tree = graze::oracle::regions_of(shape);
  const auto radii = graze::oracle::level_radii(tree, shape.positions);
  std::string levels, epsilon;
  for (std::size_t level = 0; level < radii.size(); ++level) {
    std::size_t count = 0;
    for (const auto& region : tree) count += region.level == level ? 1U : 0U;
    levels += (level == 0 ? "" : ", ") + std::to_string(count);
    std::array<char, 32> number;
    std::snprintf(number.data(), number.size(), "%.4g", radii[level]);
    epsilon += (level == 0 ? "" : ", ") + std::string(number.data());
  }
  CHECK(radii.size() > 1);
  CHECK_THAT(text, Contains("regions    " + levels + " by level; leaves: "));
  CHECK_THAT(text, Contains("epsilon    " + epsilon + " by level, at rest"));
}

TEST_CASE("inspect shows what a file says of its axes and what a scene file makes of them") {
  const TemporaryFolder folder;
  const Shape shape = box({0, 1, 2}, {10, 21, 32});
  const auto mesh = folder.write("thing.obj", obj_text(shape));
  const auto plain = run_graze({"inspect", mesh.string()});
  CHECK_THAT(plain.out, Contains("frame      axes and unit not said; coordinates as they stand in it"));
  CHECK_THAT(plain.out, Contains("bounds     from 0 1 2 to 10 22 34"));
  const auto scene = run_graze(
      {"inspect",
       folder
           .write("scene.json", R"({"graze": 1, "objects": [{"mesh": "thing.obj", "up": "y", "unit": "cm",
                        "transform": {"translate": [1, 0, 0]}}]})")
           .string()});
  CHECK(scene.exit_code == 0);
  CHECK_THAT(scene.out, Contains("thing.obj: converted: x y z become x -z y, times 0.01"));
  CHECK_THAT(scene.out, Contains("stands     from 1 -0.34 0.01 to 1.1 -0.02 0.22"));
}

TEST_CASE("graze inspect and graze run read files outside a mesh file's folder only if they are told to") {
  const TemporaryFolder folder;
  GltfFile file;
  file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3");
  const std::string mesh = file.write(
      folder.path().string(), "mesh",
      R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])");
  std::filesystem::create_directory(folder / "below");
  std::string text = read_file(mesh);
  text.replace(text.find("mesh.bin"), 0, "../");
  const std::string inner = folder.write("below/mesh.gltf", text).string();
  const std::string scene =
      folder.write("scene.json", R"({"graze": 1, "objects": [{"mesh": "below/mesh.gltf"}]})").string();
  for (const std::string command : {"run", "inspect"})
    for (const std::string& input : {inner, scene}) {
      const ProgramResult refused = run_graze({command, input});
      CHECK(refused.exit_code == 2);
      CHECK_THAT(refused.err, Catch::Matchers::Contains("is outside the folder of this file; put it there"));
      CHECK(run_graze({command, input, "--outside-files"}).exit_code == 0);
    }
}
