#include "base/task_pool.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <utility>

#include "base/access.hpp"
#include "core/base/floating_point_scope.hpp"

namespace graze {
namespace {

constexpr unsigned threads_each_processor = 8;

unsigned processors() {
  return static_cast<unsigned>(std::max(1, oneapi::tbb::info::default_concurrency()));
}

}  // namespace

unsigned max_threads() {
  return threads_each_processor * processors();
}

struct TaskPool::Arena {
  explicit Arena(int threads, unsigned reserved_for_callers = 1) : arena(threads, reserved_for_callers) {}
  oneapi::tbb::task_arena arena;
};

TaskPool::TaskPool(unsigned threads, ArenaPolicy policy)
    : worker_count_(threads == 0 ? processors() : std::min(threads, max_threads())) {
  // The arena asks for no more threads than oneTBB gives in this process. Otherwise oneTBB prints a warning.
  const std::size_t allowed =
      oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
  if (worker_count_ > 1 && policy == ArenaPolicy::own)
    arena_ = std::make_unique<Arena>(static_cast<int>(std::min<std::size_t>(worker_count_, allowed)));
}

TaskPool::~TaskPool() = default;

void TaskPool::run(std::size_t count, const std::function<void(unsigned worker, std::size_t item)>& work) {
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(worker_count_, count));
  if (workers <= 1) {
    const FloatingPointScope scope;
    const AccessScope nothing({});
    for (std::size_t item = 0; item < count; ++item) work(0, item);
    return;
  }
  // Each task is a worker that picks the next item until none is left. Every item writes only its own
  // results, so no result depends on which worker picked it.
  std::atomic<std::size_t> next{0};
  std::atomic<bool> has_failed{false};
  std::exception_ptr problem;
  // Exceptions of items bypass oneTBB, which would need memory to pass them on.
  const auto run_worker = [&](unsigned worker) {
    const FloatingPointScope scope;
    const AccessScope nothing({});
    try {
      for (std::size_t item = next.fetch_add(1, std::memory_order_relaxed);
           item < count && !has_failed.load(std::memory_order_relaxed);
           item = next.fetch_add(1, std::memory_order_relaxed))
        work(worker, item);
    } catch (...) {
      if (!has_failed.exchange(true)) problem = std::current_exception();
    }
  };
  const auto run_workers = [&] {
    oneapi::tbb::parallel_for(0U, workers, run_worker, oneapi::tbb::simple_partitioner());
  };
  try {
    // In the caller's arena, `isolate` keeps a waiting thread from running the caller's own tasks in the
    // middle of a step.
    arena_ ? arena_->arena.execute(run_workers) : oneapi::tbb::this_task_arena::isolate(run_workers);
  } catch (...) {
    // oneTBB had no memory for its tasks. The tasks that began have ended, and this thread does the rest.
    run_worker(0);
  }
  if (problem) std::rethrow_exception(problem);
}

void TaskPool::start(std::function<void()> work) {
  if (!beside_) beside_ = std::make_unique<Arena>(1, 0);
  beside_->arena.enqueue(std::move(work));
}

}  // namespace graze
