#include <clocale>
#include <random>

#include "io/formats/gltf_builder.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

const std::vector<std::string> extensions = {".obj", ".ply", ".off", ".stl", ".gltf",
                                             ".glb", ".fbx", ".dae", ".x",   ".3ds"};

std::string triangle_glb() {
  GltfBuffer buffer;
  const auto p = buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  return buffer.glb(
      R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":)" +
      std::to_string(p) + "}}]}]");
}

}  // namespace

TEST_CASE("files that are not there, empty, folders or garbage are refused in one line") {
  const TemporaryFolder folder;
  std::mt19937 random(11);
  for (const auto& extension : extensions) {
    INFO(extension);
    CHECK_THAT(refusal_of(folder / ("none" + extension)),
               Catch::Matchers::StartsWith("there is no such file"));
    CHECK_THAT(refusal_of(folder.write("empty" + extension, "")),
               Catch::Matchers::StartsWith("the file is empty"));
    std::filesystem::create_directory(folder / ("folder" + extension));
    CHECK_THAT(refusal_of(folder / ("folder" + extension)), Catch::Matchers::StartsWith("this is a folder"));
    for (const std::size_t size : {1U, 13U, 100U, 3000U}) {
      std::string garbage(size, ' ');
      for (char& byte : garbage) byte = static_cast<char>(random());
      CHECK_FALSE(refusal_of(folder.write("garbage" + extension, garbage)).empty());
    }
    CHECK_FALSE(
        refusal_of(folder.write("words" + extension, "It was a bright cold day in April.\n")).empty());
  }
  CHECK_FALSE(refusal_of(folder.write("mesh.unknown", "It was a bright cold day in April.\n")).empty());
}

TEST_CASE("every nasty file is read or refused in one line") {
  const auto root = shared_file("nasty");
  if (is_missing(root)) return;
  // The files that hold no usable mesh and have to be refused.
  const std::set<std::string> refused = {"inf_nan.obj",
                                         "invalid-face-definition.obj",
                                         "issue-140-zero-face-idx.obj",
                                         "empty.obj",
                                         "empty.ply",
                                         "empty.stl",
                                         "empty_nodes.glb",
                                         "points_emptyface.ply"};
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_regular_file() || name.starts_with("LICENSE")) continue;
    INFO(name);
    CHECK(refusal_of(entry.path()).empty() == !refused.contains(name));
    ++count;
  }
  CHECK(count >= refused.size());
}

TEST_CASE("a binary glTF cut off anywhere is refused") {
  const TemporaryFolder folder;
  const std::string whole = triangle_glb();
  CHECK(refusal_of(folder.write("whole.glb", whole)).empty());
  for (std::size_t size = 1; size < whole.size(); ++size) {
    INFO(size);
    CHECK_FALSE(refusal_of(folder.write("cut.glb", whole.substr(0, size))).empty());
  }
}

TEST_CASE("files cut off anywhere are read or refused, never a crash") {
  const auto path =
      GENERATE(shared_file("characters/Fox.glb"), shared_file("nasty/trimesh/suzanne.ply"),
               shared_file("instruments/tool_yaw_link.STL"), shared_file("nasty/trimesh/wallhole.obj"),
               assimp_model("FBX/huesitos.fbx"), assimp_model("FBX/phong_cube.fbx"),
               assimp_model("X/test_cube_text.x"), assimp_model("Collada/cube_triangulate.dae"));
  if (is_missing(path)) return;
  const TemporaryFolder folder;
  const std::string whole = read_file(path);
  std::mt19937_64 random(3);
  const AssimpLeaks leaks;
  for (int run = 0; run < 25; ++run)
    refusal_of(
        folder.write("cut" + path.extension().string(), whole.substr(0, 1 + random() % (whole.size() - 1))));
}

