// This test checks the reader against core glTF 2.0 and the extensions that it reads, on files made here.

#include <cmath>

#include "io/formats/gltf_builder.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

std::vector<Eigen::Vector3d> rest_of(const MeshFile& file, std::size_t object = 0) {
  const auto rest = file.objects()[object].mesh->rest();
  return {rest.begin(), rest.end()};
}

const std::vector<float> triangle = {0, 0, 0, 1, 0, 0, 0, 1, 0};

std::string one_mesh(const std::string& attributes, const std::string& more = "") {
  return R"("meshes":[{"primitives":[{"attributes":{)" + attributes + "}" + more + "}]}]";
}

std::string all_nodes(std::size_t count) {
  std::string list;
  for (std::size_t i = 0; i < count; ++i) list += (i == 0 ? "" : ",") + std::to_string(i);
  return R"("scene":0,"scenes":[{"nodes":[)" + list + "]}],";
}

MeshFile read_gltf_text(const std::string& text) {
  const TemporaryFolder folder;
  return MeshFile::read(folder.write("file.gltf", text));
}

std::string refusal_of_gltf(const std::string& text) {
  const TemporaryFolder folder;
  return refusal_of(folder.write("file.gltf", text));
}

/// The positions of the triangle's vertices when vertex i hangs on joint i with weights[i], the rest on
/// joint 3.
std::vector<Eigen::Vector3d> hung(const std::array<double, 3>& weights) {
  std::vector<Eigen::Vector3d> expected;
  for (std::size_t i = 0; i < 3; ++i)
    expected.emplace_back(triangle[3 * i], triangle[3 * i + 1],
                          weights[i] * static_cast<double>(i) + (1 - weights[i]) * 3);
  return expected;
}

const std::string joint_nodes =
    R"("nodes":[{"mesh":0,"skin":0},{},{"translation":[0,0,1]},{"translation":[0,0,2]},{"translation":[0,0,3]}],)";

/// A triangle whose vertex i hangs on joint i, at height i, and on joint 3.
template <typename Whole>
MeshFile hang_triangle(const std::array<Whole, 3>& weights, Whole one) {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  std::vector<Whole> list;
  for (const Whole weight : weights)
    list.insert(list.end(), {weight, static_cast<Whole>(one - weight), Whole{0}, Whole{0}});
  buffer.add_whole("VEC4", list, true);
  buffer.add_joints({0, 3, 0, 0, 1, 3, 0, 0, 2, 3, 0, 0});
  return read_gltf_text(buffer.gltf(all_nodes(5) + joint_nodes + R"("skins":[{"joints":[1,2,3,4]}],)" +
                                    one_mesh(R"("POSITION":0,"WEIGHTS_0":1,"JOINTS_0":2)")));
}

/// An animation of node 0 with one channel.
std::string animation(const std::string& path, std::size_t input, std::size_t output,
                      const std::string& interpolation) {
  return R"("animations":[{"channels":[{"sampler":0,"target":{"node":0,"path":")" + path +
         R"("}}],"samplers":[{"input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(output) +
         R"(,"interpolation":")" + interpolation + R"("}]}])";
}

}  // namespace

TEST_CASE("glTF skin weights of bytes and shorts are fractions") {
  const auto bytes = hang_triangle<std::uint8_t>({255, 51, 102}, 255);
  CHECK(largest_difference(rest_of(bytes), hung({1, 0.2, 0.4})) < 1e-12);
  const auto shorts = hang_triangle<std::uint16_t>({65535, 13107, 26214}, 65535);
  CHECK(largest_difference(rest_of(shorts), hung({1, 0.2, 0.4})) < 1e-12);
}

