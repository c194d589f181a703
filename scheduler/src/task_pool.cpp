#include "task_pool.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <graze/floating_point_scope.hpp>

namespace graze {

struct TaskPool::Arena {
  /// No more threads than oneTBB gives in this process: it would only complain on the caller's terminal.
  explicit Arena(std::size_t threads)
      : arena(
            static_cast<int>(std::min(threads, oneapi::tbb::global_control::active_value(
                                                   oneapi::tbb::global_control::max_allowed_parallelism)))) {}
  oneapi::tbb::task_arena arena;
};

TaskPool::TaskPool(unsigned threads)
    : worker_count_(threads == 0
                        ? static_cast<unsigned>(std::max(1, oneapi::tbb::info::default_concurrency()))
                        : threads) {
  if (worker_count_ > 1) arena_ = std::make_unique<Arena>(worker_count_);
}

TaskPool::~TaskPool() = default;

void TaskPool::run(std::size_t count, const std::function<void(unsigned worker, std::size_t item)>& work) {
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(worker_count_, count));
  if (workers <= 1) {
    const FloatingPointScope scope;
    for (std::size_t item = 0; item < count; ++item) work(0, item);
    return;
  }
  // Each task is a worker that takes the next item until none is left. Items write to places of their own, so
  // which worker takes which does not show in the result.
  std::atomic<std::size_t> next{0};
  arena_->arena.execute([&] {
    oneapi::tbb::parallel_for(
        0U, workers,
        [&](unsigned worker) {
          const FloatingPointScope scope;
          for (std::size_t item = next.fetch_add(1, std::memory_order_relaxed); item < count;
               item = next.fetch_add(1, std::memory_order_relaxed))
            work(worker, item);
        },
        oneapi::tbb::simple_partitioner());
  });
}

}  // namespace graze
