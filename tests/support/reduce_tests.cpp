// The reducer, set on judges that find fault for a reason that is known.

#include <cmath>
#include <limits>
#include <set>

#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"
#include "support/reduce.hpp"

namespace graze::tests {
namespace {

using oracle::Shape;

TwoShapes scene_of(std::uint64_t seed) {
  const oracle::RandomScene scene = oracle::random_scene(seed);
  return {scene.a, scene.b, scene.threshold};
}

/// The vertices that faces use.
std::set<std::uint32_t> used(const Shape& shape) {
  std::set<std::uint32_t> vertices;
  for (const auto& face : shape.faces) vertices.insert(face.begin(), face.end());
  return vertices;
}

double nearest_vertices(const TwoShapes& scene) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const std::uint32_t i : used(scene.a))
    for (const std::uint32_t j : used(scene.b))
      nearest = std::min(nearest, (scene.a.positions[i] - scene.b.positions[j]).norm());
  return nearest;
}

std::size_t quad_count(const Shape& shape) {
  std::size_t count = 0;
  for (const auto& face : shape.faces) count += face.size() == 4 ? 1U : 0U;
  return count;
}

/// A library that says something wrong as soon as two vertices are nearer than 0.5.
std::string near_vertices(const TwoShapes& scene) {
  return nearest_vertices(scene) < 0.5 ? "vertices: " + std::to_string(nearest_vertices(scene)) + " apart\n"
                                       : "";
}

}  // namespace

TEST_CASE("a scene is reduced to one face a shape where nothing more is needed") {
  std::size_t reduced_count = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const TwoShapes scene = scene_of(seed);
    if (near_vertices(scene).empty()) continue;
    const TwoShapes small = reduced(scene, near_vertices);
    INFO("seed " << seed << "\n" << text_of(small));
    REQUIRE_FALSE(near_vertices(small).empty());
    for (const Shape& shape : {small.a, small.b}) {
      CHECK(shape.faces.size() == 1);
      CHECK(shape.faces[0].size() == 3);
      CHECK(shape.positions.size() == used(shape).size());
      for (const Eigen::Vector3d& position : shape.positions) CHECK(position == Eigen::Vector3d::Zero());
    }
    CHECK(small.threshold == 0);
    ++reduced_count;
  }
  CHECK(reduced_count > 10);
}

TEST_CASE("nothing of a reduced scene can be dropped") {
  // A quad of a, and a vertex of b between 0.3 and 0.7 from the nearest one of a.
  const Judge judge = [](const TwoShapes& scene) -> std::string {
    const double nearest = nearest_vertices(scene);
    return quad_count(scene.a) > 0 && nearest > 0.3 && nearest < 0.7 ? "fault" : "";
  };
  std::size_t reduced_count = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    if (judge(scene_of(seed)).empty()) continue;
    const TwoShapes small = reduced(scene_of(seed), judge);
    INFO("seed " << seed << "\n" << text_of(small));
    REQUIRE(judge(small) == "fault");
    CHECK(small.a.faces.size() + small.b.faces.size() <= 3);
    for (const auto part : {&TwoShapes::a, &TwoShapes::b}) {
      CHECK((small.*part).positions.size() == used(small.*part).size());
      for (std::size_t face = 0; face < (small.*part).faces.size() && (small.*part).faces.size() > 1;
           ++face) {
        TwoShapes less = small;
        (less.*part).faces.erase((less.*part).faces.begin() + static_cast<std::ptrdiff_t>(face));
        CHECK(judge(less).empty());
      }
      for (std::size_t vertex = 0; vertex < (small.*part).positions.size(); ++vertex)
        for (const Eigen::Index axis : {0, 1, 2}) {
          const double number = (small.*part).positions[vertex][axis];
          CHECK(std::set<double>{0, 0.25, 0.5, 0.75, 1, 1.5, 2}.contains(std::abs(number)));
          TwoShapes less = small;
          (less.*part).positions[vertex][axis] = 0;
          CHECK((number == 0 || judge(less).empty()));
        }
    }
    ++reduced_count;
  }
  CHECK(reduced_count > 10);
}

TEST_CASE("a reduced scene is wrong in the way that the whole was") {
  // Far apart the fault is another one. A careless reducer would slip into it.
  const Judge judge = [](const TwoShapes& scene) -> std::string {
    return nearest_vertices(scene) < 0.25 ? "near: 1.5e-3 instead of 2" : "far: 7";
  };
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const std::string before = judge(scene_of(seed));
    CHECK(judge(reduced(scene_of(seed), judge)) == before);
  }
}

TEST_CASE("a scene without fault comes back as it is") {
  const TwoShapes scene = scene_of(3);
  CHECK(text_of(reduced(scene, [](const TwoShapes&) { return std::string(); })) == text_of(scene));
  CHECK(reduced_text(scene, [](const TwoShapes&) { return std::string(); }).empty());
}

TEST_CASE("the text of a scene is C++ with every number as it is") {
  const double none = std::nan("");
  const TwoShapes scene{{{{0, -0.5, 0.1}, {1e300, 2, 3}, {none, none, none}}, {{0, 1, 1}}},
                        {{{1, 0, 0}}, {{0, 0, 0, 0}, {0, 0, 0}}},
                        0.25};
  CHECK(text_of(scene) ==
        "const oracle::Shape a = {{{0, -0.5, 0.1}, {1e+300, 2, 3}, {std::nan(\"\"), std::nan(\"\"), "
        "std::nan(\"\")}},\n    {{0, 1, 1}}};\n"
        "const oracle::Shape b = {{{1, 0, 0}},\n    {{0, 0, 0, 0}, {0, 0, 0}}};\n"
        "const double threshold = 0.25;\n");
}

}  // namespace graze::tests
