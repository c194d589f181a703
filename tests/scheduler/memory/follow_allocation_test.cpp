// follow() takes no memory between two steps, once a step has listed the nearest contacts of the two meshes.

#include <graze/graze.hpp>
#include <iostream>
#include <vector>

#include "scheduler/memory/allocation_count.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"

namespace graze::tests {

TEST_CASE("follow takes no memory after a step") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be replaced here\n";
    return;
  }
  const auto mesh = mesh_of(models::sphere(24, 16));
  const Positions still(mesh->rest().begin(), mesh->rest().end());
  Scene scene({.contact_distance = 0.1, .detail = ContactDetail::nearest});
  const ObjectId a = scene.add(mesh, {.solid = true});
  const ObjectId b = scene.add(mesh, {.solid = true});
  scene.set_positions(a, still);
  scene.set_positions(b, moved(mesh->rest(), {1.95, 0.1, 0.2}));
  const ReportHandle report = scene.step();
  REQUIRE(report->contacts().size() > 20);

  const Positions now = moved(mesh->rest(), {1.92, 0.2, 0.15});
  unsigned steps = 0;
  std::size_t known = 0;
  AllocationCount::begin();
  for (const Contact& contact : report->contacts()) {
    const FollowedContact found = follow(*mesh, still, *mesh, now, contact);
    const FollowedContact other = follow_vertex_of_b(*mesh, still, *mesh, now, contact);
    steps += found.steps + other.steps;
    known += found.is_known ? 1U : 0U;
  }
  AllocationCount::end();
  INFO(AllocationCount::first_of_others());
  CHECK(AllocationCount::by_others() == 0);
  CHECK(steps > 20);
  CHECK(known > 20);
}

}  // namespace graze::tests
