#include "examples/support/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace examples {
namespace {

/// The tasks of one call of run(). Threads that come when all tasks have begun find nothing left, and touch
/// nothing of the call, which may have returned.
class Batch {
 public:
  Batch(const std::function<void(unsigned task)>& task, unsigned count) : task_(task), count_(count) {}

  void help() {
    for (unsigned index = next_.fetch_add(1); index < count_; index = next_.fetch_add(1)) {
      task_(index);
      const std::lock_guard lock(mutex_);
      if (++ended_ == count_) all_ended_.notify_all();
    }
  }
  void wait() {
    std::unique_lock lock(mutex_);
    all_ended_.wait(lock, [this] { return ended_ == count_; });
  }

 private:
  const std::function<void(unsigned task)>& task_;
  unsigned count_;
  std::atomic<unsigned> next_{0};
  std::mutex mutex_;  // guards the number below
  unsigned ended_ = 0;
  std::condition_variable all_ended_;
};

}  // namespace

struct ThreadPool::State {
  using Queue = std::deque<std::function<void()>>;

  std::mutex mutex;  // guards the five below
  Queue started;     // goes first
  Queue queue;
  std::size_t idle = 0;
  bool is_closed = false;
  std::vector<std::thread> threads;
  std::condition_variable changed;
  std::size_t helpers = 0;  // how many threads help with tasks at most

  void work() {
    std::unique_lock lock(mutex);
    while (true) {
      ++idle;
      changed.wait(lock, [this] { return is_closed || !started.empty() || !queue.empty(); });
      --idle;
      Queue& next = started.empty() ? queue : started;
      if (next.empty()) return;
      const std::function<void()> first = std::move(next.front());
      next.pop_front();
      lock.unlock();
      first();
      lock.lock();
    }
  }
  void add_thread() {
    threads.emplace_back([this] { work(); });
  }
};

ThreadPool::ThreadPool(unsigned threads) : state_(std::make_unique<State>()) {
  state_->helpers = threads;
  const std::lock_guard lock(state_->mutex);
  for (unsigned i = 0; i < threads; ++i) state_->add_thread();
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(state_->mutex);
    state_->is_closed = true;
  }
  state_->changed.notify_all();
  for (std::thread& thread : state_->threads) thread.join();
}

void ThreadPool::run(unsigned count, const std::function<void(unsigned task)>& task) {
  const auto batch = std::make_shared<Batch>(task, count);
  const auto helpers = std::min<std::size_t>(count - 1, state_->helpers);
  try {
    const std::lock_guard lock(state_->mutex);
    for (std::size_t i = 0; i < helpers; ++i) state_->queue.emplace_back([batch] { batch->help(); });
  } catch (const std::bad_alloc&) {  // then fewer threads help
  }
  state_->changed.notify_all();
  batch->help();
  batch->wait();
}

void ThreadPool::start(std::function<void()> work) {
  if (state_->helpers == 0) return work();
  {
    const std::lock_guard lock(state_->mutex);
    state_->started.push_back(std::move(work));
    // A thread that helps another scene may not come back before that scene's longest stage has ended.
    if (state_->idle < state_->started.size()) try {
        state_->add_thread();
      } catch (const std::system_error&) {  // then the work waits for a thread
      }
  }
  state_->changed.notify_one();
}

}  // namespace examples
