// Steps beside the caller's frame, and steps inside the caller's own tasks.

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <graze/error.hpp>
#include <optional>
#include <string>
#include <thread>

#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"

namespace graze::tests {
namespace {

/// Spheres in a row that come and go, enough for a step to last.
struct Spheres {
  explicit Spheres(const SceneSettings& settings) : scene(settings) {
    const auto sphere = mesh_of(models::sphere(24, 16));
    for (int i = 0; i < 8; ++i) {
      ids.push_back(scene.add(sphere));
      rest.assign(sphere->rest().begin(), sphere->rest().end());
    }
  }
  void place(int frame) {
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const double way = static_cast<double>(i) * 1.9 + 0.05 * ((frame + static_cast<int>(i)) % 4);
      scene.set_positions(ids[i], PositionView(moved(rest, {way, 0, 0})));
    }
  }

  Scene scene;
  std::vector<ObjectId> ids;
  Positions rest;
};

constexpr int frames = 6;

/// Whether a step ends within a minute.
bool ends_soon(const Scene& scene) {
  const auto late = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (scene.is_stepping() && std::chrono::steady_clock::now() < late) std::this_thread::yield();
  return !scene.is_stepping();
}

std::vector<ReportHandle> stepped(const SceneSettings& settings) {
  Spheres spheres(settings);
  std::vector<ReportHandle> reports;
  for (int frame = 0; frame < frames; ++frame) {
    spheres.place(frame);
    reports.push_back(spheres.scene.step());
  }
  return reports;
}

}  // namespace

TEST_CASE("step_async: the reports of steps, while the caller already stages the next") {
  for (const unsigned threads : {1U, 2U}) {
    SceneSettings settings = settings_of(0.05, 0.3);
    settings.threads = threads;
    const auto expected = stepped(settings);
    Spheres spheres(settings);
    spheres.place(0);
    for (int frame = 0; frame < frames; ++frame) {
      spheres.scene.step_async();
      spheres.place(frame + 1);
      const ReportHandle report = spheres.scene.wait();
      CHECK(difference_of(*report, *expected[static_cast<std::size_t>(frame)]) == "");
      CHECK_FALSE(spheres.scene.is_stepping());
      CHECK(spheres.scene.latest_report().get() == report.get());
    }
  }
}

TEST_CASE("step_async: what goes wrong comes out of wait, and the scene goes on") {
  Scene scene(settings_of(0.1, 1));
  std::vector<ReportHandle> held;
  try {
    while (held.size() < 70'000) held.push_back(scene.step());
  } catch (const Error&) {
  }
  scene.step_async();
  CHECK_THROWS_WITH(scene.wait(), Catch::Matchers::Contains("reports are held"));
  held.clear();
  const std::uint64_t frame = scene.latest_report()->frame();
  scene.step_async();
  CHECK(scene.wait()->frame() > frame);
}

TEST_CASE("step_async: a scene may go or move while it steps") {
  for (int run = 0; run < 50; ++run) {
    std::optional<Spheres> spheres(settings_of(0.05, 0.3));
    spheres->place(run);
    spheres->scene.step_async();
    const Scene elsewhere = std::move(spheres->scene);
    if (run % 2 == 0) spheres.reset();
  }
  SUCCEED("destroyed without a race");
}

TEST_CASE("step_async: the step does not wait for threads of oneTBB that are at other work") {
  const int workers = std::max(1, oneapi::tbb::info::default_concurrency() - 1);
  std::atomic<bool> is_over{false};
  std::atomic<int> began{0}, ended{0};
  oneapi::tbb::task_arena busy(workers, 0);
  for (int i = 0; i < workers; ++i)
    busy.enqueue([&] {
      ++began;
      is_over.wait(false);
      ++ended;
    });
  while (began < workers) std::this_thread::yield();
  SceneSettings settings = settings_of(0.05, 0.3);
  settings.threads = 1;
  Spheres on_one(settings);
  settings.threads = 4;
  Spheres on_four(settings);
  for (Spheres* const spheres : {&on_one, &on_four}) {
    spheres->place(0);
    spheres->scene.step_async();
  }
  CHECK(ends_soon(on_one.scene));
  CHECK(ends_soon(on_four.scene));
  is_over = true;
  is_over.notify_all();
  CHECK(difference_of(*on_one.scene.wait(), *on_four.scene.wait()) == "");
  while (ended < workers) std::this_thread::yield();
}

TEST_CASE("arena: scenes that step inside the caller's tasks, in its arena or their own") {
  const SceneSettings alone = settings_of(0.05, 0.3);
  const auto expected = stepped(alone);
  for (const ArenaPolicy policy : {ArenaPolicy::own, ArenaPolicy::callers}) {
    std::array<std::vector<ReportHandle>, 6> found;
    oneapi::tbb::task_arena arena(2);
    arena.execute([&] {
      oneapi::tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
        SceneSettings settings = alone;
        settings.threads = static_cast<unsigned>(i % 4);
        settings.arena = policy;
        found[i] = stepped(settings);
      });
    });
    for (const auto& reports : found)
      for (std::size_t frame = 0; frame < expected.size(); ++frame)
        CHECK(difference_of(*reports[frame], *expected[frame]) == "");
  }
}

TEST_CASE("arena: a step in a group of tasks that was cancelled has all of its answers") {
  const SceneSettings alone = settings_of(0.05, 0.3);
  const auto expected = stepped(alone);
  SceneSettings settings = alone;
  settings.threads = 3;
  settings.arena = ArenaPolicy::callers;
  std::vector<ReportHandle> found;
  oneapi::tbb::task_group group;
  group.run_and_wait([&] {
    group.cancel();
    found = stepped(settings);
  });
  REQUIRE(found.size() == expected.size());
  for (std::size_t frame = 0; frame < expected.size(); ++frame)
    CHECK(difference_of(*found[frame], *expected[frame]) == "");
}

}  // namespace graze::tests
