// This test repeats the inputs that the fuzzers of tests/fuzz found, and those found while they were written.

#include <assimp/scene.h>

#include <graze/io/error.hpp>
#include <graze/io/report_json.hpp>
#include <graze/io/scene_file.hpp>

#include "assimp/assimp_scene.hpp"
#include "io/import_support.hpp"
#include "report/statistics_fields.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

/// The message with which `read` refuses its input. Empty when it takes it.
template <typename Read>
std::string message_of(Read read) {
  try {
    read();
  } catch (const io::InputError& error) {
    return error.what();
  }
  return "";
}

bool is_one_line(const std::string& message) {
  return !message.empty() && message.find_first_of("\r\n") == std::string::npos;
}

/// A report of one frame with one pair. `a` is the pair's first object, and `expanded` what stands for the
/// levels.
std::string report(const std::string& a, const std::string& expanded) {
  const std::string witness =
      R"({"a":["vertex",0],"b":["edge",0,[0,1]],"point_a":[0,0,0],"point_b":[0,0,1]})";
  std::string statistics;
  const auto append_zeros = [&](const auto& fields) {
    for (const auto& [name, member] : fields) statistics.append("\"").append(name).append("\":0,");
  };
  append_zeros(io::count_fields);
  append_zeros(io::work_fields);
  append_zeros(io::bytes_fields);
  return R"({"graze":1,"objects":[{"id":0,"name":"x","vertices":3,"faces":1}],"settings":{"contact_distance":0,)"
         R"("range":1,"detail":"none","accuracy":"exact"}})"
         "\n"
         R"({"frame":0,"complete":true,"pairs":[{"a":)" +
         a + R"(,"b":1,"phase":"near","distance":[1,1],"witness":)" + witness +
         R"(,"contacts":[]}],"diagnostics":[],"statistics":{)" + statistics +
         "\"regions_expanded\":" + expanded + "}}\n";
}

std::string report_refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.write("report.jsonl", text);
  return message_of([&] {
    io::ReportReader reader(path);
    reader.next();
  });
}

std::string scene_refusal(const std::string& text) {
  const TemporaryFolder folder;
  const auto path = folder.write("scene.json", text);
  return message_of([&] { io::read_scene_file(path); });
}

/// One triangle below one node.
std::unique_ptr<aiScene> triangle_scene() {
  auto scene = std::make_unique<aiScene>();
  scene->mNumMeshes = 1;
  // NOLINTNEXTLINE(clang-analyzer-cplusplus.NewDeleteLeaks): the scene's destructor frees all of it
  scene->mMeshes = new aiMesh* [1] { new aiMesh };
  aiMesh& mesh = *scene->mMeshes[0];
  mesh.mNumVertices = 3;
  mesh.mVertices = new aiVector3D[3]{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.mNumFaces = 1;
  mesh.mFaces = new aiFace[1];
  mesh.mFaces[0].mNumIndices = 3;
  mesh.mFaces[0].mIndices = new unsigned[3]{0, 1, 2};
  scene->mRootNode = new aiNode("root");
  scene->mRootNode->mNumMeshes = 1;
  scene->mRootNode->mMeshes = new unsigned[1]{0};
  return scene;
}

}  // namespace

TEST_CASE("a PLY file has its vertices in one element") {
  const TemporaryFolder folder;
  const std::string head = "ply\nformat ascii 1.0\n";
  const std::string vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  CHECK(refusal_of(folder.write("once.ply", head + vertex + face + "1 2 3\n3 0 0 0\n")).empty());
  CHECK_THAT(refusal_of(folder.write("none.ply", head + face + "3 0 0 0\n")),
             Catch::Matchers::Contains("there is no element 'vertex'"));
  CHECK_THAT(refusal_of(folder.write("twice.ply", head + vertex + vertex + face + "1 2 3\n1 2 3\n3 0 0 1\n")),
             Catch::Matchers::Contains("element 'vertex' stands twice"));
}

TEST_CASE("whole numbers of a report are neither rounded nor wrapped around") {
  CHECK(report_refusal(report("0", "[64, 18446744073709551615]")).empty());
  for (const char* number : {"2.88889e126", "-1", "0.5", "4294967296", "true"})
    CHECK_THAT(report_refusal(report(number, "[]")),
               Catch::Matchers::Contains("line 2: a number is not whole"));
  for (const char* levels : {"[-1]", "[1.5]", "[1e30]", "7"})
    CHECK_THAT(report_refusal(report("0", levels)), Catch::Matchers::Contains("line 2: "));
}

TEST_CASE("a refusal is one line whatever the names of the file") {
  CHECK(is_one_line(scene_refusal(R"({"graze": 1, "two\nlines": 2, "objects": [{"mesh": "a.obj"}]})")));
  CHECK(is_one_line(scene_refusal(
      R"({"graze": 1, "objects": [{"name": "a\r\nb", "mesh": "a.obj"}, {"name": "a\r\nb", "mesh": "a.obj"}]})")));
}

TEST_CASE("a scene file that is nested without end is refused") {
  constexpr std::size_t depth = 100000;
  const std::string brackets = std::string(depth, '[') + std::string(depth, ']');
  CHECK_THAT(scene_refusal(R"({"graze": 1, "objects": [{"mesh": )" + brackets + "}]}"),
             Catch::Matchers::Contains("nested deeper than 200 levels"));
  CHECK_THAT(report_refusal(report("0", brackets)), Catch::Matchers::Contains("line 2: "));
}

TEST_CASE("what an importer leaves unfinished is refused") {
  const std::filesystem::path path = "scene.fbx";
  const auto refusal = [&](const aiScene& scene) {
    return message_of([&] { io::convert_scene(path, scene); });
  };
  const auto scene = triangle_scene();
  REQUIRE(io::convert_scene(path, *scene).file.objects.size() == 1);
  scene->mRootNode->mMeshes[0] = 1;
  CHECK_THAT(refusal(*scene), Catch::Matchers::Contains("node 'root' names mesh 1 of 1"));
  scene->mRootNode->mMeshes[0] = 0;
  delete[] scene->mMeshes[0]->mVertices;
  scene->mMeshes[0]->mVertices = nullptr;
  CHECK_THAT(refusal(*scene), Catch::Matchers::Contains("it has no positions"));
}
