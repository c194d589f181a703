#include <graze/error.hpp>
#include <numbers>

#include "io/formats/gltf_builder.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

constexpr float half_turn_cosine = 0.70710678F;  // of 45 degrees, for rotations by 90

/// A rod along y of three cross edges at heights 0, 1 and 2, each vertex given twice as at a seam. The lower
/// joint stands at the origin, the upper at height 1. The middle edge hangs on both by halves.
struct Rod {
  GltfBuffer buffer;
  std::string mesh;
  std::string skin;
};

Rod make_rod() {
  Rod rod;
  std::vector<float> positions;
  std::vector<float> weights;
  std::vector<std::uint8_t> joints;
  for (int copy = 0; copy < 2; ++copy)
    for (int height = 0; height < 3; ++height)
      for (int side = 0; side < 2; ++side) {
        positions.insert(positions.end(), {static_cast<float>(side), static_cast<float>(height), 0.0F});
        const float upper = static_cast<float>(height) / 2;
        weights.insert(weights.end(), {1 - upper, upper, 0, 0});
        joints.insert(joints.end(), {0, 1, 0, 0});
      }
  const auto p = rod.buffer.add("VEC3", positions);
  const auto w = rod.buffer.add("VEC4", weights);
  const auto j = rod.buffer.add_joints(joints);
  const auto i = rod.buffer.add_indices({0, 1, 3, 0, 3, 2, 8, 9, 11, 8, 11, 10});
  rod.mesh = R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(p) + R"(,"WEIGHTS_0":)" +
             std::to_string(w) + R"(,"JOINTS_0":)" + std::to_string(j) + R"(},"indices":)" +
             std::to_string(i) + "}]}";
  // The upper joint's inverse bind matrix takes height 1 to 0.
  const auto m = rod.buffer.add("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                         1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1});
  rod.skin = R"({"inverseBindMatrices":)" + std::to_string(m) + R"(,"joints":[1,2]})";
  return rod;
}

/// The upper joint turns by 90 degrees about z in 2 seconds.
std::string bend(GltfBuffer& buffer, const std::string& interpolation) {
  const auto times = buffer.add("SCALAR", {0, 2});
  const auto turns = buffer.add("VEC4", {0, 0, 0, 1, 0, 0, half_turn_cosine, half_turn_cosine});
  return R"({"name":"bend","channels":[{"sampler":0,"target":{"node":2,"path":"rotation"}}],"samplers":[{"input":)" +
         std::to_string(times) + R"(,"output":)" + std::to_string(turns) + R"(,"interpolation":")" +
         interpolation + R"("}]})";
}

/// Returns the rod's six vertices when the upper joint, at `joint`, is turned by `degrees` about z.
std::vector<Eigen::Vector3d> bent_rod(const Eigen::Vector3d& joint, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  std::vector<Eigen::Vector3d> expected;
  for (int height = 0; height < 3; ++height)
    for (int side = 0; side < 2; ++side) {
      const Eigen::Vector3d lower(side, height, 0);
      const Eigen::Vector3d arm = lower - Eigen::Vector3d(0, 1, 0);
      const Eigen::Vector3d upper =
          joint + Eigen::Vector3d(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                                  std::sin(angle) * arm.x() + std::cos(angle) * arm.y(), 0);
      const double weight = height / 2.0;
      expected.push_back((1 - weight) * lower + weight * upper);
    }
  return expected;
}

std::string scene_members(const std::string& nodes, const std::string& rest) {
  return R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[)" + nodes + "]," + rest;
}

}  // namespace