TEST_CASE("glTF rotation keys of bytes and shorts are fractions") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  const auto times = buffer.add("SCALAR", {0, 1});
  const bool is_short = GENERATE(true, false);
  // From no turn to half a turn about z.
  const auto turns = is_short ? buffer.add_whole<std::int16_t>("VEC4", {0, 0, 0, 32767, 0, 0, 32767, 0}, true)
                              : buffer.add_whole<std::int8_t>("VEC4", {0, 0, 0, 127, 0, 0, 127, 0}, true);
  const auto file =
      read_gltf_text(buffer.gltf(all_nodes(1) + R"("nodes":[{"mesh":0}],)" + one_mesh(R"("POSITION":0)") +
                                 "," + animation("rotation", times, turns, "LINEAR")));
  std::vector<Eigen::Vector3d> positions;
  file.animate(0, 0, 0.5, positions);
  CHECK(largest_difference(positions, {{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}) < 1e-12);
  file.animate(0, 0, 1, positions);
  CHECK(largest_difference(positions, {{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}}) < 1e-12);
}

TEST_CASE("glTF cubic splines go through their keys by their tangents") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  const auto times = buffer.add("SCALAR", {0, 2});
  // In tangent, value, out tangent of each key. Those at the ends play no part.
  const auto places = buffer.add("VEC3", {9, 9, 9, 1, 0, 0, 0, 3, 0, -1, 0, 0, 5, 0, 8, 9, 9, 9});
  const auto file =
      read_gltf_text(buffer.gltf(all_nodes(1) + R"("nodes":[{"mesh":0}],)" + one_mesh(R"("POSITION":0)") +
                                 "," + animation("translation", times, places, "CUBICSPLINE")));
  CHECK(file.warnings().empty());
  std::vector<Eigen::Vector3d> positions;
  for (const double seconds : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    file.animate(0, 0, seconds, positions);
    // The polynomial of degree 3 with these values and slopes at 0 and 2, from the standard's formula.
    const double t = seconds / 2;
    const Eigen::Vector3d place = (2 * t * t * t - 3 * t * t + 1) * Eigen::Vector3d(1, 0, 0) +
                                  2 * (t * t * t - 2 * t * t + t) * Eigen::Vector3d(0, 3, 0) +
                                  (-2 * t * t * t + 3 * t * t) * Eigen::Vector3d(5, 0, 8) +
                                  2 * (t * t * t - t * t) * Eigen::Vector3d(-1, 0, 0);
    CHECK((positions[0] - place).norm() < 1e-12);
  }
}

TEST_CASE("glTF cubic rotations are mixed by number and normalised") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  const auto times = buffer.add("SCALAR", {0, 1});
  const auto turns =
      buffer.add("VEC4", {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0.5F, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
  const auto file =
      read_gltf_text(buffer.gltf(all_nodes(1) + R"("nodes":[{"mesh":0}],)" + one_mesh(R"("POSITION":0)") +
                                 "," + animation("rotation", times, turns, "CUBICSPLINE")));
  std::vector<Eigen::Vector3d> positions;
  file.animate(0, 0, 0.25, positions);
  const double t = 0.25;
  const double w = 2 * t * t * t - 3 * t * t + 1;
  const double z = 0.5 * (t * t * t - 2 * t * t + t) + (-2 * t * t * t + 3 * t * t);
  const double angle = 2 * std::atan2(z, w);
  CHECK((positions[1] - Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)).norm() < 1e-12);
}

