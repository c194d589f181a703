// bind_positions: memory that is read where it is, when it should be, and never after it was given back.

#include <algorithm>
#include <limits>

#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// The needle's own memory. It is given back when it ends, so that a sanitizer sees a late read.
struct Memory {
  explicit Memory(double height) : points(lifted(*needle_mesh(), height)) {}
  void lift(double height) {
    const Positions now = lifted(*needle_mesh(), height);
    std::copy(now.begin(), now.end(), points.begin());
  }
  Positions points;
};

double distance_after_step(NeedleOverPlate& pair) {
  const ReportHandle report = pair.scene.step();
  CHECK(report->diagnostics().empty());
  return only_pair(*report).distance.upper;
}

SceneSettings wide() {
  return settings_of(0.5, 100);
}

}  // namespace

TEST_CASE("bound memory is read in every step") {
  NeedleOverPlate pair(wide());
  Memory memory(2);
  pair.scene.bind_positions(pair.needle, memory.points);
  memory.lift(3);  // between the call and the step: the memory counts, not what it held
  CHECK(distance_after_step(pair) == 3);
  for (const double height : {4.0, 4.0, 0.25, 9.0}) {
    memory.lift(height);
    CHECK(distance_after_step(pair) == height);
  }
}

TEST_CASE("bound floats with a stride are read in every step") {
  struct Particle {
    float mass = 1;
    std::array<float, 3> position{};
  };
  NeedleOverPlate pair(wide());
  const auto mesh = needle_mesh();
  std::vector<Particle> particles(3);
  pair.scene.bind_positions(pair.needle,
                            PositionView(particles[0].position.data(), particles.size(), sizeof(Particle)));
  for (const double height : {1.0, 5.0, 0.5}) {
    const Positions at = lifted(*mesh, height);
    for (std::size_t i = 0; i < 3; ++i)
      particles[i].position = {static_cast<float>(at[i].x()), static_cast<float>(at[i].y()),
                               static_cast<float>(at[i].z())};
    CHECK(distance_after_step(pair) == height);
  }
}

TEST_CASE("memory bound when told is read in the next step, and then when told") {
  NeedleOverPlate pair(wide());
  Memory memory(2);
  pair.scene.bind_positions(pair.needle, memory.points, BindPolicy::when_told);
  CHECK(distance_after_step(pair) == 2);
  memory.lift(3);
  CHECK(distance_after_step(pair) == 2);
  pair.scene.positions_changed(pair.needle);
  CHECK(distance_after_step(pair) == 3);
  memory.lift(4);
  CHECK(distance_after_step(pair) == 3);
  CHECK(distance_after_step(pair) == 3);
  pair.scene.positions_changed(pair.needle, 1);
  CHECK(distance_after_step(pair) == 4);
  for (auto& point : memory.points) point.setConstant(std::numeric_limits<double>::quiet_NaN());
  CHECK(distance_after_step(pair) == 4);
}

TEST_CASE("promises about bound memory are checked") {
  NeedleOverPlate pair(wide());
  Memory memory(2);
  for (const BindPolicy policy : {BindPolicy::every_step, BindPolicy::when_told}) {
    memory.lift(2);
    pair.scene.bind_positions(pair.needle, memory.points, policy);
    pair.scene.step();
    memory.lift(2.5);
    pair.scene.positions_changed(pair.needle, 0.5);
    CHECK(distance_after_step(pair) == 2.5);
    memory.lift(4);
    pair.scene.positions_changed(pair.needle, 1);
    const ReportHandle report = pair.scene.step();
    REQUIRE(kinds_of(*report) == std::vector{DiagnosticKind::broken_promise});
    CHECK(report->diagnostics()[0].object == pair.needle);
    CHECK(only_pair(*report).distance.upper == 4);
    // A promise is about one step only.
    memory.lift(9);
    if (policy == BindPolicy::when_told) pair.scene.positions_changed(pair.needle);
    CHECK(distance_after_step(pair) == 9);
    pair.scene.positions_changed(pair.needle, -1);
    CHECK(pair.scene.step()->diagnostics().size() == 1);
  }
}