TEST_CASE("a skinned glTF follows its joints, whatever their names") {
  // Without names, with one name for all, and with proper names. The mesh's own node must not move a skinned
  // mesh.
  const auto names =
      GENERATE(as<std::vector<std::string>>(), std::vector<std::string>{"", "", ""},
               std::vector<std::string>{R"(,"name":"n")", R"(,"name":"n")", R"(,"name":"n")"},
               std::vector<std::string>{R"(,"name":"rod")", R"(,"name":"low")", R"(,"name":"high")"});
  const bool is_binary = GENERATE(false, true);
  Rod rod = make_rod();
  const std::string animation = bend(rod.buffer, "LINEAR");
  const std::string nodes = R"({"children":[1],"mesh":0,"skin":0)" + names[0] + R"(},{"children":[2])" +
                            names[1] + R"(},{"translation":[0,1,0])" + names[2] + "}";
  const std::string members = scene_members(nodes, R"("meshes":[)" + rod.mesh + R"(],"skins":[)" + rod.skin +
                                                       R"(],"animations":[)" + animation + "]");
  const TemporaryFolder folder;
  const auto file = MeshFile::read(is_binary ? folder.write("rod.glb", rod.buffer.glb(members))
                                             : folder.write("rod.gltf", rod.buffer.gltf(members)));
  REQUIRE(file.objects().size() == 1);
  CHECK(file.objects()[0].animated);
  CHECK(file.objects()[0].mesh->vertex_count() == 6);
  REQUIRE(file.animations().size() == 1);
  CHECK(file.animations()[0] == "bend");
  CHECK(file.animation_seconds(0) == Approx(2));
  std::vector<Eigen::Vector3d> positions(3);
  for (const auto& [seconds, degrees] :
       {std::pair(0.0, 0.0), {1.0, 45.0}, {0.5, 22.5}, {2.0, 90.0}, {5.0, 90.0}, {-1.0, 0.0}}) {
    INFO(seconds);
    file.animate(0, 0, seconds, positions);
    CHECK(largest_difference(positions, bent_rod({0, 1, 0}, degrees)) < 1e-6);
  }
  const auto rest = file.objects()[0].mesh->rest();
  CHECK(largest_difference({rest.begin(), rest.end()}, bent_rod({0, 1, 0}, 0)) < 1e-12);
  CHECK_THROWS_AS(file.animate(1, 0, 0, positions), graze::Error);
  CHECK_THROWS_AS(file.animate(0, 1, 0, positions), graze::Error);
  CHECK_THROWS_AS(file.animation_seconds(1), graze::Error);
}

TEST_CASE("glTF steps jump from key to key") {
  Rod rod = make_rod();
  const TemporaryFolder folder;
  const std::string nodes = R"({"children":[1],"mesh":0,"skin":0},{"children":[2]},{"translation":[0,1,0]})";
  const std::string animation = bend(rod.buffer, "STEP");
  const auto file = MeshFile::read(folder.write(
      "step.gltf",
      rod.buffer.gltf(scene_members(nodes, R"("meshes":[)" + rod.mesh + R"(],"skins":[)" + rod.skin +
                                               R"(],"animations":[)" + animation + "]"))));
  CHECK(file.warnings().empty());
  std::vector<Eigen::Vector3d> positions;
  file.animate(0, 0, 1.9, positions);
  CHECK(largest_difference(positions, bent_rod({0, 1, 0}, 0)) < 1e-6);
  file.animate(0, 0, 2, positions);
  CHECK(largest_difference(positions, bent_rod({0, 1, 0}, 90)) < 1e-6);
}

