#include "base/task_pool.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <utility>

#include "base/access.hpp"
#include "base/default_scheduler.hpp"
#include "core/base/floating_point_scope.hpp"

namespace graze {
namespace {

constexpr unsigned threads_each_processor = 8;

/// How long a worker's part of a round is at least. To begin a round takes 1 µs where all threads are awake,
/// and a thread that sleeps takes 40 to 130 µs to come.
constexpr double nanoseconds_each_worker = 20'000;

std::atomic<bool> is_all_workers_used{false};
std::atomic<std::vector<RoundTimes>*> recorded_rounds{nullptr};

using Work = std::function<void(unsigned worker, std::size_t item)>;

void run_here(std::size_t count, const Work& work, const Round& round) {
  const FloatingPointScope scope;
  const AccessScope nothing({});
  for (std::size_t item = 0; item < count; ++item) work(0, item);
  if (count > 0 && round.finish) round.finish(0);
}

/// Runs a round on this thread, and takes the time of each item.
void record(std::size_t count, const Work& work, const Round& round, std::vector<RoundTimes>& rounds) {
  using Clock = std::chrono::steady_clock;
  RoundTimes times;
  times.estimate = round.nanoseconds;
  times.items.reserve(count);
  times.begin = Clock::now();
  Clock::time_point last = times.begin;
  const auto timed = [&](unsigned worker, std::size_t item) {
    work(worker, item);
    const Clock::time_point now = Clock::now();
    times.items.push_back(std::chrono::duration<float, std::nano>(now - std::exchange(last, now)).count());
  };
  run_here(count, timed, round);
  times.end = Clock::now();
  rounds.push_back(std::move(times));
}

/// The items of one call of TaskPool::run. Each worker picks the next item until none is left. Every item
/// writes only its own results, so no result depends on which worker picked it.
class Items {
 public:
  Items(std::size_t count, const Work& work, const Round& round)
      : count_(count), work_(work), finish_(round.finish) {}

  /// Takes items until none is left or one has thrown. The exception is kept, since a scheduler may have no
  /// memory to pass it on.
  void take(unsigned worker) {
    const FloatingPointScope scope;
    const AccessScope nothing({});
    try {
      bool has_worked = false;
      for (std::size_t item = next_.fetch_add(1, std::memory_order_relaxed);
           item < count_ && !has_failed_.load(std::memory_order_relaxed);
           item = next_.fetch_add(1, std::memory_order_relaxed)) {
        work_(worker, item);
        has_worked = true;
      }
      if (has_worked && finish_) finish_(worker);
    } catch (...) {
      if (!has_failed_.exchange(true)) problem_ = std::current_exception();
    }
  }
  void rethrow() const {
    if (problem_) std::rethrow_exception(problem_);
  }

 private:
  std::size_t count_;
  const Work& work_;
  const std::function<void(unsigned worker)>& finish_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> has_failed_{false};
  std::exception_ptr problem_;
};

/// How many workers a pool has of a scheduler, which is null where it is the default one.
unsigned workers_of(unsigned threads, const TaskScheduler* scheduler) {
  const unsigned wanted = threads == 0 ? default_threads() : std::min(threads, max_threads());
  return scheduler != nullptr ? wanted : usable_threads(wanted);
}

}  // namespace

unsigned workers_worth(double nanoseconds, unsigned most) {
  if (is_all_workers_used.load(std::memory_order_relaxed)) return most;
  const double more = nanoseconds / nanoseconds_each_worker;
  return more < most ? std::min(most, 1 + static_cast<unsigned>(more)) : most;
}

unsigned max_threads() {
  return threads_each_processor * default_threads();
}

TaskPool::TaskPool(unsigned threads, ArenaPolicy policy, std::shared_ptr<TaskScheduler> scheduler)
    : worker_count_(workers_of(threads, scheduler.get())),
      scheduler_(scheduler != nullptr ? std::move(scheduler)
                                      : make_default_scheduler(worker_count_, policy)) {}

void TaskPool::run(std::size_t count, const Work& work, const Round& round) {
  if (auto* const rounds = recorded_rounds.load(std::memory_order_relaxed))
    return record(count, work, round, *rounds);
  const auto workers =
      static_cast<unsigned>(std::min<std::size_t>(count, workers_worth(round.nanoseconds, worker_count_)));
  if (workers <= 1) return run_here(count, work, round);
  Items items(count, work, round);
  try {
    // The function is small enough to need no memory.
    scheduler_->run(workers, [&items](unsigned worker) { items.take(worker); });
  } catch (...) {  // all tasks that began have ended
  }
  // This thread does the items that a scheduler left out because it threw or was cancelled.
  items.take(0);
  items.rethrow();
}

void TaskPool::use_all_workers(bool uses_all) {
  is_all_workers_used = uses_all;
}

void TaskPool::record_rounds(std::vector<RoundTimes>* rounds) {
  recorded_rounds = rounds;
}

void TaskPool::start(std::function<void()> work) {
  scheduler_->start(std::move(work));
}

}  // namespace graze
