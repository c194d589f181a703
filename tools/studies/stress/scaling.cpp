#include "stress/scaling.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

#include "distribution.hpp"
#include "scenes/report_hash.hpp"
#include "stress/clocks.hpp"

namespace graze::tools {
namespace {

/// One of the two scenes, and what its steps took.
class TimedScene {
 public:
  TimedScene(const DriftingBodies& world, unsigned threads) : scene_(world.settings_with(threads)) {
    world.add_to(scene_);
  }

  void step(bool is_counted) {
    const auto wall_before = std::chrono::steady_clock::now();
    const double cpu_before = cpu_ns(CLOCK_PROCESS_CPUTIME_ID);
    const ReportHandle report = scene_.step();
    const double cpu = cpu_ns(CLOCK_PROCESS_CPUTIME_ID) - cpu_before;
    const double wall = ns_between(wall_before, std::chrono::steady_clock::now());
    hash_.add(*report);
    statistics_ = report->statistics();
    if (!is_counted) return;
    cpu_.push_back(cpu / 1e6);
    wall_.push_back(wall / 1e6);
    const StepStatistics& s = statistics_;
    const std::array<double, 5> phases = {s.times.read_ms, s.times.pairs_ms, s.times.refit_ms,
                                          s.times.jobs_ms, s.times.publish_ms};
    for (std::size_t i = 0; i < phases.size(); ++i) phases_[i].push_back(phases[i]);
  }

  [[nodiscard]] StepTimes times() const {
    StepTimes times;
    times.wall_ms = Distribution(wall_).median();
    times.cpu_ms = Distribution(cpu_).median();
    for (std::size_t i = 0; i < phases_.size(); ++i) times.phases_ms[i] = Distribution(phases_[i]).median();
    return times;
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }
  [[nodiscard]] const StepStatistics& statistics() const { return statistics_; }

 private:
  Scene scene_;
  scenes::ReportHash hash_;
  StepStatistics statistics_;
  std::vector<double> wall_, cpu_;
  std::array<std::vector<double>, phase_names.size()> phases_;
};

double reading_ms(const DriftingBodies& world) {
  std::vector<double> times;
  volatile float sum = 0;  // so that nobody finds the reading needless
  for (int i = 0; i < 7; ++i) {
    const double before = cpu_ns(CLOCK_THREAD_CPUTIME_ID);
    sum = world.read();
    times.push_back((cpu_ns(CLOCK_THREAD_CPUTIME_ID) - before) / 1e6);
  }
  (void)sum;
  return Distribution(times).median();
}

/// Some milliseconds of arithmetic in registers.
void calculate(std::uint64_t rounds) {
  std::uint64_t value = rounds;
  for (std::uint64_t i = 0; i < rounds; ++i) value = value * 6364136223846793005U + 1442695040888963407U;
  volatile std::uint64_t result = value;  // so that nobody finds it needless
  (void)result;
}

/// Measures how much faster two threads do the same arithmetic than one.
class Control {
 public:
  void run() {
    constexpr std::uint64_t rounds = 8'000'000;
    const auto start = std::chrono::steady_clock::now();
    calculate(rounds);
    const auto middle = std::chrono::steady_clock::now();
    std::thread other([] { calculate(rounds / 2); });
    calculate(rounds / 2);
    other.join();
    one_.push_back(ns_between(start, middle));
    two_.push_back(ns_between(middle, std::chrono::steady_clock::now()));
  }
  [[nodiscard]] double speedup() const { return Distribution(one_).median() / Distribution(two_).median(); }

 private:
  std::vector<double> one_, two_;
};

double serial_fraction_of(double one, double two) {
  return one > 0 ? std::clamp(2 * two / one - 1, 0.0, 1.0) : 0;
}

}  // namespace

ScalingRun run_scaling(DriftingBodies& world, std::size_t frames) {
  constexpr std::size_t warm_up = 3;  // memory grows, fronts are made
  TimedScene one(world, 1);
  TimedScene two(world, 2);
  Control control;
  for (std::size_t frame = 0; frame < warm_up + frames; ++frame) {
    world.move(frame);
    control.run();
    // The later one finds the positions in cache, so they take turns.
    TimedScene& first = frame % 2 == 0 ? one : two;
    first.step(frame >= warm_up);
    (frame % 2 == 0 ? two : one).step(frame >= warm_up);
  }
  ScalingRun run;
  run.frames = frames;
  run.one = one.times();
  run.two = two.times();
  run.read_ms = reading_ms(world);
  run.hash_one = one.hash();
  run.hash_two = two.hash();
  run.statistics = one.statistics();
  run.control_speedup = control.speedup();
  return run;
}

double ScalingRun::serial_fraction() const {
  return serial_fraction_of(one.wall_ms, two.wall_ms);
}

double ScalingRun::serial_fraction_by_phases() const {
  double serial = 0;
  double all = 0;
  for (std::size_t i = 0; i < phase_names.size(); ++i) {
    serial += one.phases_ms[i] * serial_fraction_of(one.phases_ms[i], two.phases_ms[i]);
    all += one.phases_ms[i];
  }
  return all > 0 ? serial / all : 0;
}

double predicted_speedup(double serial_fraction, unsigned threads) {
  return 1 / (serial_fraction + (1 - serial_fraction) / threads);
}

double growth_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const auto count = static_cast<double>(x.size());
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double log_x = std::log(x[i]);
    const double log_y = std::log(y[i]);
    sum_x += log_x;
    sum_y += log_y;
    sum_xx += log_x * log_x;
    sum_xy += log_x * log_y;
  }
  return (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

}  // namespace graze::tools
