// Scenes that run their tasks with a scheduler of the caller's: the answers are those of any other.

#include <array>
#include <atomic>
#include <chrono>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include "base/task_pool.hpp"
#include "examples/support/thread_pool.hpp"
#include "scheduler/moving_scene.hpp"
#include "scheduler/report_text.hpp"
#include "support/catch.hpp"
#include "support/details.hpp"

namespace graze::tests {
namespace {

constexpr std::size_t frames_of_scheduler = 12;

SceneSettings settings_on(unsigned threads, ContactDetail detail) {
  SceneSettings settings = settings_of(0.05, 0.25, detail);
  settings.threads = threads;
  return settings;
}

void check_same(const std::vector<ReportHandle>& found, const std::vector<ReportHandle>& expected) {
  REQUIRE(found.size() == expected.size());
  for (std::size_t frame = 0; frame < found.size(); ++frame) {
    INFO("frame " << frame);
    REQUIRE(difference_of(*found[frame], *expected[frame]) == "");
  }
}

/// Has no threads. Calls the tasks from the last to the first, throws before, amid or after them, or calls
/// none.
class WilfulScheduler final : public TaskScheduler {
 public:
  enum class Way { backwards, throws_before, throws_amid, throws_after, forgets };
  explicit WilfulScheduler(Way way) : way_(way) {}

  void run(unsigned count, const std::function<void(unsigned task)>& task) override {
    ++runs;
    most_tasks = std::max(most_tasks, count);
    if (way_ == Way::throws_before) throw std::bad_alloc();
    if (way_ == Way::forgets) return;
    for (unsigned left = count; left > 0; --left) {
      if (way_ == Way::throws_amid && left == 1) throw std::bad_alloc();
      task(left - 1);
    }
    if (way_ == Way::throws_after) throw std::bad_alloc();
  }
  void start(std::function<void()> work) override {
    if (way_ != Way::backwards) throw std::bad_alloc();
    work();
  }

  std::size_t runs = 0;
  unsigned most_tasks = 0;