TEST_CASE("glTF morph weights of a node win over its mesh's, for that node alone") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  buffer.add("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  buffer.add("VEC3", {3, 0, 0, 3, 0, 0, 3, 0, 0});
  const std::string mesh_weights = GENERATE("", R"(,"weights":[1,0])");
  const std::string mesh =
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"targets":[{"POSITION":1},{"POSITION":2}]}])" +
      mesh_weights + "}]";
  const auto file = read_gltf_text(
      buffer.gltf(all_nodes(4) +
                  R"("nodes":[{"mesh":0,"weights":[1,0]},{"mesh":0,"weights":[0,1],"translation":[10,0,0]},)"
                  R"({"mesh":0},{"mesh":0,"weights":[0,0]}],)" +
                  mesh));
  REQUIRE(file.objects().size() == 4);
  CHECK(rest_of(file, 0)[0] == Eigen::Vector3d(0, 0, 1));
  CHECK(rest_of(file, 1)[0] == Eigen::Vector3d(13, 0, 0));
  CHECK(rest_of(file, 2)[0] == Eigen::Vector3d(0, 0, mesh_weights.empty() ? 0 : 1));
  CHECK(rest_of(file, 3)[0] == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("glTF morph keys of one node leave other nodes of the mesh alone") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  buffer.add("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1});
  const auto times = buffer.add("SCALAR", {0, 1});
  const auto keys = buffer.add_whole<std::uint8_t>("SCALAR", {0, 255}, true);
  const auto file = read_gltf_text(buffer.gltf(all_nodes(2) + R"("nodes":[{"mesh":0},{"mesh":0}],)" +
                                               one_mesh(R"("POSITION":0)", R"(,"targets":[{"POSITION":1}])") +
                                               "," + animation("weights", times, keys, "LINEAR")));
  CHECK(file.objects()[0].animated);
  CHECK_FALSE(file.objects()[1].animated);
  std::vector<Eigen::Vector3d> positions;
  file.animate(0, 0, 1, positions);
  CHECK(positions[0] == Eigen::Vector3d(0, 0, 1));
  file.animate(1, 0, 1, positions);
  CHECK(positions[0] == Eigen::Vector3d(0, 0, 0));
}

TEST_CASE("sparse glTF accessors replace elements, with and without a view below them") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  buffer.add_sparse("VEC3", 3, {2, 0}, {0, 0, 5, 0, 0, 7});
  const auto file =
      read_gltf_text(buffer.gltf(all_nodes(1) + R"("nodes":[{"mesh":0,"weights":[1]}],)" +
                                 one_mesh(R"("POSITION":0)", R"(,"targets":[{"POSITION":1}])")));
  CHECK(rest_of(file) == std::vector<Eigen::Vector3d>{{0, 0, 7}, {1, 0, 0}, {0, 1, 5}});

  GltfBuffer outside;
  outside.add("VEC3", triangle);
  outside.add_sparse("VEC3", 3, {3}, {0, 0, 5});
  CHECK_THAT(
      refusal_of_gltf(outside.gltf(all_nodes(1) + R"("nodes":[{"mesh":0}],)" +
                                   one_mesh(R"("POSITION":0)", R"(,"targets":[{"POSITION":1}])"))),
      Catch::Matchers::StartsWith("accessors[1].sparse: it replaces an element that is not among the 3"));
}

TEST_CASE("a glTF buffer is found under its percent-decoded name") {
  const TemporaryFolder folder;
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  const std::string members = all_nodes(1) + R"("nodes":[{"mesh":0}],)" + one_mesh(R"("POSITION":0)");
  folder.write("a b+c%\xC3\xA9.bin", buffer.bytes());
  const auto file =
      MeshFile::read(folder.write("encoded.gltf", buffer.gltf(members, "a%20b+c%25%c3%A9.bin")));
  CHECK(rest_of(file)[1] == Eigen::Vector3d(1, 0, 0));
  folder.write("longer.bin", buffer.bytes() + "more");
  CHECK(refusal_of(folder.write("longer.gltf", buffer.gltf(members, "longer.bin"))).empty());
  folder.write("shorter.bin", buffer.bytes().substr(1));
  CHECK_THAT(refusal_of(folder.write("shorter.gltf", buffer.gltf(members, "shorter.bin"))),
             Catch::Matchers::StartsWith("buffers[0]: 36 bytes are announced and 35 are there"));
  CHECK_THAT(refusal_of(folder.write("none.gltf", buffer.gltf(members, "no%20such.bin"))),
             Catch::Matchers::Contains("there is no file") && Catch::Matchers::Contains("no such.bin"));
  CHECK_THAT(refusal_of(folder.write("web.gltf", buffer.gltf(members, "https://example.org/a.bin"))),
             Catch::Matchers::Contains("is no file beside this one"));
}

