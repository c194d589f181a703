#include "io/formats/fbx_morph.hpp"
#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

TEST_CASE("FBX morph targets move by their keys, and those without keys stay off") {
  const TemporaryFolder folder;
  const auto file = [&] {
    const AssimpLeaks leaks;
    return MeshFile::read(folder.write("flap.fbx", fbx_morph));
  }();
  REQUIRE(file.objects().size() == 1);
  CHECK(file.objects()[0].name == "flap");
  CHECK(file.objects()[0].animated);
  CHECK(faces_of(*file.objects()[0].mesh) == std::vector<Corners>{{0, 1, 2, 3}});
  const auto expected = [](double height) {
    return std::vector<Eigen::Vector3d>{{10, 0, height}, {11, 0, 0}, {11, 1, 0}, {10, 1, 0}};
  };
  const auto rest = file.objects()[0].mesh->rest();
  CHECK(largest_difference({rest.begin(), rest.end()}, expected(0)) < 1e-12);
  REQUIRE(file.animations().size() == 1);
  CHECK(file.animations()[0] == "Take");
  CHECK(file.animation_seconds(0) == Approx(2));
  std::vector<Eigen::Vector3d> positions;
  for (const double seconds : {0.0, 0.5, 1.0, 2.0}) {
    file.animate(0, 0, seconds, positions);
    CHECK(largest_difference(positions, expected(2 * seconds)) < 1e-6);
  }
}

TEST_CASE("FBX quads stay quads and are welded into closed boxes with their node's place") {
  const auto path = assimp_model("FBX/cubes_with_names.fbx");
  if (is_missing(path)) return;
  const auto file = MeshFile::read(path);
  REQUIRE(file.objects().size() == 4);
  std::set<std::string> names;
  for (const auto& object : file.objects()) {
    names.insert(object.name);
    for (const auto& face : faces_of(*object.mesh)) CHECK(face.size() == 4);
    CHECK(graze::find_oddities(*object.mesh).closed_manifold());
  }
  CHECK(names.size() == 4);
}
