// set_positions: what it takes, that it copies, and what it does not read.

#include <limits>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

double distance_of(const ReportHandle& report) {
  const PairReport& pair = only_pair(*report);
  CHECK(pair.distance.lower == pair.distance.upper);
  return pair.distance.upper;
}

/// A triangle above (0, 0), with vertices that no face uses before and after it.
std::shared_ptr<const Mesh> mesh_with_unused_vertices() {
  const Positions rest = {{nothing, 0, 0}, {0, 0, 0}, {0, 0.5, 1}, {0.5, 0, 1}, {0, nothing, 0}};
  const std::vector<std::array<std::uint32_t, 3>> faces = {{1, 2, 3}};
  return std::make_shared<const Mesh>(Mesh::from_triangles(rest, faces));
}

}  // namespace

TEST_CASE("an object stands at its rest shape until told otherwise") {
  Scene scene(settings_of(0.5, 4));
  const auto mesh = plate_mesh();
  scene.add(mesh);
  const auto high = std::make_shared<const Mesh>(
      Mesh::from_quads(lifted(*mesh, 3), std::vector<std::array<std::uint32_t, 4>>{{0, 1, 2, 3}}));
  scene.add(high);
  CHECK(distance_of(scene.step()) == 3);
  CHECK(distance_of(scene.step()) == 3);
}

TEST_CASE("positions come as float or double, packed or strided") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  const auto mesh = needle_mesh();
  double height = 1;
  const auto told = [&](auto&& give) {
    height += 0.5;
    give(lifted(*mesh, height));
    CHECK(distance_of(pair.scene.step()) == height);
  };
  const ObjectId needle = pair.needle;
  told([&](const Positions& p) { pair.scene.set_positions(needle, p); });
  told([&](const Positions& p) { pair.scene.set_positions(needle, std::span(p)); });
  told([&](const Positions& p) {
    const std::array<Eigen::Vector3d, 3> points = {p[0], p[1], p[2]};
    pair.scene.set_positions(needle, points);
  });
  told([&](const Positions& p) {
    std::vector<Eigen::Vector3f> points;
    for (const auto& point : p) points.emplace_back(point.cast<float>());
    pair.scene.set_positions(needle, points);
  });
  told([&](const Positions& p) {
    std::vector<std::array<float, 3>> points;
    for (const auto& point : p)
      points.push_back(
          {static_cast<float>(point.x()), static_cast<float>(point.y()), static_cast<float>(point.z())});
    pair.scene.set_positions(needle, points);
  });
  told([&](const Positions& p) {
    std::vector<std::array<double, 3>> points;
    for (const auto& point : p) points.push_back({point.x(), point.y(), point.z()});
    pair.scene.set_positions(needle, points);
  });
  told([&](const Positions& p) {
    std::vector<double> numbers(5 * p.size(), nothing);
    for (std::size_t i = 0; i < p.size(); ++i)
      for (int axis = 0; axis < 3; ++axis) numbers[5 * i + 1 + static_cast<std::size_t>(axis)] = p[i][axis];
    pair.scene.set_positions(needle, PositionView(&numbers[1], p.size(), 5 * sizeof(double)));
  });
  told([&](const Positions& p) {
    std::vector<float> numbers(4 * p.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < p.size(); ++i)
      for (int axis = 0; axis < 3; ++axis)
        numbers[4 * i + static_cast<std::size_t>(axis)] = static_cast<float>(p[i][axis]);
    pair.scene.set_positions(needle, PositionView(numbers.data(), p.size(), 4 * sizeof(float)));
  });
}

TEST_CASE("set_positions copies, and the last of several calls counts") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  {
    Positions positions = lifted(*needle_mesh(), 2);
    pair.scene.set_positions(pair.needle, positions);
    for (auto& position : positions) position.setConstant(nothing);
  }
  CHECK(distance_of(pair.scene.step()) == 2);
  pair.lift(7);
  pair.lift(5);
  pair.lift(3);
  CHECK(distance_of(pair.scene.step()) == 3);
  CHECK(distance_of(pair.scene.step()) == 3);
}

TEST_CASE("what a view holds beside a used vertex is never read") {
  Scene scene(settings_of(0.5, 100));
  scene.add(plate_mesh());
  const auto mesh = mesh_with_unused_vertices();
  const ObjectId object = scene.add(mesh);
  CHECK(distance_of(scene.step()) == 0);
  Positions positions = lifted(*mesh, 2);
  scene.set_positions(object, positions, 2);
  const ReportHandle copied = scene.step();
  CHECK(copied->diagnostics().empty());
  CHECK(distance_of(copied) == 2);
  positions[0].setConstant(std::numeric_limits<double>::infinity());
  for (auto& position : positions) position.z() += 1;
  scene.bind_positions(object, positions);
  const ReportHandle bound = scene.step();
  CHECK(bound->diagnostics().empty());
  CHECK(distance_of(bound) == 3);
  CHECK(bound->pairs()[0].witness.feature_b == Feature{FeatureKind::vertex, 1});
}

TEST_CASE("a promise that is kept says nothing, one that is broken is a diagnostic") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  const auto tell = [&](double height, double promise) {
    pair.scene.set_positions(pair.needle, lifted(*needle_mesh(), height), promise);
    return pair.scene.step();
  };
  CHECK(tell(2, 2)->diagnostics().empty());
  CHECK(tell(2, 0)->diagnostics().empty());
  CHECK(tell(1, 1)->diagnostics().empty());
  const ReportHandle broken = tell(3, 1.5);
  REQUIRE(kinds_of(*broken) == std::vector{DiagnosticKind::broken_promise});
  CHECK(broken->diagnostics()[0].object == pair.needle);
  CHECK(distance_of(broken) == 3);
  CHECK(pair.scene.step()->diagnostics().empty());

  // A promise that is no distance counts as none.
  for (const double promise : {-1.0, nothing}) {
    const ReportHandle report = tell(promise < 0 ? 5 : 6, promise);
    REQUIRE(report->diagnostics().size() == 1);
    CHECK(report->diagnostics()[0].object == pair.needle);
    CHECK(distance_of(report) == (promise < 0 ? 5 : 6));
  }
}

TEST_CASE("a promise is about where the last step saw the vertices") {
  NeedleOverPlate pair(settings_of(0.5, 100));
  pair.step_at(2);
  // On the way to where it is read the needle is told to be elsewhere. That is not seen.
  pair.lift(50);
  pair.scene.set_positions(pair.needle, lifted(*needle_mesh(), 2.5), 0.5);
  const ReportHandle report = pair.scene.step();
  CHECK(report->diagnostics().empty());
  CHECK(distance_of(report) == 2.5);
}

}  // namespace graze::tests
