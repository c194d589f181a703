#include <limits>

#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

TEST_CASE("OBJ keeps its vertex numbers, whatever its texture seams and unused vertices") {
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("seam.obj",
                                                "mtllib none.mtl\n"
                                                "v 9 9 9\n"  // used by no face
                                                "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                                "v 0 0 0\n"  // a second vertex in one place
                                                "v 2 0 0 0.5 0.5 0.5\n"
                                                "vt 0 0\nvt 1 0\nvt 0.5 1\nvn 0 0 1\n"
                                                "f 2/1/1 3/2/1 4/3/1 5/1/1\n"
                                                "f 7/3 3/1 4/1\n"
                                                "f 6//1 3//1 7//1\n"));
  REQUIRE(file.objects().size() == 1);
  CHECK(file.objects()[0].name == "seam");
  CHECK_FALSE(file.objects()[0].animated);
  CHECK(file.warnings().empty());
  const auto& mesh = *file.objects()[0].mesh;
  REQUIRE(mesh.vertex_count() == 7);
  CHECK(mesh.rest()[0] == Eigen::Vector3d(9, 9, 9));
  CHECK(mesh.rest()[6] == Eigen::Vector3d(2, 0, 0));
  CHECK(faces_of(mesh) == std::vector<Corners>{{1, 2, 3, 4}, {6, 2, 3}, {5, 2, 6}});
}

TEST_CASE("OBJ numbers are read to the last bit") {
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("numbers.obj",
                                                "v 0.1 3e-1 +1.7976931348623157e+30\n"
                                                "v -0.123456789012345678 1E2 5e-324\n"
                                                "v 1e-400 .5 7.\n"
                                                "f 1 2 3\n"));
  const auto rest = file.objects()[0].mesh->rest();
  CHECK(rest[0] == Eigen::Vector3d(0.1, 0.3, 1.7976931348623157e+30));
  CHECK(rest[1] == Eigen::Vector3d(-0.123456789012345678, 100, std::numeric_limits<double>::denorm_min()));
  CHECK(rest[2] == Eigen::Vector3d(0, 0.5, 7));
}

TEST_CASE("OBJ groups are objects of the vertices that they use, and a group named again goes on") {
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("groups.obj",
                                                "\xEF\xBB\xBFv 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nv 0 0 1\r\n"
                                                "f 1 2 3 # before any group\r\n"
                                                "g left arm\r\nf 1 2 \\\r\n 4\r\n"
                                                "g empty\r\n"
                                                "g right\r\nf 2 3 4\r\n"
                                                "g left arm\r\nf -4 -2 -1\r\n"
                                                "o box\r\nf 1 3 2\r\ng right\r\nf 3 2 4"));
  REQUIRE(file.objects().size() == 5);
  const std::vector<std::pair<std::string, std::vector<Corners>>> expected = {
      {"groups", {{0, 1, 2}}},
      {"left arm", {{0, 1, 3}, {0, 2, 3}}},
      {"right", {{0, 1, 2}}},
      {"box", {{0, 2, 1}}},
      {"right#2", {{1, 0, 2}}}};
  const std::vector<Corners> numbers = {{0, 1, 2}, {0, 1, 2, 3}, {1, 2, 3}, {0, 1, 2}, {1, 2, 3}};
  const std::vector<Eigen::Vector3d> vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(file.objects()[i].name == expected[i].first);
    CHECK(file.objects()[i].file_vertices == numbers[i]);
    CHECK(file.objects()[i].file_vertex_count == 4);
    const auto rest = file.objects()[i].mesh->rest();
    REQUIRE(rest.size() == numbers[i].size());
    for (std::size_t vertex = 0; vertex < rest.size(); ++vertex)
      CHECK(rest[vertex] == vertices[numbers[i][vertex]]);
    CHECK(faces_of(*file.objects()[i].mesh) == expected[i].second);
  }
}

TEST_CASE("OBJ errors name the line") {
  const TemporaryFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::vector<std::pair<std::string, std::string>> table = {
      {"f 1 2 99\n", "line 4: a face names vertex 99 of 3"},
      {"f 1 2 0\n", "line 4: a face names vertex 0 of 3"},
      {"f 1 2 -4\n", "line 4: a face names vertex -4 of 3"},
      {"\n\nf 1 2 3\nf 1 2 4294967299\n", "line 7: a face names vertex 4294967299 of 3"},
      {"f 1 2 18446744073709551619\n", "line 4: '18446744073709551619' is no corner"},
      {"f 1 two 3\n", "line 4: 'two' is no corner"},
      {"v 1 2\nf 1 2 3\n", "line 4: a vertex needs three numbers and has '' as number 3"},
      {"v 1 2,5 3\nf 1 2 3\n", "line 4: a vertex needs three numbers and has '2,5' as number 2"},
      {"f 1 2\n", "there is no face in it"},
      {"v nan 0 0\nf 1 2 4\n", "object 'bad': vertex 3 (counted from 0), used by face 0, is not finite"},
      {"v 0 -inf 0\nf 1 2 4\n", "object 'bad': vertex 3 (counted from 0), used by face 0, is not finite"},
  };
  for (const auto& [text, message] : table) {
    INFO(text);
    CHECK_THAT(refusal_of(folder.write("bad.obj", vertices + text)), Catch::Matchers::StartsWith(message));
  }
}

TEST_CASE("OBJ vertices may come after the faces that name them, and hold anything when no face does") {
  const TemporaryFolder folder;
  const auto file =
      MeshFile::read(folder.write("late.obj", "f 1 2 4\nv 0 0 0\nv 1 0 0\nv nan inf -inf\nv 0 1 0\nf 1 2\n"));
  CHECK(faces_of(*file.objects()[0].mesh) == std::vector<Corners>{{0, 1, 3}});
  REQUIRE(file.warnings().size() == 1);
  CHECK_THAT(file.warnings()[0],
             Catch::Matchers::EndsWith("1 faces with fewer than 3 corners were left out"));
}
