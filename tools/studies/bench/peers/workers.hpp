#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <cstddef>

namespace graze::bench {

/// Runs independent pieces of work on so many threads, on the calling one alone where there is one.
class Workers {
 public:
  explicit Workers(unsigned threads) : threads_(threads), arena_(static_cast<int>(threads)) {}

  /// How many places for results there are, one for each thread.
  [[nodiscard]] std::size_t slots() const { return threads_; }

  /// Calls work(index, slot) for every index below `count`. No two calls of one slot run at once.
  template <typename Work>
  void each(std::size_t count, const Work& work) {
    if (threads_ == 1) {
      for (std::size_t i = 0; i < count; ++i) work(i, std::size_t{0});
      return;
    }
    arena_.execute([&] {
      oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
        work(i, static_cast<std::size_t>(oneapi::tbb::this_task_arena::current_thread_index()));
      });
    });
  }

 private:
  unsigned threads_;
  oneapi::tbb::task_arena arena_;
};

}  // namespace graze::bench
