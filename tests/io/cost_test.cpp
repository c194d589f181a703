// Small files that share data, or hold one thing very often, cost what they hold.

#include <numbers>
#include <set>

#include "io/formats/gltf_builder.hpp"
#include "support/effort.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i == 0 ? "" : ",") + part;
  return text;
}

/// The accessor of a row of separate triangles: triangle i has the vertices 3 i to 3 i + 2.
std::string add_triangles(GltfBuffer& buffer, std::size_t count) {
  std::vector<float> positions;
  for (std::size_t i = 0; i < count; ++i) {
    const auto x = static_cast<float>(i);
    positions.insert(positions.end(), {x, 0, 0, x + 0.5F, 0, 0, x, 1, 0});
  }
  return std::to_string(buffer.add("VEC3", positions));
}

}  // namespace

TEST_CASE("groups of an OBJ file have the vertices that they use, and no others") {
  constexpr int groups = 400;
  std::string text;
  for (int i = 0; i < groups; ++i)
    text += "g part" + std::to_string(i) + "\nv " + std::to_string(i) + " 0 0\nv " + std::to_string(i) +
            " 1 0\nv 0 0 " + std::to_string(i + 1) + "\nf -3 -2 -1\n";
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("groups.obj", text));
  REQUIRE(file.objects().size() == groups);
  for (std::uint32_t i = 0; i < groups; ++i) {
    const auto& object = file.objects()[i];
    REQUIRE(object.mesh->vertex_count() == 3);
    CHECK(object.mesh->rest()[1] == Eigen::Vector3d(i, 1, 0));
    CHECK(object.file_vertices == Corners{3 * i, 3 * i + 1, 3 * i + 2});
    CHECK(object.file_vertex_count == 3 * groups);
  }
}

TEST_CASE("glTF meshes and primitives of one accessor read the vertices that they use") {
  GltfBuffer buffer;
  constexpr std::size_t count = 200;
  const auto p = add_triangles(buffer, count);
  const auto n = std::to_string(buffer.add("VEC3", {0, 0, 1}));
  std::string meshes, nodes, primitives;
  for (std::uint16_t i = 0; i < count; ++i) {
    const auto first = static_cast<std::uint16_t>(3 * i);
    const auto indices = std::to_string(buffer.add_indices(
        {static_cast<std::uint16_t>(first + 2), first, static_cast<std::uint16_t>(first + 1)}));
    const std::string begin = (i == 0 ? "" : ",") + std::string("{");
    // Different attributes that have nothing to do with where a vertex is.
    const std::string primitive = R"("attributes":{"POSITION":)" + p + R"(,"TEXCOORD_)" + std::to_string(i) +
                                  R"(":)" + n + R"(},"indices":)" + indices + "}";
    primitives += begin + primitive;
    meshes += begin + R"("primitives":[{)" + primitive + "]}";
    nodes += begin + R"("mesh":)" + std::to_string(i) + "}";
  }
  const TemporaryFolder folder;
  const auto file = MeshFile::read(
      folder.write("meshes.gltf", buffer.gltf(R"("nodes":[)" + nodes + R"(],"meshes":[)" + meshes + "]")));
  REQUIRE(file.objects().size() == count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto& mesh = *file.objects()[i].mesh;
    REQUIRE(mesh.vertex_count() == 3);
    CHECK(mesh.rest()[0] == Eigen::Vector3d(i, 0, 0));
    CHECK(faces_of(mesh) == std::vector<Corners>{{2, 0, 1}});
  }
  const auto one = MeshFile::read(
      folder.write("primitives.gltf",
                   buffer.gltf(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + primitives + "]}]")));
  REQUIRE(one.objects().size() == 1);
  CHECK(one.objects()[0].mesh->vertex_count() == 3 * count);
  CHECK(faces_of(*one.objects()[0].mesh)[7] == Corners{23, 21, 22});
}

