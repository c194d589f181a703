#include "stress/reader.hpp"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

#include "distribution.hpp"
#include "output/text.hpp"
#include "output/text_table.hpp"
#include "progress.hpp"
#include "scenes/played_scene.hpp"
#include "stress/clocks.hpp"

namespace graze::tools {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds period{1};

/// The times that one reading thread measured, in µs.
struct ReadTimes {
  std::vector<double> wall, cpu, late;
};

/// Calls `read` once a period until `end`, `offset` after the full period.
ReadTimes read_periodically(Clock::time_point start, Clock::time_point end, std::chrono::microseconds offset,
                            const std::function<void()>& read) {
  ReadTimes times;
  const auto count = static_cast<std::size_t>((end - start) / period) + 1;
  for (auto* values : {&times.wall, &times.cpu, &times.late}) values->reserve(count);
  for (Clock::time_point due = start + offset; due < end; due += period) {
    std::this_thread::sleep_until(due);
    const Clock::time_point wall_before = Clock::now();
    const double cpu_before = cpu_ns(CLOCK_THREAD_CPUTIME_ID);
    read();
    const double cpu = cpu_ns(CLOCK_THREAD_CPUTIME_ID) - cpu_before;
    times.wall.push_back(ns_between(wall_before, Clock::now()) / 1e3);
    times.cpu.push_back(cpu / 1e3);
    times.late.push_back(ns_between(due, wall_before) / 1e3);
  }
  return times;
}

/// Takes the last report as a haptics loop does: all pairs, the first contacts of each. Sees whether it is
/// whole.
class ReportReader {
 public:
  explicit ReportReader(const Scene& scene) : scene_(scene) {}

  void read() {
    const ReportHandle report = scene_.latest_report();
    std::size_t contacts = 0;
    for (const PairReport& pair : report->pairs()) {
      nearest_ = std::min(nearest_, pair.distance.lower);
      contacts += pair.contact_count;
      for (const Contact& contact :
           report->contacts(pair).first(std::min<std::size_t>(pair.contact_count, 4)))
        if (!(contact.normal.squaredNorm() > 0.5)) ++torn_;
    }
    if (contacts != report->contacts().size() || report->frame() < frame_) ++torn_;
    frames_ += report->frame() == frame_ ? 0U : 1U;
    frame_ = report->frame();
    pairs_ = report->pairs().size();
  }
  [[nodiscard]] std::size_t torn() const { return torn_; }
  [[nodiscard]] std::size_t frames() const { return frames_; }
  [[nodiscard]] std::size_t pairs() const { return pairs_; }

 private:
  const Scene& scene_;
  std::uint64_t frame_ = 0;
  double nearest_ = 1e30;
  std::size_t torn_ = 0, frames_ = 0, pairs_ = 0;
};

nlohmann::ordered_json tables(const ReadTimes& graze, const ReadTimes& control) {
  const Distribution graze_wall(graze.wall), control_wall(control.wall);
  const Distribution graze_cpu(graze.cpu), control_cpu(control.cpu);
  const Distribution graze_late(graze.late), control_late(control.late);
  const TextTable table = TextTable::of_numbers({"µs", "p50", "p99", "p99.9", "max"}, 29, 10);
  print(table.head());
  const auto print_row = [&](const char* name, const Distribution& times) {
    print(table.row({name, fixed(times.median(), 2), fixed(times.quantile(0.99), 2),
                     fixed(times.quantile(0.999), 2), fixed(times.quantile(1), 2)}));
  };
  print_row("read a report, wall", graze_wall);
  print_row("control: load a counter, wall", control_wall);
  print_row("read a report, processor", graze_cpu);
  print_row("control, processor", control_cpu);
  print_row("woken late", graze_late);
  print_row("control, woken late", control_late);
  return {
      {"read",
       {{"wall", graze_wall.figures()}, {"cpu", graze_cpu.figures()}, {"late", graze_late.figures()}}},
      {"control",
       {{"wall", control_wall.figures()}, {"cpu", control_cpu.figures()}, {"late", control_late.figures()}}}};
}

}  // namespace

StressResult run_reader_study(double seconds) {
  const auto played = scenes::make_played_scene("pile");
  SceneSettings settings = played->settings();
  settings.threads = std::max(2U, std::thread::hardware_concurrency());
  Scene scene(settings);
  played->advance(scene, 0);
  scene.step();

  const Clock::time_point start = Clock::now();
  const Clock::time_point end =
      start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  ReportReader reader(scene);
  ReadTimes graze, control;
  std::atomic<std::uint64_t> counter{0};
  std::thread reading([&] { graze = read_periodically(start, end, {}, [&] { reader.read(); }); });
  std::thread controlling([&] {
    // Half a period later, so that neither waits for the other.
    control =
        read_periodically(start, end, period / 2, [&] { (void)counter.load(std::memory_order_acquire); });
  });
  Progress progress("second", static_cast<std::uint64_t>(seconds));
  std::size_t steps = 1;
  for (; Clock::now() < end; ++steps) {
    played->advance(scene, steps);
    scene.step();
    counter.fetch_add(1, std::memory_order_release);
    progress.at(static_cast<std::uint64_t>(ns_between(start, Clock::now()) / 1e9));
  }
  reading.join();
  controlling.join();

  StressResult result;
  std::printf(
      "a report of %zu pairs read %zu times in %g s beside %zu steps on %u threads; %zu frames seen\n",
      reader.pairs(), graze.wall.size(), seconds, steps, settings.threads, reader.frames());
  result.figures = {{"seconds", seconds},
                    {"steps", steps},
                    {"reads", graze.wall.size()},
                    {"frames_seen", reader.frames()},
                    {"retries", 0},
                    {"unit", "microseconds"}};
  result.figures.update(tables(graze, control));
  std::printf("retries 0: taking a report is one atomic addition, whatever the stepping thread does\n");
  if (reader.torn() > 0)
    result.violations.push_back(std::to_string(reader.torn()) + " reports were not whole");
  if (reader.frames() == 0 && steps > 2) result.violations.emplace_back("the reader saw no new report");
  return result;
}

}  // namespace graze::tools