TEST_CASE("the default scene of a glTF file is read, and a note says so") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  const std::string scenes = R"("scenes":[{"nodes":[0]},{"name":"second","nodes":[1]}],)";
  const std::string nodes = R"("nodes":[{"name":"a","mesh":0},{"name":"b","mesh":0}],)";
  const auto second =
      read_gltf_text(buffer.gltf(R"("scene":1,)" + scenes + nodes + one_mesh(R"("POSITION":0)")));
  REQUIRE(second.objects().size() == 1);
  CHECK(second.objects()[0].name == "b");
  REQUIRE(second.warnings().size() == 1);
  CHECK_THAT(second.warnings()[0],
             Catch::Matchers::EndsWith("scene 1 'second', the default of 2, is read; 1 node with a mesh "
                                       "outside of it left out"));
  const auto first = read_gltf_text(buffer.gltf(scenes + nodes + one_mesh(R"("POSITION":0)")));
  CHECK(first.objects()[0].name == "a");
  const auto all = read_gltf_text(buffer.gltf(nodes + one_mesh(R"("POSITION":0)")));
  CHECK(all.objects().size() == 2);
  CHECK(all.warnings().empty());
}

TEST_CASE("quantised glTF positions are what their integers mean") {
  GltfBuffer buffer;
  buffer.add_whole<std::int16_t>("VEC3", {0, 0, 0, 32767, 0, 0, 0, -32768, 0}, true);
  buffer.add_whole<std::uint8_t>("VEC3", {0, 0, 0, 200, 0, 0, 0, 100, 0}, false);
  const auto file = read_gltf_text(buffer.gltf(
      all_nodes(2) +
      R"("extensionsRequired":["KHR_mesh_quantization"],"nodes":[{"mesh":0,"scale":[0.5,0.5,0.5]},{"mesh":1}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]},{"primitives":[{"attributes":{"POSITION":1}}]}])"));
  CHECK(rest_of(file, 0) == std::vector<Eigen::Vector3d>{{0, 0, 0}, {0.5, 0, 0}, {0, -0.5, 0}});
  CHECK(rest_of(file, 1) == std::vector<Eigen::Vector3d>{{0, 0, 0}, {200, 0, 0}, {0, 100, 0}});
}

TEST_CASE("each instance of a glTF node is an object where its attributes put it") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  buffer.add("VEC3", {0, 0, 0, 0, 0, 5, 0, 0, 9});
  buffer.add("VEC4", {0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1});
  buffer.add("VEC3", {1, 1, 1, 1, 1, 1, -2, 1, 1});
  const auto file = read_gltf_text(buffer.gltf(
      all_nodes(1) +
      R"("extensionsRequired":["EXT_mesh_gpu_instancing"],"nodes":[{"name":"leaf","mesh":0,"translation":[10,0,0],)"
      R"("extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":1,"ROTATION":2,"SCALE":3}}}}],)" +
      one_mesh(R"("POSITION":0)")));
  REQUIRE(file.objects().size() == 3);
  CHECK(file.objects()[0].name == "leaf");
  CHECK(file.objects()[1].name == "leaf#2");
  CHECK(file.objects()[2].name == "leaf#3");
  CHECK(rest_of(file, 0) == std::vector<Eigen::Vector3d>{{10, 0, 0}, {11, 0, 0}, {10, 1, 0}});
  CHECK(rest_of(file, 1) == std::vector<Eigen::Vector3d>{{10, 0, 5}, {9, 0, 5}, {10, -1, 5}});
  CHECK(rest_of(file, 2) == std::vector<Eigen::Vector3d>{{10, 0, 9}, {8, 0, 9}, {10, 1, 9}});
  CHECK(faces_of(*file.objects()[1].mesh) == std::vector<Corners>{{0, 1, 2}});
  CHECK(faces_of(*file.objects()[2].mesh) == std::vector<Corners>{{0, 2, 1}});
}

