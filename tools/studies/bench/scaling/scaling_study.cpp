#include "bench/scaling/scaling_study.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <graze/instruction_set.hpp>
#include <memory>
#include <string>
#include <utility>

#include "base/task_pool.hpp"
#include "bench/graze_contender.hpp"
#include "bench/scaling/scaling_model.hpp"
#include "check_failed.hpp"
#include "distribution.hpp"
#include "output/text.hpp"
#include "stress/clocks.hpp"

namespace graze::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::array predicted_threads{2U, 4U, 8U, 16U, 32U, 64U};
constexpr std::size_t warm_up = 3;
constexpr std::array<const char*, 5> stage_names{"read", "pairs", "refit", "jobs", "publish"};

/// The parts of a stage, in ms.
struct Stage {
  double serial = 0;
  double tasks = 0;
  double longest = 0;
};

/// A step that ran on one thread, with its stages.
struct RecordedStep {
  ModelStep model;
  std::array<double, stage_names.size()> ends{};  ///< of the stages, from the beginning of the step
};

std::unique_ptr<GrazeContender> contender_of(const MovingWorld& moving, Task task, unsigned threads) {
  const Telling telling = moving.scene().is_told ? Telling::motion : Telling::nothing;
  return std::make_unique<GrazeContender>(moving.scene(), moving.world(), task, threads, telling,
                                          instruction_set(), Recorded::no);
}

RecordedStep record_step(GrazeContender& graze) {
  std::vector<RoundTimes> rounds;
  TaskPool::record_rounds(&rounds);
  const Clock::time_point begin = Clock::now();
  graze.frame();
  const Clock::time_point end = Clock::now();
  TaskPool::record_rounds(nullptr);
  RecordedStep step;
  step.model.length = tools::ns_between(begin, end);
  for (RoundTimes& round : rounds) {
    ModelRound made{tools::ns_between(begin, round.begin), round.estimate, std::move(round.items), 0};
    made.rest = std::max(0.0, tools::ns_between(round.begin, round.end) - made.sum());
    step.model.rounds.push_back(std::move(made));
  }
  const StepTimes& times = graze.statistics().times;
  double passed = 0;
  const std::array stages{times.read_ms, times.pairs_ms, times.refit_ms, times.jobs_ms, times.publish_ms};
  for (std::size_t i = 0; i < stages.size(); ++i) step.ends[i] = passed += 1e6 * stages[i];
  return step;
}

/// Plays a scene on one thread, as if it had as many workers as may be.
std::vector<RecordedStep> record(const BenchScene& scene, Task task, std::size_t frames) {
  MovingWorld moving(scene);
  moving.place(0);
  const auto graze = contender_of(moving, task, predicted_threads.back());
  std::vector<RecordedStep> steps;
  for (std::size_t frame = 0; frame < warm_up + frames; ++frame) {
    if (frame > 0) moving.place(frame);
    RecordedStep step = record_step(*graze);
    if (frame >= warm_up) steps.push_back(std::move(step));
  }
  return steps;
}

std::array<Stage, stage_names.size()> stages_of(const RecordedStep& step) {
  std::array<Stage, stage_names.size()> stages;
  double last = 0;
  for (std::size_t i = 0; i < stages.size(); ++i)
    stages[i].serial = step.ends[i] - std::exchange(last, step.ends[i]);
  for (const ModelRound& round : step.model.rounds) {
    const auto ended =
        std::count_if(step.ends.begin(), step.ends.end(), [&](double at) { return at <= round.begin; });
    Stage& stage = stages[std::min(static_cast<std::size_t>(ended), stages.size() - 1)];
    stage.tasks += round.sum();
    stage.serial -= round.sum();
    for (const float item : round.items) stage.longest = std::max<double>(stage.longest, item);
  }
  return stages;
}

/// The median of a number of all steps, in ms.
template <typename Steps, typename Number>
double median_ms(const Steps& steps, const Number& number) {
  std::vector<double> values;
  values.reserve(steps.size());
  for (const auto& step : steps) values.push_back(number(step) / 1e6);
  return tools::Distribution(values).median();
}

/// Figures of so many threads of this machine.
struct Measured {
  unsigned threads = 1;
  double first_ms = 0;
  double wall_ms = 0;
  double cpu_ms = 0;  ///< of all threads
  double thread_mb = 0;
  std::uint64_t hash = 0;
};

Measured measure(const BenchScene& scene, Task task, std::size_t frames, unsigned threads) {
  MovingWorld moving(scene);
  moving.place(0);
  Measured measured{threads};
  std::vector<double> wall;
  std::vector<double> cpu;
  std::unique_ptr<GrazeContender> graze;
  for (std::size_t frame = 0; frame < warm_up + frames; ++frame) {
    if (frame > 0) moving.place(frame);
    const Clock::time_point begin = Clock::now();
    const double cpu_begin = tools::cpu_ns(CLOCK_PROCESS_CPUTIME_ID);
    if (graze == nullptr) graze = contender_of(moving, task, threads);
    graze->frame();
    const double ms = tools::ns_between(begin, Clock::now()) / 1e6;
    if (frame == 0) measured.first_ms = ms;
    if (frame >= warm_up) {
      wall.push_back(ms);
      cpu.push_back((tools::cpu_ns(CLOCK_PROCESS_CPUTIME_ID) - cpu_begin) / 1e6);
    }
    graze->note();
  }
  measured.wall_ms = tools::Distribution(wall).median();
  measured.cpu_ms = tools::Distribution(cpu).median();
  measured.thread_mb = static_cast<double>(graze->statistics().bytes.threads) / 1e6;
  measured.hash = graze->hash();
  return measured;
}