TEST_CASE("a glTF file that unfolds to far more than it holds is refused by its name") {
  GltfBuffer buffer;
  const auto p = add_triangles(buffer, 20000);
  const std::string primitive = R"({"attributes":{"POSITION":)" + p + "}}";
  const std::string mesh = R"({"primitives":[)" + primitive + "]}";
  const TemporaryFolder folder;
  using Catch::Matchers::Contains;
  const std::string limit = "the file unfolds to more than 67108864 numbers here; split it";
  CHECK_THAT(refusal_of(folder.write("primitives.gltf",
                                     buffer.gltf(R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[)" +
                                                 repeated(primitive, 1200) + "]}]"))),
             Contains(limit));
  CHECK_THAT(
      refusal_of(folder.write("nodes.gltf", buffer.gltf(R"("nodes":[)" + repeated(R"({"mesh":0})", 400) +
                                                        R"(],"meshes":[)" + mesh + "]"))),
      Contains(limit));
  const auto times = std::to_string(buffer.add("SCALAR", std::vector<float>(20000, 1.0F)));
  const auto values = std::to_string(buffer.add("VEC3", std::vector<float>(60000, 1.0F)));
  CHECK_THAT(
      refusal_of(folder.write(
          "channels.gltf",
          buffer.gltf(R"("nodes":[{"mesh":0}],"meshes":[)" + mesh + R"(],"animations":[{"channels":[)" +
                      repeated(R"({"sampler":0,"target":{"node":0,"path":"translation"}})", 1000) +
                      R"(],"samplers":[{"input":)" + times + R"(,"output":)" + values + "}]}]"))),
      Contains(limit));
}

TEST_CASE("a glTF file counts the numbers of a mesh once, and those of each node that shows it") {
  constexpr std::size_t vertices = 60000;
  GltfBuffer buffer;
  const auto p = add_triangles(buffer, vertices / 3);
  const TemporaryFolder folder;
  for (const std::size_t targets : {0U, 1U}) {
    if (!at_full_effort && targets == 0) continue;
    const std::string morphed = targets == 0 ? "" : R"(,"targets":[{"POSITION":)" + p + "}]";
    const std::size_t of_mesh = 3 * vertices * (1 + targets) + vertices;
    const std::size_t of_node = 3 * vertices * (2 + targets) + vertices + 100;
    const std::size_t shown = ((std::size_t{1} << 26U) - of_mesh) / of_node;
    const auto path =
        folder.write("counted.gltf", buffer.gltf(R"("nodes":[)" + repeated(R"({"mesh":0})", 200) +
                                                 R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                                                 p + "}" + morphed + "}]}]"));
    CHECK_THAT(refusal_of(path), Catch::Matchers::StartsWith("nodes[" + std::to_string(shown) + "]: "));
  }
}

TEST_CASE("binary glTF 1 is refused whatever lengths it announces") {
  std::string bytes = "glTF";
  for (const std::uint32_t word : {1U, 48U, 20U, 0U}) append(bytes, word);
  bytes += R"({"asset":{"version":"1"}})";
  const TemporaryFolder folder;
  CHECK(refusal_of(folder.write("old.glb", bytes)) ==
        "this is binary glTF 1, which is not read; convert it to glTF 2");
}

