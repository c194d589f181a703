#include <cmath>
#include <graze/io/error.hpp>
#include <graze/io/motion.hpp>

#include "io/import_support.hpp"

using namespace graze::tests;
namespace io = graze::io;

namespace {

const std::array<std::array<float, 9>, 3> frames = {
    {{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 0, 0.1F, 1, 0, 0.2F, 0, 1, NAN}, {-1, 2, 3e30F, 4, 5, 6, 7, 8, 9}}};

graze::Mesh triangle() {
  const std::vector<Eigen::Vector3d> rest = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<std::array<std::uint32_t, 3>> faces = {{0, 1, 2}};
  return graze::Mesh::from_triangles(rest, faces);
}

std::string pc2(std::int32_t vertices, std::int32_t count) {
  std::string bytes("POINTCACHE2\0", 12);
  append<std::int32_t>(bytes, 1);
  append(bytes, vertices);
  append(bytes, 10.0F);
  append(bytes, 0.5F);
  append(bytes, count);
  for (const auto& frame : frames)
    for (const float number : frame) append(bytes, number);
  return bytes;
}

std::string mdd(std::int32_t vertices, std::int32_t count) {
  std::string bytes;
  append(bytes, count, true);
  append(bytes, vertices, true);
  for (int frame = 0; frame < count; ++frame) append(bytes, 0.04F * static_cast<float>(frame), true);
  for (const auto& frame : frames)
    for (const float number : frame) append(bytes, number, true);
  return bytes;
}

void check_frames(io::PositionSource& source) {
  REQUIRE(source.frame_count() == 3);
  std::vector<Eigen::Vector3d> positions(17);
  for (const std::uint32_t frame : {2U, 0U, 1U, 3U, 4000000000U}) {
    source.read(frame, positions);
    REQUIRE(positions.size() == 3);
    for (std::size_t i = 0; i < 9; ++i) {
      const double read = positions[i / 3][static_cast<Eigen::Index>(i % 3)];
      const auto expected = static_cast<double>(frames[std::min(frame, 2U)][i]);
      CHECK((read == expected || (std::isnan(read) && std::isnan(expected))));
    }
  }
}

std::string refusal(const std::filesystem::path& path, const graze::Mesh& mesh) {
  try {
    io::open_vertex_cache(path, mesh);
  } catch (const io::InputError& error) {
    const std::string message = error.what();
    CHECK(message.starts_with(path.string() + ": "));
    return message.substr(path.string().size() + 2);
  }
  return "";
}

std::vector<Eigen::Vector3d> rest_of(const std::filesystem::path& path) {
  const auto file = io::MeshFile::read(path);
  const auto rest = file.objects()[0].mesh->rest();
  return {rest.begin(), rest.end()};
}

}  // namespace

TEST_CASE("PC2 and MDD caches give the floats that were written, past the end the last, and NaN as it is") {
  const TemporaryFolder folder;
  const auto mesh = triangle();
  check_frames(*io::open_vertex_cache(folder.write("a.pc2", pc2(3, 3)), mesh));
  check_frames(*io::open_vertex_cache(folder.write("a.cache", pc2(3, 3)), mesh));
  check_frames(*io::open_vertex_cache(folder.write("a.MDD", mdd(3, 3)), mesh));
}

TEST_CASE("a cache that does not fit its file or its mesh is refused") {
  const TemporaryFolder folder;
  const auto mesh = triangle();
  const std::vector<std::tuple<std::string, std::string, std::string>> table = {
      {"a.pc2", pc2(4, 2), "header: the cache has 4 vertices, the mesh 3"},
      {"a.mdd", mdd(4, 2), "header: the cache has 4 vertices, the mesh 3"},
      {"a.pc2", pc2(3, 4), "header: 4 frames are announced and 3 are there"},
      {"a.pc2", pc2(3, 0x7FFFFFFF), "header: 2147483647 frames are announced and 3 are there"},
      {"a.pc2", pc2(3, 0), "header: there is no frame in it"},
      {"a.pc2", pc2(3, -1), "header: there is no frame in it"},
      {"a.pc2", pc2(-1, 3), "header: the cache has 4294967295 vertices, the mesh 3"},
      {"a.pc2", pc2(3, 3).substr(0, 31), "the PC2 header is cut off"},
      {"a.mdd", mdd(3, 3).substr(0, 7), "the MDD header is cut off"},
      {"a.mdd", mdd(3, 3).substr(0, 90), "header: 3 frames are announced and 1 are there"},
      {"a.mdd", mdd(3, 3).substr(0, 10), "header: 3 frames are announced and 0 are there"},
      {"a.txt", "hello", "this is no vertex cache"},
      {"a.pc2", "", "the file is empty"},
  };
  for (const auto& [name, bytes, message] : table) {
    INFO(message);
    CHECK_THAT(refusal(folder.write(name, bytes), mesh), Catch::Matchers::StartsWith(message));
  }
  CHECK_THAT(refusal(folder / "none.pc2", mesh), Catch::Matchers::StartsWith("there is no such file"));
}

TEST_CASE("a cache written by 3ds Max holds what it exported as OBJ at the same frames") {
  const auto cache_path = shared_file("caches/max_cache_box.pc2");
  if (is_missing(cache_path)) return;
  const auto file = io::MeshFile::read(shared_file("caches/max_cache_box_44.obj"));
  const auto cache = io::open_vertex_cache(cache_path, *file.objects()[0].mesh);
  CHECK(cache->frame_count() == 11);
  // Max numbers the cache's vertices otherwise than the OBJ's and leaves out that the object stands at height
  // 10: one renumbering must fit both frames, to the OBJ's four decimals.
  std::vector<std::size_t> numbers;
  for (const int frame : {44, 48}) {
    const auto exported = rest_of(shared_file("caches/max_cache_box_" + std::to_string(frame) + ".obj"));
    std::vector<Eigen::Vector3d> cached;
    cache->read(static_cast<std::uint32_t>(frame - 40), cached);
    for (auto& position : cached) position.z() += 10;
    if (numbers.empty())
      for (const auto& position : exported)
        numbers.push_back(static_cast<std::size_t>(std::min_element(cached.begin(), cached.end(),
                                                                    [&](const auto& a, const auto& b) {
                                                                      return (a - position).norm() <
                                                                             (b - position).norm();
                                                                    }) -
                                                   cached.begin()));
    CHECK(std::set(numbers.begin(), numbers.end()).size() == 770);
    double largest = 0;
    for (std::size_t i = 0; i < exported.size(); ++i)
      largest = std::max(largest, (exported[i] - cached[numbers[i]]).norm());
    CHECK(largest < 0.003);
  }
}

TEST_CASE("the first sample of the poses is their OBJ") {
  const auto name = GENERATE(as<std::string>(), "poses/cow-poses-2", "poses/wolf-poses-2");
  if (is_missing(shared_file(name + ".pc2"))) return;
  const auto file = io::MeshFile::read(shared_file(name + ".obj"));
  const auto& mesh = *file.objects()[0].mesh;
  const auto cache = io::open_vertex_cache(shared_file(name + ".pc2"), mesh);
  CHECK(cache->frame_count() == (name == "poses/cow-poses-2" ? 7 : 21));
  std::vector<Eigen::Vector3d> positions;
  cache->read(0, positions);
  CHECK(largest_difference(positions, {mesh.rest().begin(), mesh.rest().end()}) < 1e-4);
  cache->read(1, positions);
  CHECK(largest_difference(positions, {mesh.rest().begin(), mesh.rest().end()}) > 0.1);
}