TEST_CASE("glTF morph targets add up by weight, at rest too") {
  GltfBuffer buffer;
  const auto base = buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0});
  const auto lift = buffer.add("VEC3", {0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 4});
  const auto pull = buffer.add("VEC3", {0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0});
  const auto indices = buffer.add_indices({0, 1, 2, 3, 2, 1});
  const auto times = buffer.add("SCALAR", {0, 1, 3});
  const auto weights = buffer.add("SCALAR", {0, 0, 1, 0, 0.5F, 1});
  const std::string mesh = R"({"name":"flap","weights":[0.25,0.5],"primitives":[{"attributes":{"POSITION":)" +
                           std::to_string(base) + R"(},"indices":)" + std::to_string(indices) +
                           R"(,"targets":[{"POSITION":)" + std::to_string(lift) + R"(},{"POSITION":)" +
                           std::to_string(pull) + "}]}]}";
  const std::string animation =
      R"({"channels":[{"sampler":0,"target":{"node":0,"path":"weights"}}],"samplers":[{"input":)" +
      std::to_string(times) + R"(,"output":)" + std::to_string(weights) + "}]}";
  const auto expected = [](double lifted, double pulled) {
    return std::vector<Eigen::Vector3d>{{10, 0, 4 * lifted}, {11 + 2 * pulled, 0, 0}, {10, 1, 2 * pulled}};
  };
  const TemporaryFolder folder;
  // The node's own weights come before its mesh's.
  const bool node_has_weights = GENERATE(false, true);
  const std::string node = R"({"mesh":0,"translation":[10,0,0])" +
                           std::string(node_has_weights ? R"(,"weights":[1,0])" : "") + "}";
  const auto file = MeshFile::read(folder.write(
      "flap.gltf",
      buffer.gltf(scene_members(node, R"("meshes":[)" + mesh + R"(],"animations":[)" + animation + "]"))));
  CHECK(file.objects()[0].name == "flap");
  const auto rest = file.objects()[0].mesh->rest();
  REQUIRE(rest.size() == 3);
  CHECK(largest_difference({rest.begin(), rest.end()},
                           node_has_weights ? expected(1, 0) : expected(0.25, 0.5)) < 1e-6);
  std::vector<Eigen::Vector3d> positions;
  file.animate(0, 0, 0.5, positions);
  CHECK(largest_difference(positions, expected(0.5, 0)) < 1e-6);
  file.animate(0, 0, 2, positions);
  CHECK(largest_difference(positions, expected(0.75, 0.5)) < 1e-6);
}

TEST_CASE("vertices in one place that morph apart stay apart") {
  GltfBuffer buffer;
  const auto base = buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0});
  const auto lift = buffer.add("VEC3", {0, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, -4});
  const auto indices = buffer.add_indices({0, 1, 2, 3, 2, 1});
  const std::string mesh = R"({"primitives":[{"attributes":{"POSITION":)" + std::to_string(base) +
                           R"(},"indices":)" + std::to_string(indices) + R"(,"targets":[{"POSITION":)" +
                           std::to_string(lift) + "}]}]}";
  const TemporaryFolder folder;
  const auto file = MeshFile::read(
      folder.write("slit.gltf", buffer.gltf(scene_members(R"({"mesh":0})", R"("meshes":[)" + mesh + "]"))));
  CHECK(file.objects()[0].mesh->vertex_count() == 4);
}

