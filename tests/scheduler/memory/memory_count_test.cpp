// This test compares the memory in a step's statistics with the memory that the allocator has given.

#include <array>
#include <cmath>
#include <iostream>
#include <optional>

#include "scheduler/memory/allocation_count.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

double counted_bytes(const StepStatistics& statistics) {
  return static_cast<double>(statistics.bytes.total());
}

/// Objects of one mesh that are moved at random about each other for some steps. On one thread: what oneTBB
/// takes is not counted.
struct Crowd {
  const char* name;
  models::MeshData mesh;
  std::size_t count;
  double spacing;
  SceneSettings settings;
  std::size_t copies = 1;  ///< of each one's positions that wait for a step
};

/// Compares what the allocator gave since it had given `before` with what is counted.
void check_counted(const StepStatistics& statistics, std::uint64_t before) {
  const auto in_use = static_cast<double>(AllocationCount::held_bytes() - before);
  const double counted = counted_bytes(statistics);
  std::cout << "compared " << in_use / 1000 << " kB that are held with " << counted / 1000 << " kB counted\n";
  CHECK(counted > 0.9 * in_use);
  CHECK(counted < 1.1 * in_use);
}

/// In motion, at rest, when a step repeats what the last one counted, and when more is asked for then.
void check_crowd(const Crowd& crowd) {
  const auto mesh = mesh_of(crowd.mesh);
  std::vector<ObjectId> ids(crowd.count);
  Positions positions(mesh->vertex_count());
  std::array<ReportHandle, 3> held;
  oracle::Random random(11);
  const std::uint64_t before = AllocationCount::held_bytes();
  Scene scene(crowd.settings);
  for (ObjectId& id : ids) id = scene.add(mesh);
  const auto side = static_cast<std::size_t>(std::ceil(std::cbrt(crowd.count)));
  for (std::size_t frame = 0; frame < 12; ++frame) {
    for (std::size_t i = 0; i < crowd.count; ++i) {
      Eigen::Vector3d at(static_cast<double>(i % side), static_cast<double>(i / side % side),
                         static_cast<double>(i / side / side));
      for (int axis = 0; axis < 3; ++axis) at[axis] = crowd.spacing * (at[axis] + random.between(-0.1, 0.1));
      for (std::size_t vertex = 0; vertex < positions.size(); ++vertex)
        positions[vertex] = mesh->rest()[vertex] + at;
      for (std::size_t copy = 0; copy < crowd.copies; ++copy) scene.set_positions(ids[i], positions);
    }
    held[frame % held.size()] = scene.step();
  }
  const StepStatistics& statistics = held[11 % held.size()]->statistics();
  CHECK(statistics.pairs_in_contact > 0);
  check_counted(statistics, before);
  for (std::size_t frame = 0; frame < 6; ++frame) held[frame % held.size()] = scene.step();
  CHECK(held[2]->statistics().pairs_tested == 0);
  check_counted(held[2]->statistics(), before);
  SceneCapacity capacity;
  capacity.near_pairs = 20'000;
  capacity.contacts = 100'000;
  scene.reserve(capacity);
  held[0] = scene.step();
  CHECK(counted_bytes(held[0]->statistics()) > counted_bytes(held[2]->statistics()) + 1e6);
  check_counted(held[0]->statistics(), before);
}

}  // namespace

TEST_CASE("memory: what is counted is what the allocator gave, within a tenth") {
  if (!AllocationCount::is_possible()) {
    std::cout << "skipped: the allocator cannot be asked here\n";
    return;
  }
  const auto settings = [](ContactDetail detail, std::size_t region_distances) {
    SceneSettings made = settings_of(0.05, 0.2, detail);
    made.threads = 1;
    made.region_distances = region_distances;
    return made;
  };
  for (const Crowd& crowd :
       {Crowd{"300 spheres", models::sphere(10, 8), 300, 1.9, settings(ContactDetail::features, 0)},
        Crowd{"2,000 boxes", models::box({1, 1, 1}), 2000, 1.1, settings(ContactDetail::closest, 0)},
        Crowd{"60 tori with distances of regions", models::torus(), 60, 1.5,
              settings(ContactDetail::vertices, 50'000)},
        Crowd{"30 spheres with copies that waited", models::sphere(60, 40), 30, 1.95,
              settings(ContactDetail::closest, 0), 4},
        Crowd{"two large spheres", models::sphere(100, 60), 2, 0.05,
              settings(ContactDetail::features, 100'000)}}) {
    INFO(crowd.name);
    check_crowd(crowd);
  }
}

}  // namespace graze::tests