TEST_CASE("bytes changed at random are read or refused, never a crash") {
  const auto path =
      GENERATE(shared_file("nasty/trimesh/suzanne.ply"), shared_file("instruments/tool_yaw_link.STL"),
               shared_file("nasty/trimesh/whitespace.off"), shared_file("nasty/trimesh/wallhole.obj"));
  if (is_missing(path)) return;
  const TemporaryFolder folder;
  const std::string whole = read_file(path);
  std::mt19937_64 random(5);
  for (int run = 0; run < 50; ++run) {
    std::string changed = whole;
    for (int i = 0; i < 5; ++i) changed[random() % changed.size()] = static_cast<char>(random());
    refusal_of(folder.write("changed" + path.extension().string(), changed));
  }
}

TEST_CASE("glTF files with damaged JSON are refused") {
  const TemporaryFolder folder;
  const std::string deep(100000, '[');
  CHECK_THAT(refusal_of(folder.write("deep.gltf", deep)), Catch::Matchers::Contains("nested deeper than"));
  CHECK_THAT(refusal_of(folder.write("cut.gltf", R"({"nodes":[)")),
             Catch::Matchers::Contains("JSON cannot be read"));
  CHECK_FALSE(
      refusal_of(
          folder.write("types.gltf", R"({"asset":{"version":"2.0"},"nodes":[1,"a",{"mesh":"x","weights":[1]}],
      "meshes":[3,{"primitives":7}],"animations":{"channels":[{}]}})"))
          .empty());
  CHECK_FALSE(refusal_of(folder.write("list.gltf", "[1, 2]")).empty());
}

TEST_CASE("a sparse glTF accessor of an impossible count is refused before memory is taken for it") {
  GltfBuffer buffer;
  buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  std::string text = buffer.gltf(
      R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0}}]}])");
  const std::string plain = R"("bufferView":0,"componentType":5126,"count":3,)";
  const auto place = text.find(plain);
  REQUIRE(place != std::string::npos);
  text.replace(place, plain.size(),
               R"("componentType":5126,"count":3000000000,"sparse":{"count":1,"indices":{"bufferView":0,)"
               R"("componentType":5125},"values":{"bufferView":0}},)");
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of(folder.write("sparse.gltf", text)),
             Catch::Matchers::StartsWith("accessors[0]: 3000000000 elements are more than 36 bytes"));
}

TEST_CASE("a decimal comma in the locale changes nothing") {
  const char* found = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "ru_RU.UTF-8", "nl_NL.UTF-8"})
    if (found == nullptr) found = std::setlocale(LC_ALL, name);
  if (found == nullptr) {
    std::printf("skipped: no locale with a decimal comma is installed\n");
    return;
  }
  REQUIRE(std::string(std::localeconv()->decimal_point) == ",");
  const TemporaryFolder folder;
  const std::vector<std::filesystem::path> files = {
      folder.write("a.obj", "v 0.5 0.25 0\nv 1.5 0 0\nv 0 1.75 0\nf 1 2 3\n"),
      folder.write("a.off", "OFF\n3 1 0\n0.5 0.25 0\n1.5 0 0\n0 1.75 0\n3 0 1 2\n"),
      folder.write(
          "a.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0.5 0.25 0\n1.5 0 0\n0 1.75 0\n3 0 1 2\n"),
      folder.write(
          "a.stl",
          "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0.5 0.25 0\nvertex 1.5 0 0\nvertex 0 1.75 0\n"
          "endloop\nendfacet\nendsolid a\n")};
  for (const auto& path : files) {
    INFO(path);
    const auto file = MeshFile::read(path);
    const auto rest = file.objects()[0].mesh->rest();
    CHECK(rest[0] == Eigen::Vector3d(0.5, 0.25, 0));
    CHECK(rest[1] == Eigen::Vector3d(1.5, 0, 0));
    CHECK(rest[2] == Eigen::Vector3d(0, 1.75, 0));
  }
  std::setlocale(LC_ALL, "C");
}
