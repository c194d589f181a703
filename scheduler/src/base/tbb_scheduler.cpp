#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "base/default_scheduler.hpp"

namespace graze {
namespace {

/// Runs tasks through oneTBB. It never changes how many threads oneTBB has.
class TbbScheduler final : public TaskScheduler {
 public:
  TbbScheduler(unsigned threads, ArenaPolicy policy) {
    // The arena asks for no more threads than oneTBB gives in this process. Otherwise oneTBB prints a
    // warning.
    const std::size_t allowed =
        oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
    if (threads > 1 && policy == ArenaPolicy::own)
      arena_.emplace(static_cast<int>(std::min<std::size_t>(threads, allowed)));
  }

  void run(unsigned count, const std::function<void(unsigned task)>& task) override {
    // A context of its own: a caller that steps in a group of tasks may have cancelled that group.
    oneapi::tbb::task_group_context context(oneapi::tbb::task_group_context::isolated);
    const auto run_all = [&] {
      oneapi::tbb::parallel_for(0U, count, task, oneapi::tbb::simple_partitioner(), context);
    };
    // In the caller's arena, `isolate` keeps a waiting thread from running the caller's own tasks in the
    // middle of a step.
    arena_ ? arena_->execute(run_all) : oneapi::tbb::this_task_arena::isolate(run_all);
  }

  void start(std::function<void()> work) override {
    if (!beside_) beside_.emplace(1, 0U);
    beside_->enqueue(std::move(work));
  }

 private:
  std::optional<oneapi::tbb::task_arena> arena_;   ///< none with one thread or in the caller's arena
  std::optional<oneapi::tbb::task_arena> beside_;  ///< the arena of `start`, made by its first call
};

}  // namespace

unsigned default_threads() {
  return static_cast<unsigned>(std::max(1, oneapi::tbb::info::default_concurrency()));
}

unsigned usable_threads(unsigned threads) {
  return threads;
}

std::shared_ptr<TaskScheduler> make_default_scheduler(unsigned threads, ArenaPolicy policy) {
  return std::make_shared<TbbScheduler>(threads, policy);
}

}  // namespace graze