TEST_CASE("glTF nodes place, name and move their meshes; primitives of one mesh are one object") {
  GltfBuffer buffer;
  const Box box = make_box({-1, -1, -1}, {1, 1, 1});
  std::vector<float> positions;
  for (const auto& p : box.positions)
    for (const double x : p) positions.push_back(static_cast<float>(x));
  const auto p = std::to_string(buffer.add("VEC3", positions));
  std::vector<std::uint16_t> half[2];
  for (std::size_t i = 0; i < 6; ++i)
    for (const std::size_t corner : {0U, 1U, 2U, 0U, 2U, 3U})
      half[i / 3].push_back(static_cast<std::uint16_t>(box.quads[i][corner]));
  const std::string mesh = R"({"name":"cube","primitives":[{"attributes":{"POSITION":)" + p +
                           R"(},"indices":)" + std::to_string(buffer.add_indices(half[0])) +
                           R"(},{"attributes":{"POSITION":)" + p + R"(},"indices":)" +
                           std::to_string(buffer.add_indices(half[1])) +
                           R"(},{"mode":0,"attributes":{"POSITION":)" + p + "}}]}";
  const auto times = std::to_string(buffer.add("SCALAR", {1, 2}));
  const auto moves = std::to_string(buffer.add("VEC3", {0, 0, 0, 0, 0, 8}));
  const std::string animation =
      R"({"channels":[{"sampler":0,"target":{"node":1,"path":"translation"}}],"samplers":[{"input":)" +
      times + R"(,"output":)" + moves + "}]}";
  // Node 0 turns by 90 degrees about z and scales by 2. Node 1 is moved below it. Node 2 stands apart.
  const std::string nodes =
      R"({"children":[1],"scale":[2,2,2],"rotation":[0,0,0.70710678118654752,0.70710678118654752]},)"
      R"({"name":"moved","mesh":0,"translation":[3,0,0]},{"name":"moved","mesh":0})";
  const std::string members = R"("scene":0,"scenes":[{"nodes":[0,2]}],"nodes":[)" + nodes +
                              R"(],"meshes":[)" + mesh + R"(],"animations":[)" + animation + "]";
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("cubes.gltf", buffer.gltf(members)));
  REQUIRE(file.objects().size() == 2);
  CHECK(file.objects()[0].name == "moved");
  CHECK(file.objects()[1].name == "moved#2");
  CHECK(file.objects()[0].animated);
  CHECK_FALSE(file.objects()[1].animated);
  REQUIRE(file.warnings().size() == 1);
  CHECK_THAT(file.warnings()[0], Catch::Matchers::Contains("16 points, lines"));
  std::vector<Eigen::Vector3d> placed;
  std::vector<Eigen::Vector3d> moving;
  for (const auto& corner : box.positions) {
    placed.emplace_back(-2 * corner.y(), 2 * (corner.x() + 3), 2 * corner.z());
    moving.emplace_back(-2 * corner.y(), 2 * corner.x(), 2 * (corner.z() + 4));
  }
  for (const auto& object : file.objects()) {
    CHECK(object.mesh->vertex_count() == 8);
    CHECK(object.mesh->face_count() == 12);
    CHECK(graze::find_oddities(*object.mesh).closed_manifold());
  }
  const auto rest = file.objects()[0].mesh->rest();
  CHECK(largest_difference({rest.begin(), rest.end()}, placed) < 1e-6);
  const auto still = file.objects()[1].mesh->rest();
  CHECK(std::vector(still.begin(), still.end()) == box.positions);
  std::vector<Eigen::Vector3d> animated;
  file.animate(0, 0, 1.5, animated);
  CHECK(largest_difference(animated, moving) < 1e-6);
  file.animate(1, 0, 1.5, animated);
  CHECK(animated == box.positions);
}

TEST_CASE("glTF faces that name no vertex are refused") {
  GltfBuffer buffer;
  const auto p = buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto i = buffer.add_indices({0, 1, 2, 0, 1, 3});
  const std::string members =
      scene_members(R"({"mesh":0})", R"("meshes":[{"name":"leaf","primitives":[{"attributes":{"POSITION":)" +
                                         std::to_string(p) + R"(},"indices":)" + std::to_string(i) + "}]}]");
  const TemporaryFolder folder;
  CHECK_THAT(
      refusal_of(folder.write("leaf.gltf", buffer.gltf(members))),
      Catch::Matchers::StartsWith("meshes[0] ('leaf').primitives[0]: only 1 of its 2 faces name vertices"));
}

TEST_CASE("a mirrored glTF node keeps its surface right side out") {
  GltfBuffer buffer;
  const auto p = buffer.add("VEC3", {0, 0, 0, 1, 0, 0, 0, 1, 0});
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write(
      "mirror.gltf", buffer.gltf(scene_members(R"({"mesh":0,"scale":[-1,1,1]})",
                                               R"("meshes":[{"primitives":[{"attributes":{"POSITION":)" +
                                                   std::to_string(p) + "}}]}]"))));
  CHECK(faces_of(*file.objects()[0].mesh) == std::vector<Corners>{{0, 2, 1}});
  CHECK(file.objects()[0].mesh->rest()[1] == Eigen::Vector3d(-1, 0, 0));
}

TEST_CASE("a glTF skin without bind matrices has the identity") {
  Rod rod = make_rod();
  const std::string nodes = R"({"children":[1],"mesh":0,"skin":0},{"children":[2]},{"translation":[0,1,0]})";
  const std::string animation = bend(rod.buffer, "LINEAR");
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write(
      "rod.gltf",
      rod.buffer.gltf(scene_members(nodes, R"("meshes":[)" + rod.mesh + R"(],"skins":[{"joints":[1,2]}])" +
                                               R"(,"animations":[)" + animation + "]"))));
  // Each joint carries the vertices as they are, the upper one a unit higher.
  std::vector<Eigen::Vector3d> expected;
  for (int height = 0; height < 3; ++height)
    for (int side = 0; side < 2; ++side) expected.emplace_back(side, height + height / 2.0, 0);
  std::vector<Eigen::Vector3d> positions;
  file.animate(0, 0, 0, positions);
  CHECK(largest_difference(positions, expected) < 1e-6);
}

