#pragma once

#include <cstddef>
#include <functional>
#include <graze/settings.hpp>
#include <memory>

namespace graze {

/// Runs work on threads of the caller's process through oneTBB. With one thread everything runs on the
/// caller's thread, without a task. The pool never changes how many threads oneTBB has.
class TaskPool {
 public:
  /// `threads` is the largest number of threads in use at once; 0 means one for each processor. Numbers above
  /// `max_threads()` count as `max_threads()`.
  TaskPool(unsigned threads, ArenaPolicy policy);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  /// How many workers `run` uses at most. Each worker has a number below this.
  [[nodiscard]] unsigned worker_count() const { return worker_count_; }

  /// Calls `work(worker, item)` once for every item below `count`. Items begin in ascending order, and the
  /// calls of one worker never overlap. Every worker computes in a FloatingPointScope, without AccessRights
  /// other than those that `work` declares. If a call throws, `run` throws that exception and some items may
  /// not have begun. If oneTBB has no memory for tasks, the calling thread does what is left.
  void run(std::size_t count, const std::function<void(unsigned worker, std::size_t item)>& work);

  /// Calls `work` once on another thread; `work` must not throw. Throws if oneTBB cannot begin it.
  void start(std::function<void()> work);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;   ///< null with one thread or in the caller's arena
  std::unique_ptr<Arena> beside_;  ///< the arena of `start`, made by its first call
  unsigned worker_count_ = 1;
};

}  // namespace graze
