#include "stress/reading.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "distribution.hpp"
#include "output/text.hpp"
#include "output/text_table.hpp"
#include "scenes/report_hash.hpp"
#include "stress/clocks.hpp"
#include "stress/drifting_bodies.hpp"

namespace graze::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array<unsigned, 4> reading_threads = {1, 2, 4, 16};
/// Memory grows, and the step finds out what is near.
constexpr std::size_t warm_up_frames = 3;
/// How much longer than the plain loop a step may take.
constexpr double aimed_ratio = 1.5;

/// How positions come to the step.
struct ReadingCase {
  const char* name;
  bool is_sparse;
  double range;    ///< of the scene
  bool is_copied;  ///< by set_positions(), which is counted
};

constexpr std::array<ReadingCase, 4> reading_cases = {{{"bound, nothing near", true, 0.04, false},
                                                       {"bound, as in S5", false, 0.04, false},
                                                       {"bound, most near", false, 0.3, false},
                                                       {"copied by calls", true, 0.04, true}}};

/// Calls `work(begin, end)` for ranges of objects, on so many threads.
class Ranges {
 public:
  explicit Ranges(unsigned threads) : threads_(threads), arena_(static_cast<int>(threads)) {}

  void run(std::size_t count, const std::function<void(std::size_t, std::size_t)>& work) {
    if (threads_ == 1) return work(0, count);
    const std::size_t each = std::max<std::size_t>(1, count / 64);
    arena_.execute([&] {
      oneapi::tbb::parallel_for(std::size_t{0}, (count + each - 1) / each, [&](std::size_t range) {
        work(range * each, std::min((range + 1) * each, count));
      });
    });
  }

 private:
  unsigned threads_;
  oneapi::tbb::task_arena arena_;
};

/// The loop beside which a step is measured.
class PlainLoop {
 public:
  explicit PlainLoop(const DriftingBodies& world) : world_(world), copies_(world.positions().size()) {}

  /// Reads all positions, and copies those of so many objects, which lie evenly among the others.
  void run(std::size_t copied, Ranges& ranges) {
    const std::size_t objects = world_.object_count();
    ranges.run(objects, [&](std::size_t begin, std::size_t end) {
      Row sums = Row::Zero();
      for (std::size_t object = begin; object < end; ++object) {
        const bool copies = (object + 1) * copied / objects > object * copied / objects;
        sums += copies ? sum_and_copy(object) : sum_of(object);
      }
      volatile float sum = sums.sum();  // so that nobody finds the reading needless
      (void)sum;
    });
  }

 private:
  // Sixteen sums, so that the memory is what it waits for.
  using Row = Eigen::Array<float, 16, 1>;

  [[nodiscard]] Row sum_of(std::size_t object) const {
    const std::size_t count = 3 * world_.vertices_each();
    const float* const from = world_.positions().data() + object * count;
    Row sums = Row::Zero();
    std::size_t i = 0;
    for (; i + 16 <= count; i += 16) sums += Eigen::Map<const Row>(from + i);
    for (; i < count; ++i) sums[0] += from[i];
    return sums;
  }
  Row sum_and_copy(std::size_t object) {
    const std::size_t count = 3 * world_.vertices_each();
    const float* const from = world_.positions().data() + object * count;
    float* const to = copies_.data() + object * count;
    Row sums = Row::Zero();
    std::size_t i = 0;
    for (; i + 16 <= count; i += 16) {
      const Row row = Eigen::Map<const Row>(from + i);
      Eigen::Map<Row>(to + i) = row;
      sums += row;
    }
    for (; i < count; ++i) sums[0] += to[i] = from[i];
    return sums;
  }

  const DriftingBodies& world_;
  std::vector<float> copies_;
};

/// The scene whose steps are measured.
class ReadScene {
 public:
  ReadScene(const ReadingCase& kind, const DriftingBodies& world, unsigned threads)
      : scene_(world.settings_with(threads)) {
    if (!kind.is_copied) {
      world.add_to(scene_);
      return;
    }
    ids_ = world.add_unbound_to(scene_);
    for (std::size_t i = 0; i < ids_.size(); ++i) views_.push_back(world.positions_of(i));
  }

