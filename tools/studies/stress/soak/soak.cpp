#include "stress/soak/soak.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <shared_mutex>
#include <thread>

#include "output/text.hpp"
#include "output/text_table.hpp"
#include "progress.hpp"
#include "sanitizers.hpp"
#include "scenes/report_hash.hpp"
#include "stress/clocks.hpp"
#include "stress/soak/soak_world.hpp"

namespace graze::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t check_every = 100;
constexpr std::size_t remake_every = 250;
constexpr std::size_t intervals = 30;

// After the first fifth of the time the largest figures of the second half may exceed those of the first by
// this: the scene's contents are random, so its needs are too.
constexpr double warm_up = 0.2;
constexpr double tolerated_growth = 1.1;
constexpr double tolerated_bytes = 32 << 20;

// The address sanitizer keeps what was freed for a while, so that resident memory grows by its design.
#ifdef GRAZE_HAS_ADDRESS_SANITIZER
constexpr bool resident_memory_is_ours = false;
#else
constexpr bool resident_memory_is_ours = true;
#endif

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double size = 0;
  double resident = 0;
  file >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

std::uint64_t hash_of(const FrameReport& report) {
  scenes::ReportHash hash;
  hash.add(report);
  return hash.value();
}

/// Takes reports and keeps some for long, also beyond their scene. Each must be what it was when it is let
/// go.
class Holder {
 public:
  Holder(std::uint64_t seed, std::size_t most) : random_(seed), most_(most) {}

  /// `scene_lock` is the soak's own: scenes are made anew.
  void run(const SoakWorld& world, std::shared_mutex& scene_lock, const std::atomic<bool>& done) {
    while (!done) {
      const Clock::time_point start = Clock::now();
      ReportHandle report;
      {
        const std::shared_lock lock(scene_lock);
        report = world.scene().latest_report();
      }
      held_.push_back({report, hash_of(*report)});
      if (held_.size() > most_) let_go();
      // Sleeps for most of the time if hashing is slow, as it is under sanitizers, so that the steps get on.
      std::this_thread::sleep_for(
          std::max<Clock::duration>(std::chrono::milliseconds(2), 4 * (Clock::now() - start)));
    }
    while (!held_.empty()) let_go();
  }
  [[nodiscard]] std::uint64_t taken() const { return taken_; }
  [[nodiscard]] std::uint64_t changed() const { return changed_; }

 private:
  struct Held {
    ReportHandle report;
    std::uint64_t hash;
  };
  void let_go() {
    const auto held = held_.begin() + static_cast<std::ptrdiff_t>(random_.below(held_.size()));
    if (hash_of(*held->report) != held->hash) ++changed_;
    held_.erase(held);
    ++taken_;
  }

  scenes::Random random_;
  std::size_t most_;
  std::vector<Held> held_;
  std::uint64_t taken_ = 0, changed_ = 0;
};

/// The largest figures of a stretch of time.
struct Interval {
  double minutes = 0;
  std::uint64_t frames = 0, checks = 0, contacts = 0, diagnostics = 0, objects = 0;
  double resident = 0, statistics = 0;  ///< bytes

  void add(const FrameReport& report) {
    const StepStatistics& s = report.statistics();
    ++frames;
    contacts += s.contacts;
    diagnostics += report.diagnostics().size();
    objects = std::max(objects, s.objects);
    // Reports are as many as the two who hold them happen to have held. Resident memory shows those.
    statistics = std::max(statistics, static_cast<double>(s.bytes.objects + s.bytes.pairs + s.bytes.threads));
    if (frames % 20 == 1) resident = std::max(resident, resident_bytes());
  }
};

class Soak {
 public:
  explicit Soak(const SoakOptions& options)
      : options_(options), world_(options.seed), barrier_(SoakWorld::writer_count + 1) {}

  StressResult run() {
    {
      std::vector<std::jthread> threads;
      const Ending ending(*this);  // also where a step throws: before the threads are waited for
      for (std::size_t writer = 0; writer < SoakWorld::writer_count; ++writer)
        threads.emplace_back([this, writer] {
          begin_thread();
          write(writer);
        });
      for (Holder& holder : holders_)
        threads.emplace_back([this, &holder] {
          begin_thread();
          holder.run(world_, scene_lock_, done_);
        });
      step_until_the_end();
    }
    return judge();
  }

 private:
  /// Lets the others know, and does not keep them waiting at the barrier.
  class Ending {
   public:
    explicit Ending(Soak& soak) : soak_(soak) {}
    ~Ending() {
      soak_.done_ = true;
      soak_.barrier_.arrive_and_drop();
    }
    Ending(const Ending&) = delete;
    Ending& operator=(const Ending&) = delete;

   private:
    Soak& soak_;
  };

  void begin_thread() const {
    if (options_.begin_thread) options_.begin_thread();
  }

  void step() {
    const ReportHandle report = options_.step ? options_.step(world_.scene()) : world_.scene().step();
    if (report)
      interval_.add(*report);
    else
      ++failed_steps_;
  }

  /// Between the two barriers of a frame, while the step runs.
  void write(std::size_t writer) {
    for (;;) {
      barrier_.arrive_and_wait();
      if (done_) return barrier_.arrive_and_drop();
      world_.write(writer);
      barrier_.arrive_and_wait();
    }
  }

