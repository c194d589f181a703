#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <new>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "base/default_scheduler.hpp"

namespace graze {
namespace {

/// A thread that runs the steps of Scene::step_async(), one at a time. A thread of oneTBB may be in tasks of
/// another scene until that scene's longest stage ends, and would begin the step only then. The thread is
/// made by the first call.
class StepThread {
 public:
  StepThread() = default;
  StepThread(const StepThread&) = delete;
  StepThread& operator=(const StepThread&) = delete;
  ~StepThread() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      is_closed_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }

  /// Calls `work` on the thread, once the work before it has returned.
  void start(std::function<void()> work) {
    {
      const std::lock_guard lock(mutex_);
      if (!thread_.joinable()) begin();
      work_ = std::move(work);
    }
    changed_.notify_one();
  }

 private:
  void begin() {
    try {
      thread_ = std::thread([this] { run(); });
    } catch (const std::system_error&) {  // the system has no memory for its stack
      throw std::bad_alloc();
    }
  }
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_closed_ || work_ != nullptr; });
      if (work_ == nullptr) return;
      const std::function<void()> work = std::exchange(work_, nullptr);
      lock.unlock();
      work();
      lock.lock();
    }
  }

  std::mutex mutex_;  ///< guards the three below
  std::thread thread_;
  std::function<void()> work_;
  bool is_closed_ = false;
  std::condition_variable changed_;
};

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

  void start(std::function<void()> work) override { beside_.start(std::move(work)); }

 private:
  std::optional<oneapi::tbb::task_arena> arena_;  ///< none with one thread or in the caller's arena
  StepThread beside_;                             ///< goes first, since it uses the arena
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
