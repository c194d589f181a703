// Which files reading opens: Player::files, and files outside the folder of the mesh file that names them.

#include <algorithm>
#include <graze/io/error.hpp>
#include <graze/io/motion.hpp>
#include <graze/io/player.hpp>

#include "io/formats/gltf_builder.hpp"

namespace {

namespace fs = std::filesystem;
namespace io = graze::io;
using Catch::Matchers::Contains;
using namespace graze::tests;

const std::string obj_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

struct Triangle {
  GltfBuffer buffer;
  std::string members;

  Triangle() {
    const auto positions = buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
    members =
        R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":)" +
        std::to_string(positions) + "}}]}]";
  }
  [[nodiscard]] std::string gltf(const std::string& uri) const { return buffer.gltf(members, uri); }
};

/// A triangle of glTF 1, which assimp reads.
std::string gltf_1(const std::string& uri) {
  return R"({"asset":{"version":"1.0"},"scene":"s","scenes":{"s":{"nodes":["n"]}},"nodes":{"n":{"meshes":["m"]}},
    "meshes":{"m":{"primitives":[{"attributes":{"POSITION":"a"},"mode":4}]}},
    "accessors":{"a":{"bufferView":"v","byteOffset":0,"componentType":5126,"count":3,"type":"VEC3"}},
    "bufferViews":{"v":{"buffer":"b","byteOffset":0,"byteLength":36,"target":34962}},
    "buffers":{"b":{"byteLength":36,"type":"arraybuffer","uri":")" +
         uri + "\"}}}";
}

/// The folder `scene` for a mesh file, with a folder below it. Outside of it lies a buffer.
struct Folders {
  TemporaryFolder folder;
  Triangle triangle;

  Folders() {
    fs::create_directories(folder / "scene/below");
    folder.write("outside.bin", triangle.buffer.bytes());
    folder.write("scene/beside.bin", triangle.buffer.bytes());
    folder.write("scene/below/b.bin", triangle.buffer.bytes());
    fs::create_symlink(folder / "outside.bin", folder / "scene/link.bin");
    fs::create_symlink(folder / "scene/beside.bin", folder / "scene/inner.bin");
  }
};

std::vector<std::string> names_of(const io::Player& player) {
  std::vector<std::string> names;
  for (const fs::path& file : player.files()) names.push_back(file.filename().string());
  std::ranges::sort(names);
  return names;
}

}  // namespace

TEST_CASE("buffers of glTF outside its folder are refused, unless they are asked for") {
  const Folders folders;
  const fs::path file = folders.folder / "scene/mesh.gltf";
  const std::string absolute = (folders.folder / "outside.bin").string();
  for (const std::string& uri : {std::string("../outside.bin"), absolute, std::string("link.bin"),
                                 std::string("below/../../outside.bin"), std::string("%2E%2E/outside.bin"),
                                 std::string("../none.bin")}) {
    INFO(uri);
    folders.folder.write("scene/mesh.gltf", folders.triangle.gltf(uri));
    CHECK_THAT(refusal_of(file),
               Contains("buffers[0]: ") && Contains("is outside the folder of this file; put it there"));
    if (uri != "../none.bin") CHECK_NOTHROW(io::MeshFile::read(file, {.outside_files = true}));
  }
  for (const std::string uri :
       {"beside.bin", "./beside.bin", "below/b.bin", "below/../beside.bin", "inner.bin"}) {
    INFO(uri);
    folders.folder.write("scene/mesh.gltf", folders.triangle.gltf(uri));
    CHECK(refusal_of(file) == "");
  }
}

TEST_CASE("a mesh file that is a link may be anywhere, and its name counts") {
  const Folders folders;
  folders.folder.write("scene/mesh.gltf", folders.triangle.gltf("outside.bin"));
  fs::create_symlink(folders.folder / "scene/mesh.gltf", folders.folder / "mesh.gltf");
  CHECK(refusal_of(folders.folder / "mesh.gltf") == "");
}

TEST_CASE("files that assimp would open outside the folder are refused likewise") {
  const Folders folders;
  const AssimpLeaks leaks;
  const fs::path file = folders.folder / "scene/mesh.gltf";
  folders.folder.write("scene/mesh.gltf", gltf_1("beside.bin"));
  CHECK(refusal_of(file) == "");
  folders.folder.write("scene/mesh.gltf", gltf_1("../outside.bin"));
  CHECK_THAT(refusal_of(file), Contains("is outside the folder of this file"));
  CHECK_NOTHROW(io::MeshFile::read(file, {.outside_files = true}));
}

TEST_CASE("a scene file may allow files outside the folders of its meshes") {
  const Folders folders;
  folders.folder.write("scene/mesh.gltf", folders.triangle.gltf("../outside.bin"));
  const auto scene = [&](const std::string& keys) {
    return io::read_scene_file(folders.folder.write(
        "scene.json", R"({"graze": 1, )" + keys + R"("objects": [{"mesh": "scene/mesh.gltf"}]})"));
  };
  CHECK_THROWS_AS(io::Player(scene("")), io::InputError);
  CHECK_THROWS_AS(io::Player(scene(R"("outside_files": false, )")), io::InputError);
  CHECK(io::Player(scene(R"("outside_files": true, )")).objects().size() == 1);
  CHECK_THROWS_AS(scene(R"("outside_files": 1, )"), io::InputError);
}

TEST_CASE("a player names every file that it reads, now or later") {
  const Folders folders;
  const TemporaryFolder& folder = folders.folder;
  folder.write("scene/mesh.gltf", folders.triangle.gltf("beside.bin"));
  folder.write("a.obj", obj_triangle);
  std::string cache("POINTCACHE2\0", 12);
  for (const std::uint32_t number : {1U, 3U, 0U, 0U, 2U}) append(cache, number);
  cache += std::string(2 * 36, '\0');
  folder.write("c.pc2", cache);
  for (const std::string number : {"1", "2", "10"}) folder.write("seq_" + number + ".obj", obj_triangle);
  for (const std::string number : {"1", "2"}) {
    folder.write("buffer" + number + ".bin", folders.triangle.buffer.bytes());
    folder.write("frame_" + number + ".gltf", folders.triangle.gltf("buffer" + number + ".bin"));
  }
  const auto scene = folder.write("scene.json", R"({"graze": 1, "objects": [{"mesh": "scene/mesh.gltf"},
    {"mesh": "a.obj", "positions": "c.pc2"}, {"mesh": "a.obj", "positions": "seq_#.obj"},
    {"mesh": "a.obj", "positions": "frame_#.gltf"}]})");
  const io::Player player(io::read_scene_file(scene));
  CHECK(names_of(player) == std::vector<std::string>{"a.obj", "beside.bin", "buffer1.bin", "buffer2.bin",
                                                     "c.pc2", "frame_1.gltf", "frame_2.gltf", "mesh.gltf",
                                                     "seq_1.obj", "seq_10.obj", "seq_2.obj"});
}

TEST_CASE("a player names the files that assimp opens") {
  const Folders folders;
  const AssimpLeaks leaks;
  folders.folder.write("scene/mesh.gltf", gltf_1("beside.bin"));
  const io::Player player(io::scene_of_meshes({folders.folder / "scene/mesh.gltf"}));
  CHECK(names_of(player) == std::vector<std::string>{"beside.bin", "mesh.gltf"});
}
