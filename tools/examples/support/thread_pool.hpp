#pragma once

#include <functional>
#include <graze/task_scheduler.hpp>
#include <memory>

namespace examples {

/// A plain pool of threads, as a program may have one of its own. Any number of scenes may share it. If all
/// threads are at work when a step is started, the pool gets one more for it.
class ThreadPool final : public graze::TaskScheduler {
 public:
  /// Starts `threads` threads. With the thread that steps, so many threads and one more run tasks. Without
  /// threads, steps that are started run before start() returns.
  explicit ThreadPool(unsigned threads);
  /// Runs the work that is queued, and waits for it. Not to be called by a thread of the pool.
  ~ThreadPool() override;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  void run(unsigned count, const std::function<void(unsigned task)>& task) override;
  void start(std::function<void()> work) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// No threads at all: everything runs on the thread that calls, for programs that have but one.
class SerialScheduler final : public graze::TaskScheduler {
 public:
  void run(unsigned count, const std::function<void(unsigned task)>& task) override {
    for (unsigned index = 0; index < count; ++index) task(index);
  }
  void start(std::function<void()> work) override { work(); }
};

}  // namespace examples
