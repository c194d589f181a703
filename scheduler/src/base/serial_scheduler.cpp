#include <algorithm>
#include <mutex>
#include <thread>
#include <utility>

#include "base/default_scheduler.hpp"

namespace graze {
namespace {

/// Runs all tasks on the thread that steps, and each Scene::step_async() on a thread of its own.
class SerialScheduler final : public TaskScheduler {
 public:
  SerialScheduler() = default;
  SerialScheduler(const SerialScheduler&) = delete;
  SerialScheduler& operator=(const SerialScheduler&) = delete;
  ~SerialScheduler() override {
    if (beside_.joinable()) beside_.join();
  }

  void run(unsigned count, const std::function<void(unsigned task)>& task) override {
    for (unsigned index = 0; index < count; ++index) task(index);
  }

  void start(std::function<void()> work) override {
    // Another thread may still be in here, since its step has ended before it returns. The work never waits
    // for the mutex.
    const std::lock_guard lock(mutex_);
    if (beside_.joinable()) beside_.join();  // its step has ended: a scene has one at a time
    beside_ = std::thread(std::move(work));
  }

 private:
  std::mutex mutex_;  ///< guards the thread
  std::thread beside_;
};

}  // namespace

unsigned default_threads() {
  return std::max(1U, std::thread::hardware_concurrency());
}

unsigned usable_threads(unsigned) {
  return 1;
}

std::shared_ptr<TaskScheduler> make_default_scheduler(unsigned, ArenaPolicy) {
  return std::make_shared<SerialScheduler>();
}

}  // namespace graze