  /// Steps, and returns the milliseconds that it took to take up positions, with the calls that copy them.
  double step(Ranges& ranges) {
    const Clock::time_point begin = Clock::now();
    if (!ids_.empty())
      ranges.run(ids_.size(), [&](std::size_t first, std::size_t end) {
        scene_.set_positions(std::span(ids_).subspan(first, end - first),
                             std::span(views_).subspan(first, end - first));
      });
    const double calls = ids_.empty() ? 0 : ns_between(begin, Clock::now()) / 1e6;
    const ReportHandle report = scene_.step();
    hash_.add(*report);
    const StepStatistics& statistics = report->statistics();
    copied_ = ids_.empty() ? statistics.objects - statistics.objects_surveyed : statistics.objects;
    return calls + statistics.times.read_ms;
  }
  /// How many objects the last step copied.
  [[nodiscard]] std::size_t copied() const { return copied_; }
  [[nodiscard]] std::uint64_t hash() const { return hash_.value(); }

 private:
  Scene scene_;
  std::vector<ObjectId> ids_;
  std::vector<PositionView> views_;
  scenes::ReportHash hash_;
  std::size_t copied_ = 0;
};

struct MeasuredReading {
  double step_ms = 0;
  double plain_ms = 0;
  double ratio = 0;  ///< the median of the frames' ratios
  std::size_t copied = 0;
  std::uint64_t hash = 0;
};

MeasuredReading measure_reading(const ReadingCase& kind, unsigned threads, const ReadingOptions& options) {
  DriftingBodies world = kind.is_sparse ? DriftingBodies::sparse_lattice(options.objects)
                                        : DriftingBodies::lattice(options.objects);
  world.set_range(kind.range);
  world.set_detail(ContactDetail::none);
  PlainLoop plain(world);
  Ranges ranges(threads);
  ReadScene scene(kind, world, threads);
  std::vector<double> steps, loops, ratios;
  for (std::size_t frame = 0; frame < warm_up_frames + options.frames; ++frame) {
    world.move(frame);
    double step = 0, loop = 0;
    // The later one finds a little in the caches, so they take turns.
    for (const bool steps_now : {frame % 2 == 0, frame % 2 != 0}) {
      const Clock::time_point begin = Clock::now();
      if (steps_now)
        step = scene.step(ranges);
      else
        plain.run(scene.copied(), ranges);
      if (!steps_now) loop = ns_between(begin, Clock::now()) / 1e6;
    }
    if (frame < warm_up_frames) continue;
    steps.push_back(step);
    loops.push_back(loop);
    ratios.push_back(step / loop);
  }
  return {Distribution(steps).median(), Distribution(loops).median(), Distribution(ratios).median(),
          scene.copied(), scene.hash()};
}

}  // namespace

StressResult run_reading_study(const ReadingOptions& options) {
  // The program, never the library, lets oneTBB have as many threads as a scene is asked to use.
  const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism,
                                            reading_threads.back());
  StressResult result;
  const TextTable table = TextTable::of_numbers(
      {"positions", "threads", "objects copied", "plain loop, ms", "step, ms", "ratio"}, 22, 9);
  print(table.head());
  for (const ReadingCase& kind : reading_cases) {
    std::uint64_t hash_of_one = 0;
    for (const unsigned threads : reading_threads) {
      const MeasuredReading found = measure_reading(kind, threads, options);
      print(table.row({kind.name, std::to_string(threads), std::to_string(found.copied),
                       fixed(found.plain_ms, 2), fixed(found.step_ms, 2), fixed(found.ratio, 2)}));
      result.figures["reading"].push_back({{"positions", kind.name},
                                           {"threads", threads},
                                           {"copied", found.copied},
                                           {"plain_ms", found.plain_ms},
                                           {"step_ms", found.step_ms},
                                           {"ratio", found.ratio},
                                           {"hash", hash_text(found.hash)}});
      if (threads == 1) hash_of_one = found.hash;
      if (found.hash != hash_of_one)
        result.violations.push_back(format("%s: reports of %u threads have hash %s, those of 1 thread %s",
                                           kind.name, threads, hash_text(found.hash).c_str(),
                                           hash_text(hash_of_one).c_str()));
    }
  }
  print(format("the aim is a ratio of %.1f; a loop on more threads than there are processors says little\n",
               aimed_ratio));
  return result;
}

}  // namespace graze::tools