  void step_until_the_end() {
    Progress progress("interval", intervals);
    const Clock::time_point start = Clock::now();
    print(table_.head());
    for (std::uint64_t frame = 1; intervals_.size() < intervals; ++frame) {
      world_.change_between_steps(true);
      barrier_.arrive_and_wait();
      step();
      barrier_.arrive_and_wait();
      if (frame % check_every == 0) check(frame);
      if (frame % remake_every == 0) remake();
      interval_.minutes = ns_between(start, Clock::now()) / 60e9;
      const auto intervals_done = static_cast<std::size_t>(share_done(frame) * intervals);
      while (intervals_.size() < std::min(intervals_done, intervals)) {
        progress.at(intervals_.size());
        close_interval();
      }
    }
  }

  [[nodiscard]] double share_done(std::uint64_t frame) const {
    return options_.frames > 0 ? static_cast<double>(frame) / static_cast<double>(options_.frames)
                               : interval_.minutes / options_.minutes;
  }

  void check(std::uint64_t frame) {
    world_.change_between_steps(false);
    const ReportHandle report = world_.scene().step();
    interval_.add(*report);
    ++interval_.checks;
    const std::string difference = world_.difference_from_fresh(*report);
    if (!difference.empty())
      result_.violations.push_back(
          format("frame %llu, %s: %s", number(frame), world_.mode().c_str(), difference.c_str()));
  }

  void remake() {
    const std::unique_lock lock(scene_lock_);
    world_.remake_scene();
  }

  void close_interval() {
    const Interval& i = interval_;
    print(table_.row({fixed(i.minutes, 2), std::to_string(i.frames), std::to_string(i.checks),
                      std::to_string(i.objects), std::to_string(i.contacts), std::to_string(i.diagnostics),
                      fixed(i.resident / 1e6, 1), fixed(i.statistics / 1e6, 2)}));
    result_.figures["intervals"].push_back({{"minutes", i.minutes},
                                            {"frames", i.frames},
                                            {"checks", i.checks},
                                            {"objects", i.objects},
                                            {"contacts", i.contacts},
                                            {"diagnostics", i.diagnostics},
                                            {"resident_bytes", i.resident},
                                            {"counted_bytes", i.statistics}});
    intervals_.push_back(i);
    interval_ = {};
    interval_.minutes = i.minutes;
  }

  void judge_growth(const char* what, double Interval::*figure) {
    const auto first = static_cast<std::size_t>(warm_up * intervals);
    const std::size_t middle = (first + intervals) / 2;
    const auto largest = [&](std::size_t begin, std::size_t end) {
      double most = 0;
      for (std::size_t i = begin; i < end; ++i) most = std::max(most, intervals_[i].*figure);
      return most;
    };
    const double before = largest(first, middle);
    const double after = largest(middle, intervals);
    std::printf("%s: at most %.2f MB, later %.2f MB\n", what, before / 1e6, after / 1e6);
    result_.figures[what] = {before, after};
    if (after > tolerated_growth * before + tolerated_bytes)
      result_.violations.push_back(format("%s grew from %.2f to %.2f MB", what, before / 1e6, after / 1e6));
  }

  StressResult judge() {
    Interval all;
    for (const Interval& interval : intervals_) {
      all.frames += interval.frames;
      all.checks += interval.checks;
      all.contacts += interval.contacts;
      all.diagnostics += interval.diagnostics;
    }
    std::uint64_t taken = 0;
    std::uint64_t changed = 0;
    for (const Holder& holder : holders_) {
      taken += holder.taken();
      changed += holder.changed();
    }
    std::printf(
        "%llu frames, %llu of them next to a scene built afresh; %llu contacts, %llu diagnostics; %llu "
        "reports "
        "held\n",
        number(all.frames), number(all.checks), number(all.contacts), number(all.diagnostics), number(taken));
    result_.figures["frames"] = all.frames;
    result_.figures["checks"] = all.checks;
    result_.figures["reports_held"] = taken;
    result_.figures["failed_steps"] = failed_steps_;
    if (resident_memory_is_ours) judge_growth("resident memory", &Interval::resident);
    judge_growth("counted memory", &Interval::statistics);
    if (changed > 0) result_.violations.push_back(std::to_string(changed) + " held reports changed");
    if (all.checks == 0) result_.violations.emplace_back("no frame was checked: give it more time");
    return std::move(result_);
  }

  const TextTable table_ = TextTable::of_numbers(
      {"minutes", "frames", "checks", "objects", "contacts", "diagnostics", "RSS MB", "counted MB"}, 8, 10);
  SoakOptions options_;
  SoakWorld world_;
  std::barrier<> barrier_;
  std::shared_mutex scene_lock_;
  std::atomic<bool> done_{false};
  std::array<Holder, 2> holders_ = {Holder(11, 10), Holder(12, 100)};
  std::vector<Interval> intervals_;
  Interval interval_;
  std::uint64_t failed_steps_ = 0;
  StressResult result_;
};

}  // namespace

StressResult run_soak_study(const SoakOptions& options) {
  return Soak(options).run();
}

}  // namespace graze::tools
