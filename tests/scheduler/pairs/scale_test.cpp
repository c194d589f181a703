// Work and memory of the pairs follow the objects and those that are near, not all n(n-1)/2: by count, not by
// time.

#include <cmath>
#include <iostream>
#include <memory>
#include <vector>

#include "broad_phase/broad_phase.hpp"
#include "scheduler/report_text.hpp"
#include "scheduler/scene_support.hpp"
#include "support/catch.hpp"
#include "support/random/random_scenes.hpp"

namespace graze::tests {
namespace {

struct IgnoringNone final : IgnoredPairs {
  [[nodiscard]] bool is_empty() const override { return true; }
  [[nodiscard]] bool contains(const Serials&) const override { return false; }
  [[nodiscard]] std::optional<std::span<const Serials>> changed() const override {
    return std::span<const Serials>();
  }
};

/// Makes the box of the i-th of n objects.
using Layout = Box (*)(oracle::Random& random, std::size_t i, std::size_t n);

Box cube(const Eigen::Vector3d& centre, double half) {
  Box box;
  box.add(Eigen::Vector3d(centre.array() - half));
  box.add(Eigen::Vector3d(centre.array() + half));
  return box;
}

Eigen::Vector3d random_point(oracle::Random& random, double size) {
  return {random.between(0, size), random.between(0, size), random.between(0, size)};
}

Box in_space(oracle::Random& random, std::size_t, std::size_t n) {
  return cube(random_point(random, 3 * std::cbrt(static_cast<double>(n))), 0.5);
}

Box in_a_plane(oracle::Random& random, std::size_t, std::size_t n) {
  const double size = 3 * std::sqrt(static_cast<double>(n));
  return cube({random.between(0, size), random.between(0, size), random.between(0, 0.01)}, 0.5);
}

/// Every object a thousandth as dense and a tenth as large as those of the ball before.
Box in_clusters(oracle::Random& random, std::size_t i, std::size_t n) {
  const double scale = std::pow(10.0, -static_cast<double>(i % 6));
  const double size = 3 * std::cbrt(static_cast<double>(n) / 6);
  const Eigen::Vector3d corner(1e7 * static_cast<double>(i % 6), 0, 0);
  return cube(corner + scale * random_point(random, size), 0.5 * scale);
}

/// Pebbles on a planet, and a few that are as far away as can be.
Box on_a_planet(oracle::Random& random, std::size_t i, std::size_t n) {
  if (i == 0) return cube(Eigen::Vector3d::Zero(), 1e6);
  if (i < 4) return cube(random_point(random, 0x1p119), 0x1p100);
  return in_a_plane(random, i, n);
}

struct Work {
  double tests_of_object = 0;
  double pairs_of_object = 0;
  double bytes_of_object = 0;
};

/// Twenty steps in which every object drifts by a part of its size.
Work work_of(Layout layout, std::size_t n) {
  oracle::Random random(n);
  std::vector<std::unique_ptr<Object>> objects;
  for (std::size_t i = 0; i < n; ++i) {
    objects.push_back(std::make_unique<Object>());
    objects.back()->serial = i;
    objects.back()->box = layout(random, i, n);
  }
  TaskPool tasks(1, ArenaPolicy::own);
  ObjectSummaries summaries;
  BroadPhase broad_phase;
  Work work;
  constexpr int steps = 20;
  for (int step = 0; step < steps; ++step) {
    for (const auto& object : objects) {
      const double size = (object->box.max - object->box.min).maxCoeff();
      const Eigen::Vector3d by = 0.03 * size * random_point(random, 1);
      object->box.min += by;
      object->box.max += by;
    }
    summaries.refresh(objects, tasks);
    work.pairs_of_object +=
        static_cast<double>(broad_phase.find(summaries, {}, IgnoringNone(), tasks).size());
    work.tests_of_object += static_cast<double>(broad_phase.counters().boxes_tested);
  }
  const auto count = static_cast<double>(n);
  work.tests_of_object /= steps * count;
  work.pairs_of_object /= steps * count;
  work.bytes_of_object = static_cast<double>(summaries.byte_count() + broad_phase.byte_count()) / count;
  return work;
}

}  // namespace

TEST_CASE("tests and memory of an object stay the same from 1,000 to 16,000 objects") {
  for (const Layout layout : {in_space, in_a_plane, in_clusters, on_a_planet}) {
    const Work few = work_of(layout, 1000);
    const Work many = work_of(layout, 16000);
    std::cout << "tests of an object in a step: " << few.tests_of_object << " and " << many.tests_of_object
              << ", pairs " << few.pairs_of_object << " and " << many.pairs_of_object << ", bytes "
              << few.bytes_of_object << " and " << many.bytes_of_object << "\n";
    // 16 times the objects: an exponent of 0.1 is a factor of 1.32. There is no surface to speak of in a
    // small scene, which leaves it a third fewer pairs.
    CHECK(many.tests_of_object <= 1.32 * 1.33 * few.tests_of_object);
    CHECK(many.tests_of_object < 60);
    CHECK(many.pairs_of_object <= 1.33 * few.pairs_of_object);
    CHECK(many.bytes_of_object <= 1.5 * few.bytes_of_object);
  }
}

TEST_CASE("2,000 objects in one place are a test or so for each pair, and nothing is left of them") {
  std::vector<std::unique_ptr<Object>> objects;
  oracle::Random random(1);
  for (std::size_t i = 0; i < 4000; ++i) {
    objects.push_back(std::make_unique<Object>());
    objects.back()->serial = i;
    objects.back()->box = i < 2000 ? cube({1, 1, 1}, 0.5) : in_space(random, i, 2000);
  }
  TaskPool tasks(1, ArenaPolicy::own);
  ObjectSummaries summaries;
  BroadPhase broad_phase;
  summaries.refresh(objects, tasks);
  constexpr std::size_t pairs = std::size_t{2000} * 1999 / 2;
  const std::size_t found = broad_phase.find(summaries, {}, IgnoringNone(), tasks).size();
  CHECK(found >= pairs);
  CHECK(found < pairs + 50000);
  CHECK(broad_phase.counters().boxes_tested < 2 * pairs);
  objects.erase(objects.begin(), objects.begin() + 2000);
  summaries.refresh(objects, tasks);
  CHECK(broad_phase.find(summaries, {}, IgnoringNone(), tasks).size() < 2000);
  CHECK(broad_phase.counters().boxes_tested == 0);
}

TEST_CASE("where 100 of 16,000 objects move, tests follow the 100") {
  std::vector<std::unique_ptr<Object>> objects;
  oracle::Random random(2);
  for (std::size_t i = 0; i < 16000; ++i) {
    objects.push_back(std::make_unique<Object>());
    objects.back()->serial = i;
    objects.back()->box = in_space(random, i, 16000);
  }
  TaskPool tasks(1, ArenaPolicy::own);
  ObjectSummaries summaries;
  BroadPhase broad_phase;
  for (int step = 0; step < 50; ++step) {
    for (std::size_t i = 0; i < 100; ++i)
      if (step > 0) objects[i * 160]->box = in_space(random, i, 16000);
    summaries.refresh(objects, tasks);
    broad_phase.find(summaries, {}, IgnoringNone(), tasks);
    if (step > 0) CHECK(broad_phase.counters().boxes_tested < std::uint64_t{100} * 400);
  }
}

TEST_CASE("reports of 3,000 objects are the same for 1, 2 and 3 threads, while they come, go and move") {
  std::vector<std::vector<ReportHandle>> reports;
  for (const unsigned threads : {1U, 2U, 3U}) {
    oracle::Random random(7);
    SceneSettings settings = settings_of(0.125, 0.25);
    settings.threads = threads;
    Scene scene(settings);
    std::vector<ObjectId> ids;
    auto& of_scene = reports.emplace_back();
    for (int step = 0; step < 8; ++step) {
      for (int i = 0; i < (step == 0 ? 3000 : 50); ++i)
        ids.push_back(scene.add(plate_mesh(), motion_of(Motion::rigid)));
      for (const ObjectId id : ids) {
        if (step > 2 && !random.chance(0.1)) continue;
        Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
        pose.translation() = random_point(random, 30);
        scene.set_pose(id, pose);
      }
      for (int i = 0; i < 20; ++i) {
        const std::size_t place = random.below(static_cast<std::uint32_t>(ids.size()));
        scene.remove(ids[place]);
        ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(place));
      }
      of_scene.push_back(scene.step());
    }
  }
  for (std::size_t step = 0; step < reports[0].size(); ++step) {
    const StepStatistics& expected = reports[0][step]->statistics();
    CHECK(expected.pairs_near > 500);
    for (const auto& others : reports) {
      REQUIRE(difference_of(*others[step], *reports[0][step]) == "");
      CHECK(others[step]->statistics().work.boxes_tested == expected.work.boxes_tested);
      CHECK(others[step]->statistics().pairs_close == expected.pairs_close);
      CHECK(others[step]->statistics().pairs_apart == expected.pairs_apart);
    }
  }
}

}  // namespace graze::tests