 private:
  Way way_;
};

/// While it lives rounds use as many workers as their work pays for, as in programs.
class AsManyAsPaid {
 public:
  AsManyAsPaid() { TaskPool::use_all_workers(false); }
  ~AsManyAsPaid() { TaskPool::use_all_workers(true); }
  AsManyAsPaid(const AsManyAsPaid&) = delete;
  AsManyAsPaid& operator=(const AsManyAsPaid&) = delete;
};

}  // namespace

TEST_CASE("task scheduler: a pool of the caller's and no threads at all give the same reports") {
  const MovingScene moving;
  for (const ContactDetail detail : all_details) {
    const auto expected = moving.play(settings_on(1, detail), frames_of_scheduler);
    for (const unsigned threads : {2U, 5U, 0U}) {
      INFO("detail " << static_cast<int>(detail) << ", " << threads << " threads");
      const SceneSettings settings = settings_on(threads, detail);
      check_same(moving.play(settings, frames_of_scheduler, std::make_shared<examples::ThreadPool>(3)),
                 expected);
      check_same(moving.play(settings, frames_of_scheduler, std::make_shared<examples::SerialScheduler>()),
                 expected);
    }
  }
}

TEST_CASE("task scheduler: tasks in another order, and a scheduler that throws or forgets them") {
  using Way = WilfulScheduler::Way;
  const MovingScene moving;
  const auto expected = moving.play(settings_on(1, ContactDetail::features), frames_of_scheduler);
  for (const Way way :
       {Way::backwards, Way::throws_before, Way::throws_amid, Way::throws_after, Way::forgets}) {
    INFO("way " << static_cast<int>(way));
    const auto scheduler = std::make_shared<WilfulScheduler>(way);
    check_same(moving.play(settings_on(3, ContactDetail::features), frames_of_scheduler, scheduler),
               expected);
    CHECK(scheduler->runs > frames_of_scheduler);
    CHECK(scheduler->most_tasks == 3);
  }
}

TEST_CASE("task scheduler: a round uses as many threads as its work pays for, and the reports are the same") {
  const AsManyAsPaid as_many_as_paid;
  const MovingScene moving;
  for (const ContactDetail detail : all_details) {
    const auto expected = moving.play(settings_on(1, detail), frames_of_scheduler);
    for (const unsigned threads : {2U, 16U})
      check_same(moving.play(settings_on(threads, detail), frames_of_scheduler), expected);
  }
  const auto scheduler = std::make_shared<WilfulScheduler>(WilfulScheduler::Way::backwards);
  TaskPool pool(8, ArenaPolicy::own, scheduler);
  std::size_t items = 0;
  std::vector<unsigned> finished;
  const auto work = [&](unsigned, std::size_t) { ++items; };
  const auto finish = [&](unsigned worker) { finished.push_back(worker); };
  pool.run(100, work, {.nanoseconds = 100, .finish = finish});
  CHECK(scheduler->runs == 0);
  CHECK(finished == std::vector<unsigned>{0});
  pool.run(100, work, {.nanoseconds = 50'000, .finish = finish});
  CHECK((scheduler->runs == 1 && scheduler->most_tasks == 3));
  pool.run(100, work, {.nanoseconds = 1e12, .finish = finish});
  CHECK((scheduler->runs == 2 && scheduler->most_tasks == 8));
  pool.run(100, work);
  pool.run(4, work);
  CHECK((scheduler->runs == 4 && scheduler->most_tasks == 8));
  CHECK(items == 404);
  // The last of the tasks takes all items.
  CHECK(finished == std::vector<unsigned>{0, 2, 7});
}

TEST_CASE("task scheduler: scenes step on a pool whose threads are all in tasks of another scene") {
  const MovingScene moving;
  const SceneSettings settings = settings_on(3, ContactDetail::features);
  const auto expected = moving.play(settings_on(1, ContactDetail::features), frames_of_scheduler);
  const auto pool = std::make_shared<examples::ThreadPool>(2);
  std::atomic<bool> is_over{false};
  std::atomic<int> began{0};
  std::thread other([&] {
    pool->run(3, [&](unsigned) {
      ++began;
      is_over.wait(false);
    });
  });
  while (began < 3) std::this_thread::yield();
  check_same(moving.play(settings, frames_of_scheduler, pool), expected);
  Scene started(settings, pool);
  for (std::uint64_t frame = 1; frame < 4; ++frame) {
    started.step_async(frame);
    const auto late = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (started.is_stepping() && std::chrono::steady_clock::now() < late) std::this_thread::yield();
    if (started.is_stepping()) is_over = true;  // so that the test ends
    is_over.notify_all();
    CHECK(!is_over);
    CHECK(started.wait()->tag() == frame);
  }
  is_over = true;
  is_over.notify_all();
  other.join();
}

TEST_CASE("task scheduler: a step that cannot be started throws, and the next one is as ever") {
  Scene scene(settings_on(2, ContactDetail::features),
              std::make_shared<WilfulScheduler>(WilfulScheduler::Way::throws_before));
  CHECK_THROWS_AS(scene.step_async(), std::bad_alloc);
  CHECK(!scene.is_stepping());
  CHECK(scene.step()->frame() == 1);
}

TEST_CASE("task scheduler: steps that are started run on the pool, or before the call returns") {
  const auto pool = std::make_shared<examples::ThreadPool>(1);
  Scene beside(settings_on(2, ContactDetail::features), pool);
  Scene inside(settings_on(2, ContactDetail::features), std::make_shared<examples::SerialScheduler>());
  for (std::uint64_t frame = 1; frame < 20; ++frame) {
    beside.step_async(frame);
    inside.step_async(10 * frame);
    CHECK(!inside.is_stepping());
    CHECK(inside.wait()->tag() == 10 * frame);
    CHECK(beside.wait()->tag() == frame);
  }
}

TEST_CASE("task scheduler: scenes in several threads share one pool") {
  const MovingScene moving;
  const auto expected = moving.play(settings_on(1, ContactDetail::features), frames_of_scheduler);
  const auto pool = std::make_shared<examples::ThreadPool>(2);
  std::array<std::vector<ReportHandle>, 3> found;
  std::vector<std::thread> threads;
  for (std::vector<ReportHandle>& reports : found)
    threads.emplace_back(
        [&] { reports = moving.play(settings_on(4, ContactDetail::features), frames_of_scheduler, pool); });
  for (std::thread& thread : threads) thread.join();
  for (const std::vector<ReportHandle>& reports : found) check_same(reports, expected);
}

}  // namespace graze::tests
