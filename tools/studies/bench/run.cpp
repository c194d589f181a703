#include "bench/run.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "bench/candidate_kernels.hpp"
#include "bench/graze_contender.hpp"
#include "bench/near_pairs.hpp"
#include "bench/stopwatch.hpp"
#include "bench/verification.hpp"
#include "check_failed.hpp"
#include "distribution.hpp"
#include "output/text.hpp"
#include "progress.hpp"
#include "scenes/random.hpp"

namespace graze::bench {
namespace {

/// Other memory, touched so that caches hold it.
class Eviction {
 public:
  explicit Eviction(bool is_wanted) : memory_(is_wanted ? bytes : 0) {}
  void touch() {
    constexpr std::size_t line = 64;
    for (std::size_t i = 0; i < memory_.size(); i += line)
      sum_ = memory_[i] = static_cast<unsigned char>(sum_ + 1);
  }

 private:
  static constexpr std::size_t bytes = std::size_t{64} << 20U;
  std::vector<unsigned char> memory_;
  volatile unsigned char sum_ = 0;  ///< so that nobody finds the touching needless
};

/// One contender on its way through a run.
class Entrant {
 public:
  using Make = std::function<std::unique_ptr<Contender>()>;

  Entrant(std::string_view name, const PeerEntry* entry, unsigned threads, Make make)
      : precision_(entry != nullptr ? entry->precision : 0),
        is_limit_(is_limit(name)),
        threads_(threads),
        make_(std::move(make)) {
    timing_.name = name;
  }

  void leave(std::string complaint) { timing_.complaint = std::move(complaint); }
  [[nodiscard]] bool is_out() const { return !timing_.complaint.empty(); }

  /// The first turn makes it, too.
  void take_turn(bool is_timed) {
    const Stopwatch watch(threads_);
    const bool is_first = contender_ == nullptr;
    if (is_first) contender_ = make_();
    contender_->frame();
    const double ms = watch.ms();
    if (is_first) timing_.first = ms;
    if (is_timed) times_.push_back(ms);
    if (auto* const graze = dynamic_cast<GrazeContender*>(contender_.get())) note(*graze, is_timed);
  }

  void verify(const Verification& verification) {
    if (is_limit_) return;
    Found found;
    contender_->collect(found);
    timing_.found = found.vertex_pairs.size() + found.triangle_pairs.size() + found.feature_pairs.size() +
                    found.distances.size();
    timing_.complaint = verification.complaint(found, precision_);
  }

  [[nodiscard]] Timing timing() const {
    const tools::Distribution times(times_);
    Timing timing = timing_;
    timing.median = times.median();
    timing.p99 = times.quantile(0.99);
    timing.worst = times.quantile(1);
    return timing;
  }
  [[nodiscard]] GrazeFigures figures() const {
    GrazeFigures figures = figures_;
    figures.contacts_per_frame /= static_cast<double>(std::max<std::size_t>(times_.size(), 1));
    return figures;
  }

 private:
  void note(GrazeContender& graze, bool is_timed) {
    graze.note();
    figures_.hash = graze.hash();
    figures_.object_bytes = static_cast<double>(graze.statistics().bytes.objects);
    if (is_timed) figures_.contacts_per_frame += static_cast<double>(graze.statistics().contacts);
  }

