#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace graze {

/// Threads of the caller's process, through oneTBB. With one thread everything runs on the caller's, without
/// a task.
class TaskPool {
 public:
  /// 0: as many threads as the machine has.
  explicit TaskPool(unsigned threads);
  ~TaskPool();
  TaskPool(const TaskPool&) = delete;
  TaskPool& operator=(const TaskPool&) = delete;

  /// Workers that `run` may use at once; each has a number below this.
  [[nodiscard]] unsigned worker_count() const { return worker_count_; }

  /// Calls `work(worker, item)` for every item below `count`, each once. Items are begun in ascending order;
  /// the calls of one worker never overlap. Every worker computes in a FloatingPointScope.
  void run(std::size_t count, const std::function<void(unsigned worker, std::size_t item)>& work);

 private:
  struct Arena;
  std::unique_ptr<Arena> arena_;
  unsigned worker_count_ = 1;
};

}  // namespace graze