nlohmann::ordered_json figures_of(const Measured& measured) {
  return {{"threads", measured.threads},   {"wall_ms", measured.wall_ms},     {"cpu_ms", measured.cpu_ms},
          {"first_ms", measured.first_ms}, {"thread_mb", measured.thread_mb}, {"hash", measured.hash}};
}

std::vector<std::string> columns(const std::vector<unsigned>& threads) {
  std::vector<std::string> names{"scene",
                                 "task",
                                 "one_ms: ms with one thread",
                                 "serial_ms: serial ms",
                                 "rounds",
                                 "longest_ms: longest task, ms"};
  for (const unsigned count : predicted_threads)
    names.push_back(tools::format("model_%u: times as fast with %u, by the model", count, count));
  for (const unsigned count : threads) {
    names.push_back(tools::format("measured_%u: measured with %u", count, count));
    names.push_back(tools::format("cpu_%u: processor time with %u beside one", count, count));
    names.push_back(tools::format("thread_mb_%u: MB of threads with %u", count, count));
    names.push_back(tools::format("first_ms_%u: ms of the first step with %u", count, count));
  }
  return names;
}

}  // namespace

ScalingStudy::ScalingStudy(std::vector<unsigned> threads)
    : threads_(std::move(threads)),
      table_{"scaling", "How much faster steps become with more threads",
             tools::columns_of(columns(threads_))},
      stages_{"stages", "What a step on one thread is made of",
              tools::columns_of({"scene", "task", "stage", "serial_ms: serial ms", "tasks_ms: ms of tasks",
                                 "longest_ms: longest task, ms"})},
      figures_(nlohmann::ordered_json::array()) {
  table_.timed = stages_.timed = true;
}

void ScalingStudy::add(const BenchScene& scene, Task task, std::size_t frames) {
  const std::size_t count = frames == 0 ? scene.frames : frames;
  const std::vector<RecordedStep> steps = record(scene, task, count);
  const std::string letter(1, static_cast<char>(task));
  const Measured one = measure(scene, task, count, 1);
  std::vector<tools::Cell> row{scene.name, letter, one.wall_ms};
  row.emplace_back(median_ms(steps, [](const RecordedStep& step) { return step.model.serial(); }));
  row.emplace_back(std::uint64_t{steps.back().model.rounds.size()});
  row.emplace_back(median_ms(steps, [](const RecordedStep& step) {
    double longest = 0;
    for (const Stage& stage : stages_of(step)) longest = std::max(longest, stage.longest);
    return longest;
  }));
  nlohmann::ordered_json figures{{"scene", scene.name}, {"task", letter}, {"one", figures_of(one)}};
  const double alone = median_ms(steps, [](const RecordedStep& step) { return step.model.length; });
  for (const unsigned threads : predicted_threads) {
    const double predicted = median_ms(steps, [&](const RecordedStep& step) {
      return predicted_length(step.model, threads, ThreadPrices{}, workers_worth);
    });
    row.emplace_back(alone / predicted);
    figures["model"].push_back({{"threads", threads}, {"wall_ms", predicted}});
  }
  for (const unsigned threads : threads_) {
    const Measured measured = measure(scene, task, count, threads);
    if (measured.hash != one.hash)
      throw tools::CheckFailed(tools::format("bench: %s, task %s: another answer with %u threads",
                                             scene.name.c_str(), letter.c_str(), threads));
    row.emplace_back(one.wall_ms / measured.wall_ms);
    row.emplace_back(measured.cpu_ms / one.cpu_ms);
    row.emplace_back(measured.thread_mb);
    row.emplace_back(measured.first_ms);
    figures["measured"].push_back(figures_of(measured));
  }
  table_.rows.push_back(std::move(row));
  for (std::size_t i = 0; i < stage_names.size(); ++i) {
    const auto of_stage = [&](double Stage::*number) {
      return median_ms(steps, [&](const RecordedStep& step) { return stages_of(step)[i].*number; });
    };
    stages_.rows.push_back({scene.name, letter, stage_names[i], of_stage(&Stage::serial),
                            of_stage(&Stage::tasks), of_stage(&Stage::longest)});
    figures["stages"].push_back({{"stage", stage_names[i]},
                                 {"serial_ms", of_stage(&Stage::serial)},
                                 {"tasks_ms", of_stage(&Stage::tasks)},
                                 {"longest_ms", of_stage(&Stage::longest)}});
  }
  figures_.push_back(std::move(figures));
}

}  // namespace graze::bench
