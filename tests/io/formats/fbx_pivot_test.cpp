// FBX nodes and joints with everything that their transforms are made of, at rest and animated.

#include <random>

#include "io/formats/fbx_builder.hpp"
#include "io/import_support.hpp"

using graze::io::MeshFile;
using namespace graze::tests;

namespace {

using Vector = Eigen::Vector3d;

void check_places(const FbxFile& wanted) {
  const TemporaryFolder folder;
  const auto file = MeshFile::read(folder.write("arm.fbx", wanted.text()));
  REQUIRE(file.objects().size() == 1);
  const auto rest = file.objects()[0].mesh->rest();
  CHECK(largest_difference({rest.begin(), rest.end()}, wanted.expected(std::nullopt)) < 1e-4);
  std::vector<Vector> positions;
  for (const int key : {0, 1}) {
    file.animate(0, 0, key, positions);
    CHECK(largest_difference(positions, wanted.expected(key)) < 1e-4);
  }
}

FbxNode arm_node() {
  FbxNode node;
  node.name = "arm";
  node.translation = {1, 2, 3};
  node.rotation = {10, 20, 30};
  return node;
}

const FbxNode::Keys turning = {{{10, 20, 30}, {40, 50, 60}}};

class RandomNodes {
 public:
  explicit RandomNodes(unsigned seed) : random_(seed) {}

  Vector vector(double most) {
    std::uniform_real_distribution<double> number(-most, most);
    return {number(random_), number(random_), number(random_)};
  }
  bool flips() { return random_() % 2 == 0; }

  /// Any of the properties may be there, and any may be animated.
  FbxNode node() {
    FbxNode node = arm_node();
    node.rotation_order = static_cast<int>(random_() % 6);
    if (flips()) node.translation = vector(2);
    if (flips()) node.rotation = vector(60);
    if (flips()) node.scale = Vector(1.5, 1.5, 1.5) + vector(0.5);
    if (flips()) node.pre_rotation = vector(90);
    if (flips()) node.post_rotation = vector(90);
    if (flips()) node.translation_keys = {vector(2), vector(2)};
    if (flips()) node.rotation_keys = {vector(60), vector(60)};
    if (flips()) node.scale_keys = {Vector(2, 2, 2) + vector(1), Vector(2, 2, 2) + vector(1)};
    return node;
  }

  void add_pivots(FbxNode& node) {
    if (flips()) node.rotation_offset = vector(1);
    if (flips()) node.rotation_pivot = vector(1);
    if (flips()) node.scaling_offset = vector(1);
    if (flips()) node.scaling_pivot = vector(1);
  }

 private:
  std::mt19937 random_;
};

}  // namespace

TEST_CASE("FBX pre-rotations and post-rotations of animated nodes are applied once") {
  FbxFile file{{arm_node()}, {}};
  FbxNode& node = file.nodes[0];
  node.rotation_keys = turning;
  SECTION("neither") {}
  SECTION("a pre-rotation") {
    node.pre_rotation = {30, 40, 50};
  }
  SECTION("a post-rotation") {
    node.post_rotation = {15, 25, 35};
  }
  SECTION("both, in another order of rotation") {
    node.pre_rotation = {30, 40, 50};
    node.post_rotation = {15, 25, 35};
    node.rotation_order = 5;
  }
  SECTION("a pre-rotation of a node that stands at the origin") {
    node.pre_rotation = {-90, 0, 0};
    node.translation = node.rotation = Vector::Zero();
  }
  SECTION("a pre-rotation where only the translation moves") {
    node.pre_rotation = {30, 40, 50};
    node.rotation_keys.reset();
    node.translation_keys = {{{1, 2, 3}, {4, 5, 6}}};
  }
  SECTION("a pre-rotation and a rotation pivot") {
    node.pre_rotation = {30, 40, 50};
    node.rotation_pivot = {1, 1, 0};
  }
  check_places(file);
}

TEST_CASE("FBX nodes that mirror have their post-rotation applied once") {
  const auto scale = GENERATE(Vector(-1, 1, 1), Vector(1, -2, -1), Vector(-1, -1, -2));
  FbxFile file{{arm_node()}, {}};
  FbxNode& node = file.nodes[0];
  node.scale = scale;
  node.rotation_keys = turning;
  node.pre_rotation = {30, 40, 50};
  node.post_rotation = {15, 25, 35};
  check_places(file);
}

TEST_CASE("FBX transforms follow the formula of the FBX SDK, whatever properties are there") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    RandomNodes random(seed);
    FbxFile file{{random.node(), random.node()}, {}};
    file.nodes[0].name = "above";
    file.nodes[0].is_joint = true;
    file.nodes[1].parent = 0;
    if (seed % 3 == 1) random.add_pivots(file.nodes[0]);
    if (seed % 3 == 1) random.add_pivots(file.nodes[1]);
    if (seed % 3 == 2) {
      file.nodes[1].rotation_order = 0;  // assimp turns the geometric rotation in this order, too
      file.nodes[1].geometric_translation = random.vector(1);
      file.nodes[1].geometric_rotation = random.vector(90);
      file.nodes[1].geometric_scale = Vector(2, 2, 2) + random.vector(1);
    }
    check_places(file);
  }
}

TEST_CASE("FBX skins follow joints with pre-rotations and post-rotations") {
  for (unsigned seed = 0; seed < 30; ++seed) {
    INFO("seed " << seed);
    RandomNodes random(seed + 1000);
    FbxFile file;
    for (int i = 0; i < 3; ++i) {
      file.nodes.push_back(random.node());
      file.nodes.back().name = "joint" + std::to_string(i);
      file.nodes.back().is_joint = true;
      file.nodes.back().parent = i - 1;
    }
    file.nodes.push_back(random.node());
    FbxNode& mesh = file.nodes.back();
    mesh.translation_keys = mesh.rotation_keys = mesh.scale_keys = std::nullopt;
    if (random.flips()) mesh.geometric_translation = random.vector(1);
    file.weights = {{0.5, 0.25, 0, 1}, {0.25, 0.25, 1, 0}, {0.25, 0.5, 0, 0}};
    check_places(file);
  }
}
