// A repeated query takes no memory once it has answered at the same positions before. A scene whose reports
// keep geometry or patches takes none either, nor do queries of its reports and patches.

#include <array>
#include <cmath>
#include <graze/graze.hpp>
#include <iostream>
#include <utility>
#include <vector>

#include "scheduler/memory/allocation_count.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

constexpr int frames_of_period = 12;

/// Returns the positions of a body in each frame. It goes into another body and out again.
std::vector<Positions> period_of(const Mesh& mesh) {
  std::vector<Positions> frames;
  for (int frame = 0; frame < frames_of_period; ++frame) {
    const double phase = 2 * 3.14159265358979 * frame / frames_of_period;
    frames.push_back(moved(mesh.rest(), {2 + std::cos(phase), 0.1, 0.2}));
  }
  return frames;
}

}  // namespace

TEST_CASE("after one period a repeated query takes no memory, at every detail") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto mesh = mesh_of(models::sphere(16, 8));
  const std::vector<Positions> frames = period_of(*mesh);
  for (const ContactDetail detail : all_details) {
    RepeatedQuery repeated(*mesh, *mesh,
                           {.contact_distance = 0.1,
                            .range = 0.5,
                            .detail = detail,
                            .a_is_solid = true,
                            .b_is_solid = true,
                            .ways_out = true});
    std::size_t in_contact = 0;
    for (const Positions& now : frames) in_contact += repeated.ask(mesh->rest(), now).in_contact;
    CHECK(in_contact > 0);
    CHECK(in_contact < frames.size());
    AllocationCount::begin();
    for (int period = 0; period < 3; ++period)
      for (const Positions& now : frames) repeated.ask(mesh->rest(), now);
    AllocationCount::end();
    INFO("detail " << name_of(detail) << ": " << AllocationCount::first_of_others());
    CHECK(AllocationCount::by_others() == 0);
  }
}

TEST_CASE("steps that keep geometry, and queries of it, take no memory after one period") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto mesh = mesh_of(models::sphere(16, 8));
  const std::vector<Positions> frames = period_of(*mesh);
  Scene scene({.contact_distance = 0.1, .threads = 1});
  const ObjectId body = scene.add(mesh, {.queries = true});
  scene.add(mesh, {.motion = Motion::fixed, .queries = true});
  MeshProbe probe(mesh);
  SceneQuery query;
  ReportHandle held;
  std::size_t answers = 0;
  const auto play = [&] {
    for (const Positions& now : frames) {
      scene.set_positions(body, now);
      held = query.report();
      query.set_report(scene.step());
      std::array<RayHit, 4> hits;
      std::array<ObjectId, 2> objects;
      answers += query.cast_ray({-5, 0.1, 0.2}, {1, 0, 0}, 20, hits);
      answers += query.cast_sphere({-5, 0.1, 0.2}, {5, 0, 0}, 0.5).has_value();
      answers += query.closest_point({0, 5, 0}).has_value();
      answers += query.blocking(probe, 0.1, objects);
      answers += query.objects_in_box({0, 0, 0}, {1, 1, 1}, objects);
    }
  };
  play();
  play();
  REQUIRE(answers > 2 * frames.size());
  AllocationCount::begin();
  play();
  AllocationCount::end();
  INFO(AllocationCount::first_of_others());
  CHECK(AllocationCount::by_others() == 0);
}

TEST_CASE("steps that keep patches, and answers of patches, take no memory after one period") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto mesh = mesh_of(models::sphere(24, 14));
  const std::vector<Positions> frames = period_of(*mesh);
  for (const bool solid : {false, true}) {
    Scene scene({.contact_distance = 0.1, .threads = 1});
    const ObjectId body = scene.add(mesh, {.solid = solid});
    const ObjectId floor = scene.add(mesh_of(models::sheet(20, 20, 6, 6)), {.motion = Motion::rigid});
    const ObjectId tool =
        scene.add(mesh_of(models::sphere(8, 4)), {.motion = Motion::rigid, .patch_radius = 0.5});
    PatchRoom room;
    ReportHandle held;
    std::size_t contacts = 0;
    std::size_t faces = 0;
    const auto ask = [&](int periods) {
      for (int period = 0; period < periods; ++period)
        for (const Positions& now : frames) {
          scene.set_positions(body, now);
          scene.set_pose(floor, lift_pose(-0.75 + 0.01 * now[0].x()));
          const ReportHandle before = std::exchange(held, scene.step());
          if (before) before->patch(tool).contacts(lift_pose(0.1), 0.2, room);
          contacts += room.contacts().size();
          faces += held->patch(tool).face_count();
        }
    };
    ask(3);
    REQUIRE(contacts > 100);
    REQUIRE(faces > 1000);
    AllocationCount::begin();
    ask(2);
    AllocationCount::end();
    INFO(AllocationCount::first_of_others());
    CHECK(AllocationCount::by_others() == 0);
  }
}

}  // namespace graze::tests