TEST_CASE("skinned nodes that share a long chain of joints keep the joints that they use") {
  constexpr std::size_t joints = 300;
  GltfBuffer buffer;
  const auto p = std::to_string(buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const auto j = std::to_string(buffer.add_joints({44, 0, 0, 0, 44, 0, 0, 0, 44, 0, 0, 0}));
  const auto w = std::to_string(buffer.add("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
  const auto times = std::to_string(buffer.add("SCALAR", {0, 1}));
  const auto moves = std::to_string(buffer.add("VEC3", {0, 0, 1, 0, 0, 11}));
  std::string nodes, chain;
  for (std::size_t i = 0; i < joints; ++i) {
    const std::string below = i + 1 < joints ? R"(,"children":[)" + std::to_string(i + 1) + "]" : "";
    nodes += R"({"translation":[0,0,1])" + below + "},";
    chain += (i == 0 ? "" : ",") + std::to_string(i);
  }
  const auto document = [&](std::size_t moved_joint) {
    return buffer.gltf(
        R"("nodes":[)" + nodes + repeated(R"({"mesh":0,"skin":0})", 400) +
        R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + p + R"(,"JOINTS_0":)" + j +
        R"(,"WEIGHTS_0":)" + w + R"(}}]}],"skins":[{"joints":[)" + chain +
        R"(]}],"animations":[{"channels":[{"sampler":0,"target":{"path":"translation","node":)" +
        std::to_string(moved_joint) + R"(}}],"samplers":[{"input":)" + times + R"(,"output":)" + moves +
        "}]}]");
  };
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("chain.gltf", document(10)));
  REQUIRE(file.objects().size() == 400);
  CHECK(file.objects()[399].animated);
  CHECK(file.objects()[399].mesh->rest()[0] == Eigen::Vector3d(0, 0, 45));
  std::vector<Eigen::Vector3d> positions;
  file.animate(399, 0, 1, positions);
  CHECK(largest_difference(positions, {{0, 0, 55}, {1, 0, 55}, {0, 1, 55}}) < 1e-12);
  CHECK_FALSE(MeshFile::read(folder.write("below.gltf", document(45))).objects()[399].animated);
}

TEST_CASE("names that are equal or very long become names of their own") {
  GltfBuffer buffer;
  const auto p = std::to_string(buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  const std::string long_name = std::string(5000, 'a') + std::string(5000, 'z');
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write(
      "names.gltf",
      buffer.gltf(R"("nodes":[{"mesh":0,"name":"n#2"},)" + repeated(R"({"mesh":0,"name":"n"})", 3000) +
                  R"(,{"mesh":0},{"mesh":0}],)" + R"("meshes":[{"name":")" + long_name +
                  R"(","primitives":[{"attributes":{"POSITION":)" + p + "}}]}]")));
  REQUIRE(file.objects().size() == 3003);
  CHECK(file.objects()[1].name == "n");
  CHECK(file.objects()[2].name == "n#3");
  CHECK(file.objects()[3000].name == "n#3001");
  CHECK(file.objects()[3001].name == std::string(500, 'a') + "..." + std::string(497, 'z'));
  CHECK(file.objects()[3002].name == file.objects()[3001].name + "#2");
}

TEST_CASE("a message about a very long word keeps its file and its remedy, and no letter is cut in two") {
  const TemporaryFolder folder;
  std::string euros = "a";
  for (int i = 0; i < 3000; ++i) euros += "\xE2\x82\xAC";
  for (const std::string& word : {std::string(300000, 'x'), euros}) {
    const auto path = folder.write("word.obj", "v 0 0 " + word + "\n");
    const std::string message = refusal_of(path);
    CHECK(message.size() <= 2000);
    CHECK_THAT(message, Catch::Matchers::StartsWith("line 1: a vertex needs three numbers and has '"));
    CHECK_THAT(message, Catch::Matchers::EndsWith("' as number 3; correct the line"));
    CHECK(message.find("...") != std::string::npos);
    if (word[0] == 'x') continue;
    for (std::size_t i = message.find('\xE2'); i != std::string::npos; i = message.find('\xE2', i + 1))
      CHECK(message.compare(i, 3, "\xE2\x82\xAC") == 0);
  }
}

TEST_CASE("vertices of one place and many skin weights stay apart without comparing all with all") {
  constexpr std::size_t count = 30000;
  std::vector<float> weights;
  for (std::size_t i = 0; i < count; ++i) {
    const float share = static_cast<float>(i + 1) / (count + 2);
    weights.insert(weights.end(), {share, 1 - share, 0, 0});
  }
  GltfBuffer buffer;
  const auto p = std::to_string(buffer.add("VEC3", std::vector<float>(3 * count, 0.0F)));
  std::vector<std::uint8_t> joints(4 * count, 0);
  for (std::size_t i = 0; i < count; ++i) joints[4 * i + 1] = 1;
  const auto j = std::to_string(buffer.add_joints(joints));
  const auto w = std::to_string(buffer.add("VEC4", weights));
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write(
      "place.gltf", buffer.gltf(R"("nodes":[{"mesh":0,"skin":0},{},{}],"skins":[{"joints":[1,2]}],)"
                                R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                                p + R"(,"JOINTS_0":)" + j + R"(,"WEIGHTS_0":)" + w + "}}]}]")));
  CHECK(file.objects()[0].mesh->vertex_count() == count);
}