TEST_CASE("of set_positions and bind_positions the later counts") {
  NeedleOverPlate pair(wide());
  Memory memory(2);
  SECTION("bound, then copied before any step") {
    pair.scene.bind_positions(pair.needle, memory.points);
    pair.lift(5);
    CHECK(distance_after_step(pair) == 5);
    memory.lift(3);
    CHECK(distance_after_step(pair) == 5);
  }
  SECTION("bound and read, then copied") {
    pair.scene.bind_positions(pair.needle, memory.points);
    CHECK(distance_after_step(pair) == 2);
    pair.lift(5);
    memory.points.clear();
    memory.points.shrink_to_fit();
    CHECK(distance_after_step(pair) == 5);
    CHECK(distance_after_step(pair) == 5);
    pair.scene.positions_changed(pair.needle, 0);
    CHECK(distance_after_step(pair) == 5);
  }
  SECTION("copied, then bound before any step") {
    pair.lift(5);
    pair.scene.bind_positions(pair.needle, memory.points);
    CHECK(distance_after_step(pair) == 2);
  }
  SECTION("a copy that is refused leaves the memory bound") {
    pair.scene.bind_positions(pair.needle, memory.points);
    Positions bad = memory.points;
    bad[1].x() = std::numeric_limits<double>::infinity();
    pair.scene.set_positions(pair.needle, bad);
    CHECK(kinds_of(*pair.scene.step()) == std::vector{DiagnosticKind::not_finite});
    memory.lift(3);
    CHECK(distance_after_step(pair) == 3);
  }
  SECTION("a binding that is refused leaves the one before") {
    pair.scene.bind_positions(pair.needle, memory.points);
    pair.scene.bind_positions(pair.needle, PositionView(memory.points[0].data(), 2));
    CHECK(kinds_of(*pair.scene.step()) == std::vector{DiagnosticKind::wrong_count});
    memory.lift(3);
    CHECK(distance_after_step(pair) == 3);
  }
}

TEST_CASE("memory is given back by unbinding, rebinding and removing") {
  NeedleOverPlate pair(wide());
  auto memory = std::make_unique<Memory>(2);
  pair.scene.bind_positions(pair.needle, memory->points);
  CHECK(distance_after_step(pair) == 2);
  const auto unbind_at = [&](double height) {
    memory->lift(height);
    pair.scene.unbind_positions(pair.needle);
    memory.reset();
  };
  SECTION("unbound: the object keeps what the memory says at the call") {
    unbind_at(7);
    CHECK(distance_after_step(pair) == 7);
    pair.scene.positions_changed(pair.needle);
    CHECK(distance_after_step(pair) == 7);
    CHECK(distance_after_step(pair) == 7);
    pair.scene.unbind_positions(pair.needle);
    CHECK(distance_after_step(pair) == 7);
    CHECK(pair.step_at(4)->pairs()[0].distance.upper == 4);
  }
  SECTION("bound to other memory") {
    const Memory other(6);
    pair.scene.bind_positions(pair.needle, other.points);
    memory.reset();
    CHECK(distance_after_step(pair) == 6);
  }
  SECTION("bound and unbound between two steps: read once, by the last call") {
    pair.scene.unbind_positions(pair.needle);
    CHECK(distance_after_step(pair) == 2);
    memory->lift(8);
    pair.scene.bind_positions(pair.needle, memory->points);
    unbind_at(9);
    CHECK(distance_after_step(pair) == 9);
  }
  SECTION("memory that is read when told keeps what was read of it last") {
    pair.scene.bind_positions(pair.needle, memory->points, BindPolicy::when_told);
    CHECK(distance_after_step(pair) == 2);
    unbind_at(8);
    CHECK(distance_after_step(pair) == 2);
  }
  SECTION("memory that is read when told keeps what it was told of last, also before a step") {
    pair.scene.bind_positions(pair.needle, memory->points, BindPolicy::when_told);
    CHECK(distance_after_step(pair) == 2);
    memory->lift(8);
    pair.scene.positions_changed(pair.needle);
    CHECK(distance_after_step(pair) == 8);
    memory->lift(5);
    pair.scene.positions_changed(pair.needle, 3);
    unbind_at(6);
    CHECK(distance_after_step(pair) == 6);
    CHECK(distance_after_step(pair) == 6);
  }
  SECTION("memory that is read when told, and bad when it is told of, freezes by the call") {
    pair.scene.bind_positions(pair.needle, memory->points, BindPolicy::when_told);
    CHECK(distance_after_step(pair) == 2);
    memory->points[0].setConstant(std::numeric_limits<double>::quiet_NaN());
    pair.scene.positions_changed(pair.needle);
    pair.scene.unbind_positions(pair.needle);
    memory.reset();
    CHECK(kinds_of(*pair.scene.step()) == std::vector{DiagnosticKind::not_finite});
    CHECK(only_pair(*pair.scene.latest_report()).stale);
    CHECK(pair.step_at(4)->pairs()[0].distance.upper == 4);
  }
  SECTION("memory that would be read when told is read by the call where no step has begun") {
    pair.scene.bind_positions(pair.needle, memory->points, BindPolicy::when_told);
    unbind_at(8);
    CHECK(distance_after_step(pair) == 8);
  }
  SECTION("copied positions and later bindings take its place, so that unbinding does not read it") {
    pair.lift(3);
    memory.reset();
    pair.scene.unbind_positions(pair.needle);
    CHECK(distance_after_step(pair) == 3);
  }
  SECTION("removed") {
    pair.scene.remove(pair.needle);
    memory.reset();
    CHECK(pair.scene.step()->pairs().empty());
  }
}

TEST_CASE("unbinding what was never bound says nothing") {
  NeedleOverPlate pair(wide());
  pair.lift(3);
  pair.scene.unbind_positions(pair.needle);
  CHECK(distance_after_step(pair) == 3);
}

}  // namespace graze::tests
