#pragma once

#include <cstddef>
#include <functional>
#include <graze/settings.hpp>
#include <memory>

namespace graze {

/// Threads of the caller's process, through oneTBB. With one thread everything runs on the caller's, without
/// a task. Nothing here changes how many threads oneTBB has.
class TaskPool {
 public:
  /// 0: as many threads as there are processors. More than `max_threads()` count as so many.
  TaskPool(unsigned threads, ArenaPolicy policy);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  /// Workers that `run` may use at once; each has a number below this.
  [[nodiscard]] unsigned worker_count() const { return worker_count_; }

  /// Calls `work(worker, item)` for every item below `count`, each once. Items are begun in ascending order;
  /// the calls of one worker never overlap. Every worker computes in a FloatingPointScope, and
  /// with no AccessRights but those that `work` declares. Throws what a call throws; then some items may not
  /// have been begun. Where oneTBB has no memory for tasks, the calling thread does all that is left.
  void run(std::size_t count, const std::function<void(unsigned worker, std::size_t item)>& work);

  /// Calls `work` on another thread, once; it must not throw. Throws where oneTBB cannot begin it.
  void start(std::function<void()> work);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;   ///< null with one thread, and in the caller's arena
  std::unique_ptr<Arena> beside_;  ///< of `start`; made when first asked for
  unsigned worker_count_ = 1;
};

}  // namespace graze
