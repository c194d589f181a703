#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

const std::vector<std::array<float, 9>> two_faces = {{0, 0, 0, 1, 0, 0, 0, 1, 0},
                                                     {1, 0, 0, 1, 1, 0, 0, 1, 0}};

/// A binary file of the two faces that says it has `count`.
std::string binary(const std::string& name, std::uint32_t count) {
  std::string bytes = name + std::string(80 - name.size(), ' ');
  append(bytes, count);
  for (const auto& face : two_faces) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0F);
    for (const float number : face) append(bytes, number);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string facet(const std::string& corners) {
  return "facet normal 0 0 1\n  outer loop\n" + corners + "  endloop\nendfacet\n";
}

const std::string low = facet("vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n");
const std::string high = facet("vertex 1 0 0\nvertex 1 1 0\nvertex 0 1 0\n");

void check_two_faces(const graze::Mesh& mesh) {
  CHECK(faces_of(mesh) == std::vector<Corners>{{0, 1, 2}, {1, 3, 2}});
  const auto rest = mesh.rest();
  CHECK(std::vector<Eigen::Vector3d>(rest.begin(), rest.end()) ==
        std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}});
}

}  // namespace

TEST_CASE("a binary STL file is binary whatever its header begins with") {
  const TemporaryFolder folder;
  for (const std::string header : {"", "solid", "solid part", "solid facet normal", "SOLID"}) {
    INFO(header);
    const auto file = MeshFile::read(folder.write("part.stl", binary(header, 2)));
    CHECK(file.warnings().empty());
    CHECK(file.objects()[0].name == "part");
    check_two_faces(*file.objects()[0].mesh);
  }
}

TEST_CASE("bytes behind the last face of a binary STL file are a warning") {
  const TemporaryFolder folder;
  for (const std::string header : {"part", "solid part"})
    for (const std::size_t more : {1U, 2U, 49U, 50U, 1000U}) {
      INFO(header << more);
      const auto file = MeshFile::read(folder.write("part.stl", binary(header, 2) + std::string(more, 'x')));
      REQUIRE(file.warnings().size() == 1);
      CHECK_THAT(file.warnings()[0],
                 Catch::Matchers::EndsWith(std::to_string(more) +
                                           " bytes behind the last of its 2 faces were left out"));
      check_two_faces(*file.objects()[0].mesh);
    }
}

TEST_CASE("a binary STL file that is cut off anywhere is refused with what is missing") {
  const TemporaryFolder folder;
  for (const std::string header : {"part", "solid part"}) {
    const std::string whole = binary(header, 2);
    for (std::size_t size = 84; size < whole.size(); ++size) {
      INFO(header << size);
      CHECK_THAT(refusal_of(folder.write("cut.stl", whole.substr(0, size))),
                 Catch::Matchers::StartsWith("byte " + std::to_string(size) + ": the file ends after " +
                                             std::to_string((size - 84) / 50) + " of the 2 faces"));
    }
  }
  CHECK_THAT(refusal_of(folder.write("cut.stl", binary("part", 2).substr(0, 50))),
             Catch::Matchers::StartsWith("this is neither a text that begins with 'solid' nor"));
}

TEST_CASE("a binary STL file that announces no face is refused as such") {
  const TemporaryFolder folder;
  CHECK_THAT(refusal_of(folder.write("none.stl", binary("part", 0))),
             Catch::Matchers::StartsWith("byte 80: the header announces 0 faces, and 100 bytes follow"));
  CHECK_THAT(refusal_of(folder.write("none.stl", binary("part", 0).substr(0, 84))),
             Catch::Matchers::StartsWith("byte 80: the header announces 0 faces, and 0 bytes follow"));
}

TEST_CASE("each solid of an STL text is an object of that name, in double precision") {
  const TemporaryFolder folder;
  const auto file = MeshFile::read(
      folder.write("two.stl", "solid left half\n" + low + high + "endsolid left half\r\nSOLID\n" +
                                  facet("VERTEX 0.1 0 0\nvertex 1 0 0\nvertex 0 1 0\n") + "end solid\n"));
  REQUIRE(file.objects().size() == 2);
  CHECK(file.objects()[0].name == "left half");
  CHECK(file.objects()[1].name == "two");
  check_two_faces(*file.objects()[0].mesh);
  CHECK(file.objects()[1].mesh->rest()[0].x() == 0.1);
}

TEST_CASE("an STL text that is cut off or damaged is refused by its line") {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& text) { return refusal_of(folder.write("part.stl", text)); };
  CHECK_THAT(refusal("solid a\n" + low + high),
             Catch::Matchers::StartsWith(
                 "line 15: the file ends after 2 faces of solid 'a' without its 'endsolid'"));
  CHECK_THAT(refusal("solid a\n" + low + "facet normal 0 0 1\nouter loop\nvertex 0 0"),
             Catch::Matchers::StartsWith("line 11: a vertex needs three numbers and has '' as number 3"));
  CHECK_THAT(refusal("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\n"),
             Catch::Matchers::StartsWith("line 4: a vertex needs three numbers and has 'x' as number 3"));
  CHECK_THAT(refusal("solid a\nIt was a bright cold day.\n"),
             Catch::Matchers::StartsWith("line 2: 'it' is no word of an STL file"));
  CHECK_THAT(refusal("solid a\nendsolid a\n"), Catch::Matchers::StartsWith("there is no face in it"));
}
