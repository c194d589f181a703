#include "stress/together.hpp"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "distribution.hpp"
#include "examples/support/thread_pool.hpp"
#include "output/text.hpp"
#include "output/text_table.hpp"
#include "scenes/report_hash.hpp"
#include "stress/clocks.hpp"
#include "stress/drifting_bodies.hpp"

namespace graze::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// From the end of a small step to the begin of the next.
constexpr std::chrono::milliseconds pause_of_small{3};
/// Steps in a row that are alone, or beside the large scene.
constexpr std::size_t steps_in_a_row = 20;

/// Whose threads two scenes use.
enum class WhoseThreads { own_arenas, one_arena, one_pool };

struct Way {
  const char* name;
  WhoseThreads threads;
  bool small_is_started;  ///< by step_async(), and then waited for
  bool large_is_started;
  bool is_control;  ///< in place of the large scene threads do arithmetic
};

constexpr std::array<Way, 7> ways = {
    {{"arithmetic", WhoseThreads::own_arenas, false, false, true},
     {"arenas of their own", WhoseThreads::own_arenas, false, false, false},
     {"and the small one step_async", WhoseThreads::own_arenas, true, false, false},
     {"and both step_async", WhoseThreads::own_arenas, true, true, false},
     {"one arena", WhoseThreads::one_arena, false, false, false},
     {"one pool", WhoseThreads::one_pool, false, false, false},
     {"one pool, both step_async", WhoseThreads::one_pool, true, true, false}}};

struct Large {
  const char* name;
  std::function<DriftingBodies()> make;
};

/// What two scenes share.
struct Shared {
  explicit Shared(unsigned threads)
      : arena(static_cast<int>(threads), 2), pool(std::make_shared<examples::ThreadPool>(threads - 1)) {}
  oneapi::tbb::task_arena arena;
  std::shared_ptr<examples::ThreadPool> pool;
};

/// A scene that steps in one of these ways.
class Player {
 public:
  Player(DriftingBodies world, const Way& way, bool is_started, Shared& shared, unsigned threads)
      : world_(std::move(world)), way_(way), is_started_(is_started), shared_(shared) {
    SceneSettings settings = world_.settings();
    settings.threads = threads;
    if (way.threads == WhoseThreads::one_arena) settings.arena = ArenaPolicy::callers;
    if (way.threads == WhoseThreads::one_pool)
      scene_.emplace(settings, shared.pool);
    else
      scene_.emplace(settings);
    world_.add_to(*scene_);
  }

  /// Plays the next frame, and returns how long its step took in milliseconds.
  double step() {
    world_.move(frame_++);
    const Clock::time_point begin = Clock::now();
    ReportHandle report;
    if (is_started_) {
      scene_->step_async();
      report = scene_->wait();
    } else if (way_.threads == WhoseThreads::one_arena) {
      shared_.arena.execute([&] { report = scene_->step(); });
    } else {
      report = scene_->step();
    }
    const double ms = ns_between(begin, Clock::now()) / 1e6;
    hash_.add(*report);
    return ms;
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }

 private:
  DriftingBodies world_;
  Way way_;
  bool is_started_;
  Shared& shared_;
  std::optional<Scene> scene_;
  std::size_t frame_ = 0;
  scenes::ReportHash hash_;
};

/// WhoseThreads that do `work(i)` again and again while they are wanted.
class Busy {
 public:
  Busy(unsigned threads, std::function<void(unsigned)> work) : work_(std::move(work)) {
    for (unsigned i = 0; i < threads; ++i) threads_.emplace_back([this, i] { run(i); });
  }
  ~Busy() {
    want(State::ended);
    for (std::thread& thread : threads_) thread.join();
  }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

  void begin() { want(State::works); }
  /// Returns when no thread works any more.
  void pause() {
    want(State::pauses);
    for (unsigned at_work = working_; at_work != 0; at_work = working_) working_.wait(at_work);
  }

 private:
  enum class State { pauses, works, ended };

  void want(State state) {
    state_ = state;
    state_.notify_all();
  }
  void run(unsigned index) {
    while (state_ != State::ended) {
      state_.wait(State::pauses);
      ++working_;
      while (state_ == State::works) work_(index);
      --working_;
      working_.notify_all();
    }
  }

  std::function<void(unsigned)> work_;
  std::atomic<State> state_{State::pauses};
  std::atomic<unsigned> working_{0};
  std::vector<std::thread> threads_;
};

void calculate_a_while() {
  std::uint64_t value = 1;
  for (int i = 0; i < 100'000; ++i) value = value * 6364136223846793005U + 1442695040888963407U;
  volatile std::uint64_t result = value;  // so that nobody finds it needless
  (void)result;
}

struct Together {
  std::vector<double> alone, beside, large;  ///< milliseconds of steps
  std::uint64_t hash = 0;
};

Together play_together(const Large& large, const Way& way, std::size_t frames) {
  const unsigned threads = std::max(2U, std::thread::hardware_concurrency());
  Shared shared(threads);
  Player small(DriftingBodies::heap(10), way, way.small_is_started, shared, threads);
  Player other(large.make(), way, way.large_is_started, shared, threads);
  for (int warm_up = 0; warm_up < 4; ++warm_up) {
    small.step();
    other.step();
  }
  Together found;
  Busy busy(way.is_control ? threads : 1, [&](unsigned) {
    if (way.is_control) return calculate_a_while();
    found.large.push_back(other.step());
  });
  const std::size_t in_a_row = std::min(steps_in_a_row, frames);
  for (std::size_t frame = 0; frame < 2 * frames; ++frame) {
    const bool is_beside = frame / in_a_row % 2 != 0;
    if (frame % in_a_row == 0) is_beside ? busy.begin() : busy.pause();
    std::this_thread::sleep_for(pause_of_small);
    (is_beside ? found.beside : found.alone).push_back(small.step());
  }
  busy.pause();
  found.hash = small.hash();
  return found;
}

}  // namespace

StressResult run_together_study(const TogetherOptions& options) {
  const std::array<Large, 2> larges = {{{"a heap of 200 balls", [] { return DriftingBodies::heap(200); }},
                                        {"an entangled pair", DriftingBodies::entangled_pair}}};
  StressResult result;
  std::optional<std::uint64_t> hash;
  for (const Large& large : larges) {
    print(format("\n10 balls beside %s, ms a step\n\n", large.name));
    const TextTable table = TextTable::of_numbers(
        {"threads", "alone", "p99", "beside", "p99", "longest", "the large one"}, 28, 7);
    print(table.head());
    for (const Way& way : ways) {
      const Together found = play_together(large, way, options.frames);
      const Distribution alone(found.alone), beside(found.beside), other(found.large);
      print(table.row({way.name, fixed(alone.median(), 2), fixed(alone.quantile(0.99), 2),
                       fixed(beside.median(), 2), fixed(beside.quantile(0.99), 2),
                       fixed(beside.quantile(1), 2), rounded(other.median(), 3)}));
      result.figures["together"].push_back({{"large", large.name},
                                            {"threads", way.name},
                                            {"alone_ms", alone.figures()},
                                            {"beside_ms", beside.figures()},
                                            {"large_ms", way.is_control ? 0 : other.median()},
                                            {"hash", hash_text(found.hash)}});
      if (found.hash != hash.value_or(found.hash))
        result.violations.push_back(format("%s, %s: reports have hash %s, not %s", large.name, way.name,
                                           hash_text(found.hash).c_str(), hash_text(*hash).c_str()));
      hash = found.hash;
    }
  }
  return result;
}

}  // namespace graze::tools