  double precision_;
  bool is_limit_;
  unsigned threads_;
  Make make_;
  std::unique_ptr<Contender> contender_;
  Timing timing_;
  std::vector<double> times_;
  GrazeFigures figures_;
};

/// A contender's library may hold the whole process to fewer threads than are asked for, graze too.
void require_threads(unsigned threads) {
  using oneapi::tbb::global_control;
  const auto there_are = static_cast<unsigned>(oneapi::tbb::info::default_concurrency());
  const auto allowed =
      static_cast<unsigned>(global_control::active_value(global_control::max_allowed_parallelism));
  if (allowed < std::min(threads, there_are))
    throw tools::CheckFailed(tools::format("bench: a contender holds the process to %u threads", allowed));
}

std::vector<Entrant> entrants_of(const MovingWorld& moving, const RunOptions& options,
                                 const PeerModule& module) {
  std::vector<Entrant> entrants;
  const auto add_graze = [&](std::string_view name, Telling telling, InstructionSet set,
                             Recorded recorded = Recorded::no) {
    entrants.emplace_back(name, nullptr, options.threads, [&moving, &options, telling, set, recorded] {
      return std::make_unique<GrazeContender>(moving.scene(), moving.world(), options.task, options.threads,
                                              telling, set, recorded);
    });
  };
  for (const InstructionSet set : options.instruction_sets) {
    const bool is_first = entrants.empty();
    add_graze(
        is_first ? std::string(graze_name) : std::string(graze_name) + ", " + std::string(to_string(set)),
        moving.scene().is_told ? Telling::motion : Telling::nothing, set);
  }
  if (options.is_recorded)
    add_graze(recorded_name, moving.scene().is_told ? Telling::motion : Telling::nothing,
              options.instruction_sets.front(), Recorded::in_memory);
  if (moving.scene().tries_telling) add_graze(told_name, Telling::motion, options.instruction_sets.front());
  const auto add_peer = [&](const PeerEntry& entry) {
    entrants.emplace_back(entry.name, &entry, options.threads, [&moving, &options, make = entry.make] {
      return make(moving.world(), options.task, options.threads);
    });
  };
  add_peer(module.entry(read_limit));
  add_peer(module.entry(box_limit));
  if (moving.scene().has_sleepers) add_peer(module.entry(movers_limit));
  for (const std::string_view name : options.peers) {
    const PeerEntry& entry = module.entry(name);
    if (entry.tasks.find(static_cast<char>(options.task)) != std::string_view::npos) add_peer(entry);
#if GRAZE_BENCH_KERNELS
    if (name != "clipping" || options.task != Task::B || options.threads > 1) continue;
    entrants.emplace_back(kernels_name, nullptr, 1U, [&moving, &options, &module] {
      return make_candidate_kernels(moving.scene(), moving.world(),
                                    module.entry(clipping_candidates).make(moving.world(), Task::B, 1),
                                    options.instruction_sets.front());
    });
#endif
  }
  return entrants;
}

/// Counts the near pairs of features over all pairs of objects.
std::size_t count_all_near_pairs(const BenchScene& scene, const World& world,
                                 std::span<const TrianglePair> near) {
  std::size_t count = 0;
  for (auto begin = near.begin(); begin != near.end();) {
    const std::uint32_t a = begin->object_a;
    const std::uint32_t b = begin->object_b;
    const auto end = std::find_if(begin, near.end(), [&](const TrianglePair& pair) {
      return pair.object_a != a || pair.object_b != b;
    });
    count += count_near_pairs({*scene.bodies[a].mesh, world.positions_of(a)},
                              {*scene.bodies[b].mesh, world.positions_of(b)}, {begin, end}, world.distance);
    begin = end;
  }
  return count;
}

/// Every instruction set gives the same bits. Those of the others come right after the first.
void compare_reports(std::span<Entrant> of_sets) {
  const std::uint64_t hash = of_sets.front().figures().hash;
  for (Entrant& entrant : of_sets.subspan(1))
    if (entrant.figures().hash != hash)
      entrant.leave("its reports are not those of the first instruction set");
}

}  // namespace

const Timing* Run::timing(std::string_view name) const {
  for (const Timing& timing : timings)
    if (timing.name == name) return &timing;
  return nullptr;
}

double Run::median(std::string_view name) const {
  const Timing* const found = timing(name);
  return found != nullptr && found->complaint.empty() ? found->median
                                                      : std::numeric_limits<double>::quiet_NaN();
}

Run run_scene(const BenchScene& scene, const RunOptions& options, const PeerModule& module) {
  constexpr std::size_t warm_up = 3;  // memory grows
  constexpr std::size_t large = 500'000;
  MovingWorld moving(scene);
  const World& world = moving.world();
  const char* const oracle = options.task == Task::A ? "row grid" : "clipping";
  Verification verification(scene, options.task,
                            module.entry(oracle).make(world, options.task == Task::A ? Task::A : Task::B, 1));
  std::vector<Entrant> entrants = entrants_of(moving, options, module);

  Run run;
  run.scene = scene.name;
  run.what = scene.what;
  run.task = options.task;
  run.threads = options.threads;
  run.evict = options.evict;
  run.slow = options.slow;
  run.frames = options.frames > 0 ? options.frames : scene.frames;
  run.objects = world.objects.size();
  run.vertices = world.positions.size() / 3;
  run.distance = scene.distance;
  const std::size_t verified_every = run.vertices > large ? std::max<std::size_t>(4, run.frames / 8) : 1;
  Eviction eviction(options.evict);
  scenes::Random random(1);
  std::vector<std::size_t> order(entrants.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  tools::Progress progress(tools::format("%s, task %c, %u threads: frame", scene.name.c_str(),
                                         static_cast<char>(options.task), options.threads),
                           warm_up + run.frames);
  for (std::size_t frame = 0; frame < warm_up + run.frames; ++frame) {
    progress.at(frame);
    if (frame > 0) moving.place(frame);
    const bool is_verified = frame % verified_every == 0 || frame + 1 == warm_up + run.frames;
    if (is_verified) {
      verification.update();
      ++run.frames_verified;
    }
    // The order of contenders changes from frame to frame, because each finds in the caches the data that the
    // one before left there.
    for (std::size_t left = order.size(); left > 1; --left)
      std::swap(order[left - 1], order[random.below(left)]);
    for (const std::size_t number : order) {
      Entrant& entrant = entrants[number];
      if (entrant.is_out()) continue;
      eviction.touch();
      entrant.take_turn(frame >= warm_up);
      if (is_verified) entrant.verify(verification);
    }
    if (frame == 0) require_threads(options.threads);
  }
  compare_reports(std::span(entrants).first(options.instruction_sets.size()));
  if (run.task == Task::B && run.threads == 1)
    run.near_pairs = count_all_near_pairs(scene, world, verification.triangle_pairs());
  for (const Entrant& entrant : entrants) run.timings.push_back(entrant.timing());
  run.graze = entrants.front().figures();
  return run;
}

}  // namespace graze::bench
