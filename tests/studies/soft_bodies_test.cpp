// The comparison of soft bodies: its source of contacts is that of the examples, and its referee counts
// right.

#include <Eigen/Core>
#include <cstddef>
#include <memory>

#include "bench/soft_bodies/soft_body_scenes.hpp"
#include "bench/soft_bodies/soft_body_sources.hpp"
#include "bench/soft_bodies/soft_body_study.hpp"
#include "bench/soft_bodies/vertices_through.hpp"
#include "examples/support/body.hpp"
#include "examples/support/shapes.hpp"
#include "examples/support/world.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

bool is_never_out(const Eigen::Vector3d& /*point*/) {
  return false;
}

bool is_below_zero(const Eigen::Vector3d& point) {
  return point.z() < 0;
}

}  // namespace

TEST_CASE("soft bodies: graze's source gives what the examples' world gives") {
  for (const bench::SoftBodyScene& scene : {bench::cloth_on_ball(), bench::balls_in_tray()}) {
    INFO(scene.name);
    constexpr std::size_t frames = 30;
    bench::SoftBodyRun run(scene);
    const std::unique_ptr<bench::ContactSource> source = bench::graze_source();
    for (std::size_t frame = 0; frame < frames; ++frame) run.frame(*source);
    CHECK(run.figures().contacts > 0);

    examples::World world(scene.settings);
    scene.fill(world);
    for (std::size_t frame = 0; frame < frames; ++frame) {
      scene.lead(world, frame);
      for (int i = 0; i < scene.steps_per_frame; ++i) world.step(bench::frame_time / scene.steps_per_frame);
    }
    for (std::size_t i = 0; i < world.bodies().size(); ++i)
      CHECK(world.bodies()[i].positions == run.world().bodies()[i].positions);
  }
}

TEST_CASE("soft bodies: more steps in a frame leave the substeps as many") {
  const bench::SoftBodyScene scene = bench::balls_in_tray();
  const bench::SoftBodyScene more = bench::with_steps(scene, 10);
  CHECK(more.steps_per_frame == 10);
  CHECK(more.settings.substeps * 10 == scene.settings.substeps * scene.steps_per_frame);
}

TEST_CASE("soft bodies: vertices in a solid or out of the scene are counted once") {
  examples::World world({});
  world.add(examples::fixed_body(examples::floor_box(4, 1)));
  const examples::Shape ball = moved(examples::ball(0.5, 12, 8), {0, 0, 0.3});
  const examples::Body& body = world.add(examples::soft_ball(ball, {0, 0, 0.3}, 1, 1e-4));
  std::size_t below = 0;
  for (const Eigen::Vector3d& point : body.positions) below += point.z() < 0;
  REQUIRE(below > 0);
  CHECK(bench::VerticesThrough(world, is_never_out).count() == below);
  CHECK(bench::VerticesThrough(world, is_below_zero).count() == below);

  world.bodies().back().positions = moved(ball, {0, 0, 5}).points;
  world.bodies().back().positions.emplace_back(0, 0, -3);  // the centre, which belongs to no face
  CHECK(bench::VerticesThrough(world, is_never_out).count() == 0);
  CHECK(bench::VerticesThrough(world, is_below_zero).count() == 1);
}

}  // namespace graze::tests
