#include <assimp/scene.h>

#include <assimp/Importer.hpp>

#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

const std::vector<Eigen::Vector3d> positions = {{9, 9, 9},    {0, 0, 0},    {1, 0, 0},    {1, 1, 0},
                                                {0, 1, 1e-9}, {0, 0, -0.0}, {2, 0.1, 1e9}};
const std::vector<Corners> faces = {{1, 2, 3, 4}, {6, 2, 3}, {5, 2, 6}};

std::string header(const std::string& format) {
  return "ply\nformat " + format + " 1.0\ncomment end_header is not here\nobj_info x\n" +
         "element camera 1\nproperty list uchar short values\nproperty int kind\n" +
         "element vertex 7\nproperty uchar red\nproperty double x\nproperty float64 y\nproperty double z\n" +
         "element face 3\nproperty float quality\nproperty list uchar int vertex_indices\nend_header\n";
}

std::string binary_body(bool is_big_endian) {
  std::string bytes;
  append<std::uint8_t>(bytes, 2);
  append<std::int16_t>(bytes, -1, is_big_endian);
  append<std::int16_t>(bytes, 7, is_big_endian);
  append<std::int32_t>(bytes, 5, is_big_endian);
  for (const auto& position : positions) {
    append<std::uint8_t>(bytes, 200);
    for (const double number : {position.x(), position.y(), position.z()})
      append(bytes, number, is_big_endian);
  }
  for (const auto& face : faces) {
    append(bytes, 0.5F, is_big_endian);
    append(bytes, static_cast<std::uint8_t>(face.size()));
    for (const auto corner : face) append(bytes, static_cast<std::int32_t>(corner), is_big_endian);
  }
  return bytes;
}

const std::string text_body =
    "2 -1 7 5\n"
    "200 9 9 9\n200 0 0 0\n200 1 0 0\n200 1 1 0\n200 0 1 1e-9\n200 0 0 -0\n200 2 0.1 1e9\n"
    "0.5 4 1 2 3 4\n0.5 3 6 2 3\n0.5 3 5 2 6\n";

}  // namespace

TEST_CASE("PLY keeps vertex numbers and doubles in every encoding") {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> encodings = {
      {"ascii", text_body},
      {"binary_little_endian", binary_body(false)},
      {"binary_big_endian", binary_body(true)}};
  const auto& [format, body] = encodings[GENERATE(0U, 1U, 2U)];
  const auto path = folder.write(format + ".ply", header(format) + body);
  const auto file = MeshFile::read(path);
  REQUIRE(file.objects().size() == 1);
  const auto& mesh = *file.objects()[0].mesh;
  CHECK(std::vector(mesh.rest().begin(), mesh.rest().end()) == positions);
  CHECK(faces_of(mesh) == faces);
}

TEST_CASE("PLY triangle strips are unrolled with their winding") {
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("strip.ply",
                                                "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\n"
                                                "property float y\nproperty float z\nelement tristrips 1\n"
                                                "property list int int vertex_indices\nend_header\n"
                                                "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"
                                                "9 0 1 2 3 4 -1 3 5 4\n"));
  CHECK(faces_of(*file.objects()[0].mesh) ==
        std::vector<Corners>{{0, 1, 2}, {2, 1, 3}, {2, 3, 4}, {3, 5, 4}});
}

TEST_CASE("PLY files of the world agree with assimp's single precision") {
  const auto name = GENERATE(as<std::string>(), "sequences/armadillo-rollers/frames/326.ply",
                             "sequences/cloth-funnel/frames/228.ply", "cubes/two-cubes-close.ply",
                             "nasty/trimesh/suzanne.ply");
  const auto path = shared_file(name);
  if (is_missing(path)) return;
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  REQUIRE(scene != nullptr);
  const aiMesh& oracle = *scene->mMeshes[0];
  const auto file = MeshFile::read(path);
  const auto& mesh = *file.objects()[0].mesh;
  REQUIRE(mesh.vertex_count() == oracle.mNumVertices);
  REQUIRE(mesh.face_count() == oracle.mNumFaces);
  double largest = 0;
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i)
    for (unsigned axis = 0; axis < 3; ++axis)
      largest =
          std::max(largest, std::abs(mesh.rest()[i][axis] - static_cast<double>(oracle.mVertices[i][axis])));
  CHECK(largest < 1e-6 * mesh.rest()[0].norm() + 1e-6);
  for (std::uint32_t i = 0; i < mesh.face_count(); ++i)
    REQUIRE(
        std::ranges::equal(mesh.face(i), std::span(oracle.mFaces[i].mIndices, oracle.mFaces[i].mNumIndices)));
}

TEST_CASE("PLY errors name the line or the row") {
  const TemporaryFolder folder;
  const std::string begin = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
  const std::string middle =
      "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n";
  const std::vector<std::pair<std::string, std::string>> table = {
      {begin + middle + "0 0 0 1 0 0 0 1 0\n3 0 1 3\n",
       "face 0 (counted from 0): a face names vertex 3 of 3"},
      {begin + middle + "0 0 0 1 0 0 0 1 0\n3 0 1 -1\n",
       "face 0 (counted from 0): a face names vertex -1 of 3"},
      {begin + middle + "0 0 0 1 0 0 0 1 0\n3 0 1 0.5\n", "face 0 (counted from 0): a face names vertex 0.5"},
      {begin + middle + "0 0 0 1 0 0 0 1 0\n-1\n", "face 0 (counted from 0): a list has no proper length"},
      {begin + middle + "0 0 0 1 0 0 0 1 0\n3 0 1\n", "face 0 (counted from 0): the file ends here"},
      {begin + middle + "0 0 0 1 0 zero 0 1 0\n", "vertex 1 (counted from 0): the file ends here, or a word"},
      {begin + middle + "0 0 0 1 nan 0 0 1 0\n3 0 1 2\n", "object 'bad': vertex 1 (counted from 0)"},
      {begin + "element face 1\nend_header\n", "header: the vertices lack x, y or z"},
      {begin + "property quad z\n", "line 6: 'quad' is no PLY type"},
      {begin, "line 5: the header has no end_header"},
      {"ply\nformat text 1.0\n", "line 2: format 'text' is unknown"},
      {"ply\nend_header\n", "line 2: the header has no format line"},
      {"ply\nformat ascii 1.0\nproperty int x\n", "line 3: a property comes before any element"},
      {"ply\nformat ascii 1.0\nelement vertex 99999999999\n", "line 3: the element has 2^32 rows or more"},
      {"plx\n", "line 1: the file does not start with 'ply'"},
      {"ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\nproperty double "
       "y\n"
       "property double z\nend_header\n0123456789",
       "vertex 0 (counted from 0): the file ends here"},
      {"ply\nformat ascii 1.0\nelement nothing 4000000000\nelement vertex 0\nproperty float x\nproperty "
       "float y\nproperty float z\nend_header\n",
       "there is no face in it"},
  };
  for (const auto& [text, message] : table) {
    INFO(text);
    CHECK_THAT(refusal_of(folder.write("bad.ply", text)), Catch::Matchers::StartsWith(message));
  }
}
