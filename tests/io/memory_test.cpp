// A program of its own, since it replaces the allocator: files are read while memory runs out.

#include <graze/io/error.hpp>
#include <graze/io/player.hpp>

#include "io/formats/gltf_builder.hpp"
#include "scheduler/memory/failing_allocator.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

/// Does `work` while each of its allocations fails in turn. Each time `work` is done, or refuses `path` for
/// lack of memory.
template <typename Work>
void check_failures(const std::filesystem::path& path, const Work& work) {
  FailingAllocator::begin(FailingAllocator::never, FailingAllocator::Lack::once);
  work();
  const std::uint64_t count = FailingAllocator::end();
  REQUIRE(count > 20);
  std::size_t refused = 0;
  for (std::uint64_t place = 0; place < count; place += 1 + count / 200) {
    std::string message;
    FailingAllocator::begin(place, FailingAllocator::Lack::once);
    try {
      work();
    } catch (const io::InputError& error) {
      FailingAllocator::end();
      message = error.what();
    }
    FailingAllocator::end();
    if (message.empty()) continue;
    ++refused;
    INFO("place " << place);
    CHECK_THAT(message, Catch::Matchers::StartsWith(path.string()) &&
                            Catch::Matchers::Contains("there is not enough memory for it; split it"));
  }
  CHECK(refused > 20);
}

}  // namespace

// Files of JSON are left out: nlohmann-json allocates in a destructor, which ends the program when it fails.
TEST_CASE("a mesh file for which memory runs out is refused by its name, with a remedy") {
  const TemporaryFolder folder;
  const auto path =
      folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\ng b\nf 1 2 4 3 2\n");
  check_failures(path, [&] { io::MeshFile::read(path); });
}

TEST_CASE("a scene for which memory runs out is refused by a name, with a remedy") {
  const TemporaryFolder folder;
  auto scene = io::scene_of_meshes({folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")});
  // The mesh's name comes first where reading it fails, otherwise the scene's.
  scene.file = folder.path().string();
  check_failures(folder.path(), [&] { io::Player player(scene); });
}

TEST_CASE("equal names and picked objects take memory in proportion to how many there are") {
  const TemporaryFolder folder;
  const auto allocations = [&](std::size_t count) {
    GltfBuffer buffer;
    const auto p = std::to_string(buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0}));
    std::string nodes, objects;
    for (std::size_t i = 0; i < count; ++i) {
      nodes += std::string(i == 0 ? "" : ",") + R"({"mesh":0,"name":"n"})";
      objects += std::string(i == 0 ? "" : ",") + R"({"mesh":"names.gltf","node":)" + std::to_string(i) + "}";
    }
    folder.write("names.gltf",
                 buffer.gltf(R"("nodes":[)" + nodes +
                             R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":)" + p + "}}]}]"));
    const auto path = folder.write("scene.json", R"({"graze":1,"objects":[)" + objects + "]}");
    FailingAllocator::begin(FailingAllocator::never, FailingAllocator::Lack::once);
    io::Player(io::read_scene_file(path));
    return static_cast<double>(FailingAllocator::end());
  };
  CHECK(allocations(1600) < 2.5 * allocations(800));
}
