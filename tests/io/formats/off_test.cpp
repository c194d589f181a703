#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

TEST_CASE("OFF keeps vertex numbers, doubles, quads and what precedes colours") {
  const TemporaryFolder folder;
  const auto header = GENERATE(as<std::string>(), "OFF\n7 3 0\n", "OFF 7 3 0\n", "OFF7 3\n",
                               "# made by hand\nOFF # plain\n\n 7 3 0 # counts\n", "COFF\r\n7 3 0\r\n");
  const auto file =
      MeshFile::read(folder.write("a.off", header + "9 9 9 255 0 0 255\n"
                                                    "0 0 0\n1 0 0\n1 1 0 0.5 0.5 0.5 1 # red\n\n0 1 0\n"
                                                    "0 0 0\n2 0.1 1e-1\n"
                                                    "4 1 2 3 4\n3  6 2 3  0.1 0.2 0.3\n3 5 2 6\n"));
  const auto& mesh = *file.objects()[0].mesh;
  REQUIRE(mesh.vertex_count() == 7);
  CHECK(mesh.rest()[0] == Eigen::Vector3d(9, 9, 9));
  CHECK(mesh.rest()[6] == Eigen::Vector3d(2, 0.1, 0.1));
  CHECK(faces_of(mesh) == std::vector<Corners>{{1, 2, 3, 4}, {6, 2, 3}, {5, 2, 6}});
}

TEST_CASE("OFF errors name the line") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> table = {
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: a face names vertex 3 of 3"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "line 6: a face names vertex -1 of 3"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", "line 6: a face has fewer corners than it says"},
      {"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4: a vertex needs three numbers"},
      {"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "line 6: the file ends before face 1 of 2"},
      {"OFF\n4000000000 1 0\n0 0 0\n", "line 3: the file ends before vertex 1 of 4000000000"},
      {"OFF\n99999999999 1 0\n0 0 0\n", "line 2: the file announces 2^32 vertices"},
      {"OFF\nthree 1 0\n", "line 2: the numbers of vertices and faces must stand here"},
      {"4OFF\n", "line 1: the file does not start with OFF"},
      {"OFF BINARY\n", "line 1: binary OFF is not read"},
      {"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "there is no face in it"},
      {"OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "object 'bad': vertex 0"},
  };
  for (const auto& [text, message] : table) {
    INFO(text);
    CHECK_THAT(refusal_of(folder.write("bad.off", text)), Catch::Matchers::StartsWith(message));
  }
}
