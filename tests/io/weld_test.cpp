#include "io/import_support.hpp"

using graze::find_oddities;
using graze::io::MeshFile;
using namespace graze::tests;

namespace {

std::string ascii_solid(const std::string& name, const Box& box) {
  std::ostringstream text;
  text << "solid " << name << '\n';
  for (const auto& quad : box.quads)
    for (const std::array<std::size_t, 3> corners : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      text << "facet normal 0 0 0\nouter loop\n";
      for (const auto corner : corners) text << "vertex " << box.positions[quad[corner]].transpose() << '\n';
      text << "endloop\nendfacet\n";
    }
  text << "endsolid " << name << '\n';
  return text.str();
}

std::string binary_solid(const Box& box) {
  std::string bytes(80, ' ');
  append<std::uint32_t>(bytes, 12);
  for (const auto& quad : box.quads)
    for (const std::array<std::size_t, 3> corners : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      bytes.append(12, '\0');
      for (const auto corner : corners)
        for (const double number : box.positions[quad[corner]]) append(bytes, static_cast<float>(number));
      bytes.append(2, '\0');
    }
  return bytes;
}

/// The box's corners in order of first appearance, and its triangles by that order.
void check_box(const graze::Mesh& mesh, const Box& box) {
  std::vector<std::uint32_t> order;
  std::vector<Corners> triangles;
  for (const auto& quad : box.quads)
    for (const std::array<std::size_t, 3> corners : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}}) {
      Corners& triangle = triangles.emplace_back();
      for (const auto corner : corners) {
        const auto place = std::find(order.begin(), order.end(), quad[corner]);
        triangle.push_back(static_cast<std::uint32_t>(place - order.begin()));
        if (place == order.end()) order.push_back(quad[corner]);
      }
    }
  REQUIRE(mesh.vertex_count() == 8);
  for (std::uint32_t i = 0; i < 8; ++i) CHECK(mesh.rest()[i] == box.positions[order[i]]);
  CHECK(faces_of(mesh) == triangles);
  CHECK(find_oddities(mesh).closed_manifold());
}

}  // namespace

TEST_CASE("STL is welded in order of first appearance") {
  const TemporaryFolder folder;
  const Box box = make_box({-1, 0, 0.25}, {1, 2, 0.5});
  SECTION("text") {
    check_box(*MeshFile::read(folder.write("a.stl", ascii_solid("a", box))).objects()[0].mesh, box);
  }
  SECTION("binary") {
    check_box(*MeshFile::read(folder.write("a.STL", binary_solid(box))).objects()[0].mesh, box);
  }
}

TEST_CASE("each solid of an STL file is an object") {
  const TemporaryFolder folder;
  const Box one = make_box({0, 0, 0}, {1, 1, 1});
  const Box two = make_box({1, 0, 0}, {2, 1, 1});
  const auto file =
      MeshFile::read(folder.write("two.stl", ascii_solid("one", one) + ascii_solid("two", two)));
  REQUIRE(file.objects().size() == 2);
  CHECK(file.objects()[0].name == "one");
  CHECK(file.objects()[1].name == "two");
  check_box(*file.objects()[0].mesh, one);
  check_box(*file.objects()[1].mesh, two);
}

TEST_CASE("what is closed in the modeller is closed here") {
  struct Expected {
    std::string file;
    std::uint32_t vertices;
    std::uint32_t faces;
  };
  const auto expected = GENERATE(Expected{"characters/Fox.glb", 290, 576},
                                 Expected{"characters/MorphStressTest.gltf", 1224, 2412},
                                 Expected{"characters/AnimatedMorphSphere.glb", 482, 960});
  const auto path = shared_file(expected.file);
  if (is_missing(path)) return;
  const auto file = MeshFile::read(path);
  REQUIRE(file.objects().size() == 1);
  const auto& object = file.objects()[0];
  CHECK(object.mesh->vertex_count() == expected.vertices);
  CHECK(object.mesh->face_count() == expected.faces);
  CHECK(object.animated);
  CHECK(find_oddities(*object.mesh).closed_manifold());
  std::vector<Eigen::Vector3d> positions;
  for (std::size_t animation = 0; animation < file.animations().size(); ++animation) {
    file.animate(0, animation, 0, positions);
    CHECK(positions.size() == expected.vertices);
  }
}
