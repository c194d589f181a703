#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <graze/settings.hpp>
#include <graze/task_scheduler.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace graze {

/// A stage's estimate of its items, and how a worker ends with them.
struct Round {
  /// About how long all items take on one thread, in nanoseconds. It comes from counts of this step and the
  /// last one. A worker more is used only for some ten thousand nanoseconds of it.
  double nanoseconds = std::numeric_limits<double>::infinity();
  /// A worker that has taken an item ends with `finish(worker)`, unless an item has thrown. It does not
  /// throw. If the calling thread does what is left, it may be called twice with one worker, one after the
  /// other.
  std::function<void(unsigned worker)> finish = nullptr;
};

/// How many workers of at most `most` a round pays for that takes so long on one thread.
[[nodiscard]] unsigned workers_worth(double nanoseconds, unsigned most);

/// A round as it went on one thread.
struct RoundTimes {
  std::chrono::steady_clock::time_point begin, end;
  double estimate = 0;       ///< Round::nanoseconds
  std::vector<float> items;  ///< nanoseconds of each
};

/// Runs the items of a stage on workers, which are tasks of a TaskScheduler. With one worker everything runs
/// on the caller's thread, without a task.
class TaskPool {
 public:
  /// `threads` is the largest number of threads in use at once; 0 means one for each processor. Numbers above
  /// `max_threads()` count as `max_threads()`. Where `scheduler` is null, the default one is used.
  TaskPool(unsigned threads, ArenaPolicy policy, std::shared_ptr<TaskScheduler> scheduler = nullptr);

  /// How many workers `run` uses at most. Each worker has a number below this.
  [[nodiscard]] unsigned worker_count() const { return worker_count_; }

  /// Calls `work(worker, item)` once for every item below `count`. Items begin in ascending order, and the
  /// calls of one worker never overlap. Every worker computes in a FloatingPointScope, without AccessRights
  /// other than those that `work` declares. If a call throws, `run` throws that exception and some items may
  /// not have begun. If the scheduler throws, as for lack of memory, the calling thread does what is left.
  void run(std::size_t count, const std::function<void(unsigned worker, std::size_t item)>& work,
           const Round& round = {});

  /// For tests: whether each round uses all workers, however little there is to do. Then small scenes show
  /// what threads do to each other.
  static void use_all_workers(bool uses_all);

  /// For studies: while there is a list, each round runs on the calling thread, and is added to it. One
  /// thread at a time may step then.
  static void record_rounds(std::vector<RoundTimes>* rounds);

  /// Calls `work` once on another thread; `work` must not throw. Throws if the scheduler cannot begin it.
  void start(std::function<void()> work);

 private:
  unsigned worker_count_;
  std::shared_ptr<TaskScheduler> scheduler_;
};

}  // namespace graze