TEST_CASE("glTF accessors that do not fit their use are refused") {
  Rod rod = make_rod();
  const auto keys = std::to_string(rod.buffer.add("SCALAR", {0, 1}));
  const auto none = std::to_string(rod.buffer.add("SCALAR", {}));
  const auto three = std::to_string(rod.buffer.add("VEC3", {0, 0, 0, 0, 0, 0, 0, 0, 0}));
  const auto bytes = std::to_string(rod.buffer.add_joints({255, 0, 0, 0, 255, 0, 0, 0}));
  const auto far_joints = std::to_string(rod.buffer.add_joints(std::vector<std::uint8_t>(48, 7)));
  const std::string mesh = R"("meshes":[)" + rod.mesh + "]";
  const auto sampler = [](const std::string& input, const std::string& output,
                          const std::string& interpolation) {
    return R"("animations":[{"channels":[{"sampler":0,"target":{"node":2,"path":"translation"}}],"samplers":[{"input":)" +
           input + R"(,"output":)" + output + R"(,"interpolation":")" + interpolation + R"("}]}])";
  };
  const auto primitive = [](const std::string& inside) {
    return R"("skins":[{"joints":[1]}],"meshes":[{"primitives":[{)" + inside + "}]}]";
  };
  const std::vector<std::pair<std::string, std::string>> table = {
      {mesh + R"(,"skins":[{"joints":[1,2,0],"inverseBindMatrices":4}])",
       "skins[0]: there are fewer inverse bind matrices"},
      {mesh + R"(,"skins":[{"joints":[1,9]}])", "skins[0]: joint 1 is no node of the file"},
      {mesh, "meshes[0]: its skin does not exist"},
      {sampler(none, three, "LINEAR"),
       "animations[0].samplers[0]: there are fewer values than keys, or no keys"},
      {sampler(three, keys, "LINEAR"), "animations[0].samplers[0]: there are fewer values than keys"},
      {sampler(keys, three, "CUBICSPLINE"), "animations[0].samplers[0]: there are fewer values than keys"},
      {sampler(keys, bytes, "LINEAR"),
       "animations[0].samplers[0].output: expected an accessor of VEC3, got 'VEC4'"},
      {primitive(R"("attributes":{"POSITION":)" + bytes + "}"),
       "meshes[0].primitives[0].attributes.POSITION: expected an accessor of VEC3, got 'VEC4'"},
      {primitive(R"("attributes":{"POSITION":77})"),
       "meshes[0].primitives[0].attributes.POSITION: its accessor does not exist"},
      {primitive(R"("attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":)" + bytes + "}"),
       "meshes[0].primitives[0].attributes.WEIGHTS_0: there is not one set of joints and weights a vertex"},
      {primitive(R"("attributes":{"POSITION":0,"JOINTS_0":)" + far_joints + R"(,"WEIGHTS_0":1})"),
       "meshes[0].primitives[0].attributes.WEIGHTS_0: vertex 0 (counted from 0) hangs on a joint"},
      {primitive(R"("attributes":{"POSITION":0},"targets":[{"POSITION":)" + three + "}]"),
       "meshes[0].primitives[0].targets[0].POSITION: the target has another number of vertices"},
  };
  const std::string nodes = R"({"children":[1],"mesh":0,"skin":0},{"children":[2]},{})";
  const TemporaryFolder folder;
  for (const auto& [members, message] : table) {
    INFO(members);
    CHECK_THAT(refusal_of(folder.write("bad.gltf", rod.buffer.gltf(scene_members(nodes, members)))),
               Catch::Matchers::StartsWith(message));
  }
}