TEST_CASE("a required glTF extension that is not read is refused by its name") {
  const auto refusal = [](const std::string& name) {
    return refusal_of_gltf(R"({"asset":{"version":"2.0"},"nodes":[],"extensionsRequired":[")" + name +
                           R"("]})");
  };
  CHECK_THAT(
      refusal("KHR_draco_mesh_compression"),
      Catch::Matchers::StartsWith("it requires KHR_draco_mesh_compression (Draco), which is not read"));
  CHECK_THAT(refusal("EXT_meshopt_compression"),
             Catch::Matchers::StartsWith("it requires EXT_meshopt_compression (meshopt), which is not read"));
  CHECK_THAT(refusal("ACME_magic"),
             Catch::Matchers::StartsWith("it requires the extension 'ACME_magic', which is not read"));
  // An extension that concerns looks only is accepted.
  CHECK_THAT(refusal("KHR_texture_transform"), Catch::Matchers::StartsWith("there is no face in it"));
  // Compressed data that is not required has nothing beside it here.
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  CHECK_THAT(refusal_of_gltf(R"({"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},)"
                             R"("extensions":{"KHR_draco_mesh_compression":{}}}]}],)"
                             R"("accessors":[{"componentType":5126,"count":3,"type":"VEC3"}]})"),
             Catch::Matchers::Contains("KHR_draco_mesh_compression (Draco) only"));
}

TEST_CASE("a mirrored glTF skeleton keeps its surface right side out") {
  GltfBuffer buffer;
  buffer.add("VEC3", triangle);
  buffer.add("VEC4", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  buffer.add_joints(std::vector<std::uint8_t>(12, 0));
  const bool is_mirrored = GENERATE(true, false);
  const auto file = read_gltf_text(
      buffer.gltf(all_nodes(1) + R"("nodes":[{"scale":[)" + (is_mirrored ? "-1" : "1") +
                  R"(,1,1],"children":[1,2]},{"mesh":0,"skin":0},{}],"skins":[{"joints":[2]}],)" +
                  one_mesh(R"("POSITION":0,"WEIGHTS_0":1,"JOINTS_0":2)")));
  CHECK(rest_of(file)[1] == Eigen::Vector3d(is_mirrored ? -1 : 1, 0, 0));
  CHECK(faces_of(*file.objects()[0].mesh) ==
        (is_mirrored ? std::vector<Corners>{{0, 2, 1}} : std::vector<Corners>{{0, 1, 2}}));
}

TEST_CASE("glTF strips and fans are wound as the standard says, vertices without a face left out") {
  GltfBuffer buffer;
  buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 5, 5, 5});
  buffer.add_indices({0, 1, 2, 3});
  const std::string members = all_nodes(1) + R"("nodes":[{"mesh":0}],)";
  const auto strip =
      read_gltf_text(buffer.gltf(members + one_mesh(R"("POSITION":0)", R"(,"indices":1,"mode":5)")));
  CHECK(strip.objects()[0].mesh->vertex_count() == 4);
  CHECK(faces_of(*strip.objects()[0].mesh) == std::vector<Corners>{{0, 1, 2}, {2, 1, 3}});
  const auto fan =
      read_gltf_text(buffer.gltf(members + one_mesh(R"("POSITION":0)", R"(,"indices":1,"mode":6)")));
  CHECK(faces_of(*fan.objects()[0].mesh) == std::vector<Corners>{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("glTF nodes that hang below themselves or below two others are refused") {
  const auto refusal = [](const std::string& nodes, const std::string& roots) {
    return refusal_of_gltf(R"({"scenes":[{"nodes":)" + roots + R"(}],"nodes":)" + nodes + "}");
  };
  CHECK_THAT(refusal(R"([{"children":[1]},{"children":[0]}])", "[0]"),
             Catch::Matchers::StartsWith("nodes[0]: it hangs below itself"));
  CHECK_THAT(refusal(R"([{"children":[1]},{"children":[0]}])", "[]"),
             Catch::Matchers::StartsWith("nodes[0]: it hangs below itself"));
  CHECK_THAT(refusal(R"([{"children":[2]},{"children":[2]},{}])", "[0,1]"),
             Catch::Matchers::StartsWith("nodes[2]: it hangs below itself or below two others"));
  CHECK_THAT(refusal(R"([{"children":[7]}])", "[0]"),
             Catch::Matchers::StartsWith("nodes[0]: it names a node that is not among the 1"));
}
